#include "mote/app/commands/rtl_options.hpp"

#include <algorithm>
#include <map>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using hardware::Architecture;
using hardware::architectures;

constexpr long long kMostInCircuit = 65536;

/// Registers that the architecture does not have are no use to be told.
void refuse_unread(const Arguments& arguments, const Architecture& architecture) {
  const std::map<std::string, std::string> registers{
      {"--draws", "draws"}, {"--burn-in", "burn_in"}, {"--chain-mean", "chain_mean"}, {"--lanes", "lanes"}};
  for (const auto& [option, name] : registers)
    if (arguments.given(option) && std::none_of(architecture.registers.begin(), architecture.registers.end(),
                                                [&](const auto& one) { return one.name == name; }))
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), option, "an architecture that has it",
                                          std::string(architecture.name), "Leave it out, or pass another --arch."});
}

}  // namespace

std::vector<OptionSpec> circuit_options() {
  std::string kinds;
  for (const Architecture& one : architectures()) kinds += (kinds.empty() ? "" : ", ") + std::string(one.name);
  return {{"--arch", "KIND", "imh", "kind of filter: " + kinds, "Circuit"},
          {"-n,--particles", "N", "1000", "particles, from 1 to 65536", "Circuit"},
          {"--draws", "Q", "", "imh: proposals a step beside the burn-in, at least N [N]", "Circuit"},
          {"--burn-in", "NB", "0", "imh: proposals that the chain forgets", "Circuit"},
          {"--chain-mean", "", "", "imh: estimate from the kept states instead of all weighted proposals", "Circuit"},
          {"--lanes", "L", "1", "lanes side by side (chains, where there are chains)", "Circuit"},
          {"--seed", "S", "1", "seed of the circuit's generators; same seed, same words", "Circuit"},
          {"--synth", "FAMILY", "", "what it takes of a device: xc7, ice40 or ecp5 (Yosys, nextpnr) [none]", "Checks"}};
}

CircuitDesign circuit_design_from(const Arguments& arguments) {
  std::vector<std::string> names;
  for (const Architecture& one : architectures()) names.emplace_back(one.name);
  CircuitDesign design;
  design.architecture = &architectures()[arguments.choice("--arch", names)];
  const long long particles = arguments.integer("--particles", 1, kMostInCircuit);
  design.registers.particles = static_cast<std::uint32_t>(particles);
  design.registers.draws = static_cast<std::uint32_t>(
      arguments.given("--draws") ? arguments.integer("--draws", particles, kMostInCircuit) : particles);
  design.registers.burn_in = static_cast<std::uint32_t>(arguments.integer("--burn-in", 0, kMostInCircuit));
  design.registers.chain_mean = arguments.given("--chain-mean");
  design.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  refuse_unread(arguments, *design.architecture);
  return design;
}

std::optional<hardware::Family> family_from(const Arguments& arguments) {
  if (!arguments.given("--synth")) return std::nullopt;
  return static_cast<hardware::Family>(arguments.choice("--synth", {"xc7", "ice40", "ecp5"}));
}

}  // namespace mote
