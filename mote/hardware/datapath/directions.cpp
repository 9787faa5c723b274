#include "mote/hardware/datapath/directions.hpp"

#include <cmath>

#include "mote/base/numbers.hpp"
#include "mote/hardware/datapath/tape.hpp"

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Op;

constexpr double kNear = kPi - 0.14;

void append_directions(graph::Graph& graph, std::vector<Id>& states, const std::vector<std::uint32_t>& turning) {
  for (const std::uint32_t d : turning)
    for (const Op op : {Op::kCos, Op::kSin}) states.push_back(graph.operation(op, {states[d]}));
}

}  // namespace

std::vector<std::uint32_t> turning_states(const graph::Recorded& recorded, const Samples& samples) {
  std::vector<std::uint32_t> turning;
  for (std::uint32_t d = 0; d < recorded.states.size(); ++d)
    if (recorded.states[d].angle) turning.push_back(d);
  if (turning.empty()) return turning;
  const Plan plan = plan_of(recorded);
  Tape tape(plan, recorded, Part::kNext);
  std::vector<bool> near(recorded.states.size());
  for (const auto& call : samples.of(Part::kNext)) {
    tape.evaluate(call);
    for (const std::uint32_t d : turning) near[d] = near[d] || std::abs(tape.value(plan.next[d])) > kNear;
  }
  std::erase_if(turning, [&](std::uint32_t d) { return !near[d]; });
  return turning;
}

graph::Recorded with_directions(graph::Recorded recorded, const std::vector<std::uint32_t>& turning) {
  append_directions(recorded.graph, recorded.initial, turning);
  append_directions(recorded.graph, recorded.next, turning);
  if (!recorded.proposed.empty()) append_directions(recorded.graph, recorded.proposed, turning);
  for (const std::uint32_t d : turning)
    for (const char* side : {"_cos", "_sin"}) {
      Quantity direction;
      direction.name = recorded.states[d].name + side;
      recorded.states.push_back(direction);
    }
  return recorded;
}

Samples with_directions(Samples samples, const std::vector<std::uint32_t>& turning) {
  for (const std::uint32_t d : turning) samples.errors.insert(samples.errors.end(), 2, samples.errors[d]);
  return samples;
}

}  // namespace mote::hardware
