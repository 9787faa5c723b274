#include "mote/app/explore/parts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/files/facts.hpp"
#include "mote/hardware/bench.hpp"

namespace mote::explore {
namespace {

using hardware::PartCost;

std::string name_of(const std::string& module, const std::string& text) {
  return fmt::format("part {} {} {}", module, text.size(), checksum_of(text));
}

/// Circuits of the same text, parameters and tables are the same part.
Part part_of(const hardware::Circuit& circuit) {
  std::string text = hardware::bench_module("part", {circuit}, "");
  for (const hardware::Source& source : circuit.sources) text += source.text;
  for (const hardware::Memory& memory : circuit.memories) text += memory.text();
  return {name_of(circuit.module, text), [circuit] { return hardware::part_cost(circuit); }};
}

Part part_of(const hardware::Machine& machine) {
  return {name_of(machine.name(), machine.text()), [machine] { return hardware::part_cost(machine); }};
}

/// Particles a lane that memory blocks are made for: two sets of them fill a block of 1024 words; for fewer there is
/// one all the same.
double deep(std::size_t particles, unsigned lanes) {
  constexpr double kLeast = 512;
  return std::max(kLeast, static_cast<double>(particles) / lanes);
}

}  // namespace

Parts parts_of(const hardware::Machine& machine, const Anchor& anchor) {
  return {part_of(anchor.machine), part_of(machine.model().propose), part_of(machine.model().weigh),
          part_of(anchor.machine.model().propose), part_of(anchor.machine.model().weigh)};
}

PartCost remembered(const Part& part, Memory& memory) {
  const std::vector<double> found = memory.recall(part.name, 5, [&] {
    const auto [area, path_ns] = part.synthesised();
    return std::vector<double>{static_cast<double>(area.lut), static_cast<double>(area.ff),
                               static_cast<double>(area.dsp), static_cast<double>(area.bram18), path_ns};
  });
  const auto whole = [&](std::size_t k) { return static_cast<int>(found[k]); };
  return {{whole(0), whole(1), whole(2), whole(3)}, found[4]};
}

hardware::Cost cost_by_parts(const hardware::Machine& machine, std::size_t particles, const Anchor& anchor,
                             Memory& memory) {
  const Parts parts = parts_of(machine, anchor);
  const unsigned lanes = machine.capacity().lanes;
  const hardware::PipelineCosts anchors{remembered(parts.anchors_propose, memory),
                                        remembered(parts.anchors_weigh, memory)};
  const hardware::PipelineCosts own{remembered(parts.propose, memory), remembered(parts.weigh, memory)};
  PartCost whole = remembered(parts.anchor, memory);
  const int fixed = static_cast<int>(lanes) * (1 + anchors.propose.area.bram18 + anchors.weigh.area.bram18);
  const int particle_blocks = std::max(0, whole.area.bram18 - fixed);
  whole.area.bram18 +=
      static_cast<int>(std::ceil(particle_blocks * deep(particles, lanes) / deep(anchor.particles, lanes))) -
      particle_blocks;
  hardware::Cost cost = hardware::cost_of_parts(whole, lanes, anchors, own);
  cost.iob = machine.pins();
  return cost;
}

}  // namespace mote::explore
