#pragma once
/// Recordings that a model draws itself, for tests.

#include "mote/base/draws.hpp"
#include "mote/engine/recording.hpp"
#include "mote/model/model.hpp"

namespace mote {

/// Steps 1 .. T with all that a recording may lack or have twice: t = 2 without a row, no t = 4, two rows at t = 5.
template <class M>
Recording drawn_recording(const M& model, Step steps) {
  Recording recording;
  auto prior = Draws{7, 0}.block(Purpose::kTruth);
  auto first = prior.particle(0);
  auto x = model.template initial<double>(first);
  for (Step t = 1; t <= steps; ++t) {
    auto block = Draws{7, static_cast<std::uint32_t>(t)}.block(Purpose::kTruth);
    auto draw = block.particle(0);
    x = model.template next<double>(t, x, draw);
    const Row<double> row = model.template observe<double>(t, x, blank_row(model), draw);
    const Row<double> again = model.template observe<double>(t, x, blank_row(model), draw);
    if (t == 4) continue;
    recording.steps.push_back({t, {}});
    if (t != 2) recording.steps.back().rows.push_back(row);
    if (t == 5) recording.steps.back().rows.push_back(again);
  }
  return recording;
}

}  // namespace mote
