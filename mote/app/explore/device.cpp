#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "mote/app/circuits/simulation.hpp"
#include "mote/app/commands/rtl_options.hpp"
#include "mote/app/explore/filters.hpp"
#include "mote/app/explore/parts.hpp"
#include "mote/app/terminal/shell.hpp"
#include "mote/app/terminal/suggestion.hpp"
#include "mote/base/refusal.hpp"

namespace mote::explore {
namespace {

/// What a device has; all of the fabric that clocks are estimated for (Artix-7, speed grade -1).
struct Resources {
  std::string_view name;
  int lut, ff, dsp, bram18;
};

/// source  AMD DS180 and DS190: product tables of the 7 series and of Zynq-7000
constexpr Resources kDevices[] = {{"xc7a15t", 10400, 20800, 45, 50},      {"xc7a35t", 20800, 41600, 90, 100},
                                  {"xc7a50t", 32600, 65200, 120, 150},    {"xc7a75t", 47200, 94400, 180, 210},
                                  {"xc7a100t", 63400, 126800, 240, 270},  {"xa7a100t", 63400, 126800, 240, 270},
                                  {"xc7a200t", 134600, 269200, 740, 730}, {"xc7z010", 17600, 35200, 80, 120},
                                  {"xc7z020", 53200, 106400, 220, 280}};

const Resources& resources_of(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const Resources& device : kDevices) {
    if (device.name == name) return device;
    names.emplace_back(device.name);
  }
  throw Refusal(ExitCode::kWrongUse, {where, "--target", fmt::format("fpga: with one of {}", fmt::join(names, ", ")),
                                      '"' + name + '"', hint(name, names, "Pass --target fpga:xc7a100t.")});
}

/// Particles of the filters that are synthesised.
constexpr std::uint32_t kAnchor = 1024;

/// Kinds of circuits, with what each is tried with beside lanes.
const std::vector<std::pair<std::string, std::vector<std::string>>>& circuits() {
  static const std::vector<std::pair<std::string, std::vector<std::string>>> all{{"imh", {" --overlap"}},
                                                                                 {"imh-parallel", {" --overlap"}},
                                                                                 {"imh-chain", {" --overlap"}},
                                                                                 {"auxiliary", {}},
                                                                                 {"sisr", {""}},
                                                                                 {"sisr-lanes", {""}},
                                                                                 {"groups", {""}},
                                                                                 {"sisr-plain", {" --loops merged"}}};
  return all;
}

bool has_lanes(const std::string& kind) {
  return kind == "imh-parallel" || kind == "imh-chain" || kind == "sisr-lanes" || kind == "groups";
}

class Device final : public Target {
 public:
  Device(const Space& space, Recording counted)
      : space_(space), device_(resources_of(space.detail, space.where)), counted_(std::move(counted)) {
    std::vector<std::string> names;
    for (const auto& [kind, variants] : circuits()) names.push_back(kind);
    std::vector<Words> all;
    const std::vector<std::string> kinds = kinds_of(space_, names);
    if (!space_.workers.empty() && std::none_of(kinds.begin(), kinds.end(), has_lanes))
      throw Refusal(ExitCode::kWrongUse, {space_.where, "--workers", "a kind of circuit with lanes",
                                          fmt::format("--kinds {}", fmt::join(kinds, ",")), "Leave it out."});
    for (const std::string& kind : kinds) {
      if (kind == "auxiliary" && space_.kinds.empty()) continue;  // pipelines of its own: only where it is asked for
      for (const std::string& variant : variants_of(kind))
        for (const std::size_t lanes : lanes_of(kind))
          for (const std::size_t n : particles())
            for (const int bits : more_bits()) all.push_back(words_of(kind, variant, lanes, n, bits));
    }
    const std::string needs = "circuits with particles, auxiliary ones with a proposal of the model's own";
    candidates_ = accepted(space_, all, needs, [&](const Words& words) { add_pipelines(design_of(words)); });
  }

  std::string name() const override { return fmt::format("fpga:{}", device_.name); }
  std::string meaning() const override {
    return "cycles by the golden models, area and clock by synthesis of the parts, power by a model of resources";
  }
  std::vector<Figure> figures() const override {
    return {{"time", "s", "--deadline"},          {"area", "of the device", "", true, 1},
            {"power", "mW", "--max-power"},       {"lut", "", "--max-lut", false},
            {"ff", "", "--max-ff", false},        {"dsp", "", "--max-dsp", false},
            {"bram18", "", "--max-bram", false},  {"clock", "MHz", "", false},
            {"lanes", "", "--max-workers", false}};
  }
  const std::vector<Words>& candidates() const override { return candidates_; }
  bool measures() const override { return false; }

  /// Every part once: whole circuits before pipelines, which take less.
  std::vector<Piece> shared_work() const override {
    std::map<std::string, Part> anchors;
    std::map<std::string, Part> pipelines;
    for (const Words& words : candidates_) {
      const CircuitDesign design = design_of(words);
      const FilterCircuit circuit = circuit_of(design);
      const FilterCircuit anchor = circuit_of(anchor_of(design));
      const Parts parts = parts_of(*circuit.machine, {*anchor.machine, kAnchor});
      anchors.try_emplace(parts.anchor.name, parts.anchor);
      for (const Part* pipeline : {&parts.propose, &parts.weigh, &parts.anchors_propose, &parts.anchors_weigh})
        pipelines.try_emplace(pipeline->name, *pipeline);
    }
    std::vector<Piece> all;
    for (const auto* kind : {&anchors, &pipelines})
      for (const auto& [name, part] : *kind)
        all.emplace_back([part = part](Memory& memory) { remembered(part, memory); });
    return all;
  }
  std::vector<double> takes(std::size_t c, Memory& memory) const override {
    const CircuitDesign design = design_of(candidates_[c]);
    const FilterCircuit circuit = circuit_of(design);
    const FilterCircuit anchor = circuit_of(anchor_of(design));
    const hardware::Cost cost =
        cost_by_parts(*circuit.machine, design.registers.particles, {*anchor.machine, kAnchor}, memory);
    const auto cycles = memory.recall(fmt::format("cycles {}", fmt::join(candidates_[c], " ")), 1, [&] {
      return std::vector<double>{static_cast<double>(golden_cycles(circuit, design, counted_, space_.where))};
    });
    const auto steps = static_cast<double>(counted_.steps.back().t);
    const double area = std::max({share(cost.lut, device_.lut), share(cost.ff, device_.ff),
                                  share(cost.dsp, device_.dsp), share(cost.bram18, device_.bram18)});
    return {cycles.front() / steps / (*cost.fmax_mhz * 1e6),
            area,
            *cost.power_mw,
            static_cast<double>(cost.lut),
            static_cast<double>(cost.ff),
            static_cast<double>(cost.dsp),
            static_cast<double>(cost.bram18),
            *cost.fmax_mhz,
            static_cast<double>(design.lanes)};
  }
  RunRecord run(std::size_t c, const Recording& recording, std::uint64_t seed) const override {
    CircuitDesign design = design_of(candidates_[c]);
    design.seed = seed;
    return golden_run(circuit_of(design), design, recording, space_.where);
  }
  std::string command(std::size_t c, const std::string& /*data*/) const override {
    return fmt::format("mote rtl {}{} {} --synth xc7 --out {}", shell_word(space_.model), settings_of(space_),
                       fmt::join(candidates_[c], " "), folder_of(candidates_[c]));
  }

 private:
  static double share(int taken, int there) { return static_cast<double>(taken) / there; }

  std::vector<std::size_t> particles() const {
    if (!space_.particles.empty()) return space_.particles;
    return {128, 256, 512, 1024, 2048, 4096};
  }
  std::vector<int> more_bits() const { return space_.more_bits.empty() ? std::vector<int>{-2, 0} : space_.more_bits; }
  /// Of the auxiliary filter every proposal of the model but the prior, with which it is `imh`.
  std::vector<std::string> variants_of(const std::string& kind) const {
    const auto entry =
        std::find_if(circuits().begin(), circuits().end(), [&](const auto& e) { return e.first == kind; });
    std::vector<std::string> all = entry->second;
    if (kind == "auxiliary")
      for (const Named& proposal : find_model(space_.model, space_.where).proposals)
        if (proposal.name != Prior::kName) all.push_back(" --overlap --proposal " + proposal.name);
    return all;
  }
  std::vector<std::size_t> lanes_of(const std::string& kind) const {
    if (!has_lanes(kind)) return {1};
    return space_.workers.empty() ? std::vector<std::size_t>{4} : space_.workers;
  }
  static Words words_of(const std::string& kind, const std::string& variant, std::size_t lanes, std::size_t n,
                        int bits) {
    std::string text = fmt::format("--arch {}{} -n {}", kind, variant, n);
    if (lanes > 1) text += fmt::format(" --lanes {}", lanes);
    if (bits != 0) text += fmt::format(" --more-bits {}", bits);
    return words_in(text);
  }
  CircuitDesign design_of(const Words& words) const {
    return circuit_design_from(arguments_from("mote rtl", circuit_options(), words));
  }

  /// The design whose filter stands for those of other sizes and words: of the words that there are pipelines for, the
  /// nearest to those chosen.
  CircuitDesign anchor_of(CircuitDesign design) const {
    for (const int bits : more_bits()) {
      CircuitDesign other = design;
      other.more_bits = bits;
      const bool nearer = std::pair(std::abs(bits), bits) < std::pair(std::abs(design.more_bits), design.more_bits);
      if (nearer && pipelines_.contains(kind_of(other))) design = other;
    }
    design.registers.particles = design.registers.draws = kAnchor;
    return design;
  }

  /// What pipelines depend on.
  using Kind = std::tuple<std::string, int, bool>;
  static Kind kind_of(const CircuitDesign& design) {
    return {design.proposal, design.more_bits, design.variant.overlapped};
  }
  void add_pipelines(const CircuitDesign& design) {
    const Kind kind = kind_of(design);
    if (pipelines_.find(kind) == pipelines_.end())
      pipelines_.emplace(kind, model_datapath(space_.catalogue_model, space_.model, design));
  }
  FilterCircuit circuit_of(const CircuitDesign& design) const {
    return filter_circuit(space_.catalogue_model, space_.model, design, pipelines_.at(kind_of(design)));
  }

  /// "ungm-sisr-lanes-1000-4--2": names a folder of its own, whatever file the model is.
  std::string folder_of(const Words& words) const {
    const auto is_option = [](const std::string& word) {
      return word.starts_with("-") && !std::isdigit(static_cast<unsigned char>(word[1]));
    };
    std::string name = space_.model.substr(space_.model.find_last_of('/') + 1);
    name = name.substr(0, name.rfind(".toml"));
    for (const std::string& word : words)
      if (!is_option(word)) name += "-" + word;
    return shell_word(name);
  }

  Space space_;
  Resources device_;
  Recording counted_;
  std::map<Kind, ModelDatapath> pipelines_;
  std::vector<Words> candidates_;
};

}  // namespace

std::unique_ptr<Target> device(const Space& space, const Recording& counted) {
  return std::make_unique<Device>(space, counted);
}

}  // namespace mote::explore
