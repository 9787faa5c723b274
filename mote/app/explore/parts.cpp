#include "mote/app/explore/parts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mote::explore {
namespace {

using hardware::PartCost;

PartCost remembered(const std::string& name, const hardware::Circuit& circuit, Memory& memory) {
  const std::vector<double> found = memory.recall("part " + name, [&] {
    const PartCost part = hardware::part_cost(circuit);
    return std::vector<double>{static_cast<double>(part.area.lut), static_cast<double>(part.area.ff),
                               static_cast<double>(part.area.dsp), static_cast<double>(part.area.bram18), part.path_ns};
  });
  const auto whole = [&](std::size_t k) { return static_cast<int>(found[k]); };
  return {{whole(0), whole(1), whole(2), whole(3)}, found[4]};
}

/// What a filter without its pipelines depends on.
std::string name_of_filter(const hardware::Machine& machine) {
  std::string name = fmt::format("filter {}", machine.architecture().module);
  for (const hardware::Parameter& parameter : machine.parameters())
    name += fmt::format(" {}={}", parameter.name, parameter.value);
  return name;
}

/// Particles a lane that memory blocks are made for: two sets of them fill a block of 1024 words; for fewer there is
/// one all the same.
double deep(std::size_t particles, unsigned lanes) {
  constexpr double kLeast = 512;
  return std::max(kLeast, static_cast<double>(particles) / lanes);
}

}  // namespace

hardware::Cost cost_by_parts(const hardware::Machine& machine, std::size_t particles, const std::string& pipelines,
                             const Anchor& anchor, Memory& memory) {
  const hardware::ModelCircuit& model = machine.model();
  const unsigned lanes = machine.capacity().lanes;
  PartCost filter = remembered(name_of_filter(anchor.machine), hardware::filter_alone(anchor.machine), memory);
  const int tables = std::min(static_cast<int>(lanes), filter.area.bram18);
  filter.area.bram18 = tables + static_cast<int>(std::ceil((filter.area.bram18 - tables) * deep(particles, lanes) /
                                                           deep(anchor.particles, lanes)));
  return hardware::cost_of_parts(machine, remembered("propose " + pipelines, model.propose, memory),
                                 remembered("weigh " + pipelines, model.weigh, memory), filter);
}

}  // namespace mote::explore
