#include "mote/app/commands/rtl_options.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using hardware::Architecture;
using hardware::architectures;

constexpr long long kMostInCircuit = 65536;

/// In the order of hardware::Resampler.
const std::vector<std::string> kResamplers{"systematic", "residual-systematic", "roulette"};
/// Each has what the one before has: see hardware::PlainLoops.
const std::vector<std::string> kLoops{"separate", "pipelined", "merged"};

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::vector<std::string> architecture_names() {
  std::vector<std::string> names;
  for (const Architecture& one : architectures()) names.emplace_back(one.name);
  return names;
}

bool has_register(const Architecture& architecture, std::string_view name) {
  return std::any_of(architecture.registers.begin(), architecture.registers.end(),
                     [&](const auto& one) { return one.name == name; });
}

/// What an architecture has no register or room for is no use to be asked for.
void refuse_unread(const Arguments& arguments, const CircuitDesign& design) {
  const Architecture& architecture = *design.architecture;
  const auto has = [&](const char* name) { return has_register(architecture, name); };
  const hardware::RunRegisters& r = design.registers;
  const std::tuple<const char*, bool, bool> options[] = {
      {"--draws", r.draws != r.particles, has("draws")},
      {"--burn-in", r.burn_in != 0, has("burn_in")},
      {"--chain-mean", r.chain_mean, has("chain_mean")},
      {"--overlap", design.variant.overlapped, architecture.chain},
      {"--ii", design.interval != 1, architecture.turns},
      {"--proposal", design.proposal != "prior", architecture.pairs},
      {"--lanes", design.lanes != 1, architecture.most_lanes > 1},
      {"--exchange", r.exchange != 0, has("exchange")},
      {"--resampler", arguments.given("--resampler"), architecture.schemes},
      {"--loops", arguments.given("--loops"), architecture.loops}};
  for (const auto& [option, asked, taken] : options)
    if (asked && !taken)
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), option, "an architecture that has it",
                                          std::string(architecture.name), "Leave it out, or pass another --arch."});
}

/// A step that begins while the one before is decided on has a row for every cycle.
void refuse_overlapped_turns(const Arguments& arguments, const CircuitDesign& design) {
  if (design.interval > 1 && design.variant.overlapped)
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--ii", "1 with --overlap", std::to_string(design.interval),
                                        "Leave out one of them."});
}

unsigned lanes_from(const Arguments& arguments, const CircuitDesign& design) {
  constexpr unsigned kUsual = 4;
  if (!arguments.given("--lanes")) return std::min(kUsual, design.architecture->most_lanes);
  return static_cast<unsigned>(arguments.integer("--lanes", 1, 64));
}

/// Lanes share the particles evenly, and are counted by bits.
void refuse_uneven(const Arguments& arguments, const CircuitDesign& design) {
  const unsigned most = design.architecture->most_lanes;
  const bool even = design.registers.particles % design.lanes == 0 && design.registers.draws % design.lanes == 0;
  if (std::has_single_bit(design.lanes) && design.lanes <= most && even) return;
  throw Refusal(ExitCode::kWrongUse,
                {arguments.where(), "--lanes",
                 "a power of two from 1 to " + std::to_string(most) + " that divides --particles and --draws",
                 std::to_string(design.lanes), "Pass --lanes 1, or other --particles."});
}

hardware::Variant variant_from(const Arguments& arguments) {
  hardware::Variant variant;
  variant.overlapped = arguments.given("--overlap");
  variant.logic_tables = arguments.choice("--tables", {"blocks", "logic"}) == 1;
  if (arguments.given("--resampler"))
    variant.resampler = static_cast<hardware::Resampler>(arguments.choice("--resampler", kResamplers));
  if (arguments.given("--loops")) {
    const std::size_t loops = arguments.choice("--loops", kLoops);
    variant.loops = {loops > 0, loops > 1};
  }
  return variant;
}

/// M, of each group's particles.
std::uint32_t exchange_from(const Arguments& arguments, const CircuitDesign& design) {
  if (!arguments.given("--exchange")) return has_register(*design.architecture, "exchange") ? 1 : 0;
  return static_cast<std::uint32_t>(arguments.integer("--exchange", 0, design.registers.particles / design.lanes));
}

}  // namespace

std::vector<OptionSpec> circuit_options() {
  return {
      {"--arch", "KIND", "imh", "kind of filter: " + listed(architecture_names()), "Circuit"},
      {"-n,--particles", "N", "1000", "particles, from 1 to 65536", "Circuit"},
      {"--draws", "Q", "", "imh: proposals a step beside the burn-in, at least N [N]", "Circuit"},
      {"--burn-in", "NB", "0", "imh: proposals that the chain forgets", "Circuit"},
      {"--chain-mean", "", "", "imh: estimate from the kept states instead of all weighted proposals", "Circuit"},
      {"--overlap", "", "", "imh: begin a step while the one before is still decided on", "Circuit"},
      {"--proposal", "NAME", "prior", "auxiliary: where new particles come from (see mote models NAME)", "Circuit"},
      {"--lanes", "L", "", "chains, pairs of imh-chain, lanes or groups: a power of two [4]", "Circuit"},
      {"--ii", "K", "1",
       "cycles from a particle to the next, from 1 to 16: costly operators of the model take turns (imh, imh-parallel, "
       "auxiliary, sisr, sisr-lanes)",
       "Circuit"},
      {"--tables", "KIND", "blocks", "where large tables stand: in blocks of memory, or in logic (look-up tables)",
       "Circuit"},
      {"--more-bits", "B", "0", "bits after the point, of every word, more than chosen: from -8 to 8", "Circuit"},
      {"--exchange", "M", "", "groups: children that each group has from the one before it, to N/L [1]", "Circuit"},
      {"--resampler", "KIND", "", "sisr, sisr-plain, groups: " + listed(kResamplers) + " [systematic]", "Circuit"},
      {"--loops", "KIND", "", "sisr-plain: " + listed(kLoops) + " [separate]", "Circuit"},
      {"--instances", "I", "1", "circuits side by side, one for each copy of ungm with --set copies=2", "Circuit"},
      {"--seed", "S", "1", "seed of the circuit's generators; same seed, same words", "Circuit"},
      {"--registers", "KIND", "ports", "how registers are reached: ports or axi-lite (an AXI4-Lite bus)", "Circuit"},
      {"--synth", "FAMILY", "", "what it takes of a device: xc7, ice40 or ecp5 (Yosys, nextpnr) [none]", "Checks"}};
}

CircuitDesign circuit_design_from(const Arguments& arguments) {
  CircuitDesign design;
  design.architecture = &architectures()[arguments.choice("--arch", architecture_names())];
  const long long particles = arguments.integer("--particles", 1, kMostInCircuit);
  design.registers.particles = static_cast<std::uint32_t>(particles);
  design.registers.draws = static_cast<std::uint32_t>(
      arguments.given("--draws") ? arguments.integer("--draws", particles, kMostInCircuit) : particles);
  design.registers.burn_in = static_cast<std::uint32_t>(arguments.integer("--burn-in", 0, kMostInCircuit));
  design.registers.chain_mean = arguments.given("--chain-mean");
  design.instances = static_cast<unsigned>(arguments.integer("--instances", 1, 2));
  design.where = arguments.where();
  design.proposal = arguments.text("--proposal");
  design.more_bits = static_cast<int>(arguments.integer("--more-bits", -8, 8));
  design.interval = static_cast<int>(arguments.integer("--ii", 1, 16));
  if (family_from(arguments) == hardware::Family::kIce40) design.multiplier = hardware::Multiplier::kLogic;
  design.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 9223372036854775807LL));
  design.lanes = lanes_from(arguments, design);
  design.variant = variant_from(arguments);
  design.access = static_cast<hardware::RegisterAccess>(arguments.choice("--registers", {"ports", "axi-lite"}));
  if (design.access == hardware::RegisterAccess::kAxiLite && design.instances > 1)
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), "--registers", "ports with --instances", "\"axi-lite\"", "Leave it out."});
  design.registers.exchange = exchange_from(arguments, design);
  refuse_unread(arguments, design);
  refuse_overlapped_turns(arguments, design);
  refuse_uneven(arguments, design);
  return design;
}

std::optional<hardware::Family> family_from(const Arguments& arguments) {
  if (!arguments.given("--synth")) return std::nullopt;
  return static_cast<hardware::Family>(arguments.choice("--synth", {"xc7", "ice40", "ecp5"}));
}

}  // namespace mote
