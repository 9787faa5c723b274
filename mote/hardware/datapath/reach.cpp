#include "mote/hardware/datapath/reach.hpp"

#include <algorithm>
#include <cmath>

#include "mote/graph/interval.hpp"
#include "mote/hardware/datapath/tape.hpp"

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Interval;
using graph::Op;
using graph::Role;
using graph::Vertex;

constexpr double kFar = 256;

/// By state, what is no run-away; everything where half of the numbers are one.
std::vector<Interval> reaches(const Plan& plan, const graph::Recorded& recorded, const Samples& samples) {
  Tape tape(plan, recorded, Part::kNext);
  std::vector<std::vector<double>> made(plan.next.size());
  for (const auto& call : samples.of(Part::kNext)) {
    tape.evaluate(call);
    for (std::size_t d = 0; d < made.size(); ++d)
      if (const double value = tape.value(plan.next[d]); std::isfinite(value)) made[d].push_back(value);
  }
  std::vector<Interval> reaches(made.size());
  for (std::size_t d = 0; d < made.size(); ++d) {
    if (made[d].empty()) continue;
    std::sort(made[d].begin(), made[d].end());
    const double low = made[d][made[d].size() / 4];
    const double high = made[d][made[d].size() * 3 / 4];
    if (low < high) reaches[d] = {low - kFar * (high - low), high + kFar * (high - low)};
  }
  return reaches;
}

bool reads_a_state(const Vertex& v) {
  return v.op == Op::kInput && (v.role == Role::kState || v.role == Role::kBefore);
}

/// Whether all states that the last call read or made are within their reaches.
bool within(const Plan& plan, Part part, const Tape& tape, const std::vector<Interval>& reaches) {
  for (const Id id : tape.order())
    if (const Vertex& v = plan.graph[id]; reads_a_state(v) && !reaches[v.index].contains(tape.value(id))) return false;
  if (part == Part::kWeigh) return true;
  const std::vector<Id> outputs = plan.outputs(part);
  for (std::size_t d = 0; d < outputs.size(); ++d)
    if (!reaches[d].contains(tape.value(outputs[d]))) return false;
  return true;
}

}  // namespace

Samples within_reach(const Plan& plan, const graph::Recorded& recorded, const Samples& samples) {
  const std::vector<Interval> all = reaches(plan, recorded, samples);
  Samples kept{{}, samples.errors};
  for (const Part part : kParts) {
    Tape tape(plan, recorded, part);
    auto& calls = kept.calls[static_cast<std::size_t>(part)];
    for (const auto& call : samples.of(part)) {
      tape.evaluate(call);
      if (within(plan, part, tape, all)) calls.push_back(call);
    }
    if (calls.empty()) calls = samples.of(part);
  }
  return kept;
}

}  // namespace mote::hardware
