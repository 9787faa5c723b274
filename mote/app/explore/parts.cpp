#include "mote/app/explore/parts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/files/facts.hpp"
#include "mote/hardware/bench.hpp"

namespace mote::explore {
namespace {

using hardware::PartCost;

/// Circuits of the same text, parameters and tables are the same part.
Part part_of(hardware::Circuit circuit) {
  std::string text = hardware::bench_module("part", {circuit}, "");
  for (const hardware::Source& source : circuit.sources) text += source.text;
  for (const hardware::Memory& memory : circuit.memories) text += memory.text();
  return {fmt::format("timed part {} {} {}", circuit.module, text.size(), checksum_of(text)), std::move(circuit)};
}

/// Particles a lane that memory blocks are made for: two sets of them fill a block of 1024 words; for fewer there is
/// one all the same.
double deep(std::size_t particles, unsigned lanes) {
  constexpr double kLeast = 512;
  return std::max(kLeast, static_cast<double>(particles) / lanes);
}

}  // namespace

Parts parts_of(const hardware::Machine& machine, const Anchor& anchor) {
  return {part_of(hardware::filter_alone(anchor.machine)), part_of(machine.model().propose),
          part_of(machine.model().weigh)};
}

PartCost remembered(const Part& part, Memory& memory) {
  const std::vector<double> found = memory.recall(part.name, 8, [&] {
    const PartCost cost = hardware::part_cost(part.circuit);
    return std::vector<double>{static_cast<double>(cost.area.lut),
                               static_cast<double>(cost.area.ff),
                               static_cast<double>(cost.area.dsp),
                               static_cast<double>(cost.area.bram18),
                               cost.path_ns,
                               cost.leaving_ns,
                               cost.coming_ns,
                               cost.log_ns};
  });
  const auto whole = [&](std::size_t k) { return static_cast<int>(found[k]); };
  return {{whole(0), whole(1), whole(2), whole(3)}, found[4], found[5], found[6], found[7]};
}

hardware::Cost cost_by_parts(const hardware::Machine& machine, std::size_t particles, const Anchor& anchor,
                             Memory& memory) {
  const Parts parts = parts_of(machine, anchor);
  const unsigned lanes = machine.capacity().lanes;
  PartCost filter = remembered(parts.filter, memory);
  const int tables = std::min(static_cast<int>(lanes), filter.area.bram18);
  filter.area.bram18 = tables + static_cast<int>(std::ceil((filter.area.bram18 - tables) * deep(particles, lanes) /
                                                           deep(anchor.particles, lanes)));
  return hardware::cost_of_parts(machine, remembered(parts.propose, memory), remembered(parts.weigh, memory), filter);
}

}  // namespace mote::explore
