#include "mote/analog/netlist.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>

namespace mote::analog {
namespace {

constexpr double kLoad_v = 0.9;  // where the next stage holds the output

std::string plain(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

/// Writes a netlist, line by line.
class Writer {
 public:
  Writer(const Translinear& circuit, const Setting& setting)
      : circuit_(circuit),
        setting_(setting),
        thermal_v_(thermal_voltage(setting.conditions.temperature_c)),
        names_(devices(circuit)) {}

  std::vector<std::string> lines(const Input& input) {
    line("* {}", name_of(circuit_.function));
    line("vdd vdd 0 {}", setting_.conditions.supply_v);
    line("vout {} 0 {}", plain(circuit_.output), kLoad_v);
    write_input(input);
    for (const Mite& mite : circuit_.mites) write_mite(mite);
    if (setting_.level == Level::kIdeal) {
      write_perfect_mirrors();
    } else {
      write_mirrors();
    }
    for (const auto& [node, farad] : capacitance_) line("c{} {} 0 {:.6e}", plain(node), plain(node), farad + kWire_f);
    write_guesses();
    line(".options abstol=1e-20 gmin=1e-18 reltol=1e-8 vntol=1e-11 chgtol=1e-21 itl1=2000 itl2=2000 itl4=200");
    return std::move(lines_);
  }

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> text, Values&&... values) {
    lines_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  double factor(const std::string& device) const {
    if (setting_.deviations.empty()) return 1;
    const auto place = std::find(names_.begin(), names_.end(), device) - names_.begin();
    return std::exp(setting_.deviations[static_cast<std::size_t>(place)]);
  }

  /// I_s and I_spec at the temperature, as ln(I_s / I_spec).
  double threshold(const Transistor& transistor) const {
    return std::log(preexponential_current(transistor, setting_.conditions.temperature_c) /
                    specific_current(transistor, setting_.conditions.temperature_c));
  }

  /// The current of a saturated transistor over its output resistance: `drive` is v, `across` V_ds.
  std::string channel(const Transistor& transistor, double width, const std::string& drive,
                      const std::string& across) const {
    return fmt::format("{:.12e}*ln(1+exp(0.5*({}{:+.12g})))^2*(1-exp(-{:.12g}*{}))*(1+{:.12g}*{})",
                       width * specific_current(transistor, setting_.conditions.temperature_c), drive,
                       threshold(transistor), 1 / thermal_v_, across, 1 / transistor.early_v, across);
  }

  void write_input(const Input& input) {
    const double amount = input.step * setting_.ia_a;
    const double edge = input.length_s / 1000;
    if (input.length_s == 0) {
      line("iin 0 {} 0", plain(circuit_.input));
    } else {
      line("iin 0 {} pwl(0 0 {:.9e} 0 {:.9e} {:.9e} {:.9e} {:.9e} {:.9e} 0)", plain(circuit_.input), input.length_s,
           input.length_s + edge, amount, 2 * input.length_s, amount, 2 * input.length_s + edge);
    }
  }

  void write_mite(const Mite& mite) {
    const double width = mite.width * factor(mite.name);
    const std::string drive =
        fmt::format("{:.12g}*(v({})+v({}))", kMite.kappa / thermal_v_, plain(mite.gates[0]), plain(mite.gates[1]));
    const std::string drain = plain(mite.drain);
    if (setting_.level == Level::kIdeal) {
      line("{} {} 0 i={:.12e}*exp({})", source_name(mite.name), drain,
           width * preexponential_current(kMite, setting_.conditions.temperature_c), drive);
    } else {
      line("{} {} 0 i={}", source_name(mite.name), drain, channel(kMite, width, drive, "v(" + drain + ")"));
    }
    for (const std::string& gate : mite.gates) capacitance_[gate] += mite.width * kMite.gate_f;
  }

  /// A p-channel transistor from the supply into a node.
  void write_transistor(const std::string& device, const std::string& gate, const std::string& drain, double width) {
    const std::string drive = fmt::format("{:.12g}*(v(vdd)-v({}))", kMirror.kappa / thermal_v_, plain(gate));
    line("{} vdd {} i={}", source_name(device), plain(drain),
         channel(kMirror, width * factor(device), drive, fmt::format("(v(vdd)-v({}))", plain(drain))));
    capacitance_[gate] += width * kMirror.gate_f;
  }

  void write_mirrors() {
    line("iref reference 0 {:.12e}", setting_.ia_a);
    write_transistor("reference", "reference", "reference", 1);
    for (const Bias& bias : circuit_.biases) write_transistor("bias." + bias.node, "reference", bias.node, bias.times);
    for (const Mirror& mirror : circuit_.mirrors) {
      write_transistor("in." + mirror.from, mirror.from, mirror.from, 1);
      write_transistor("out." + mirror.from, mirror.from, mirror.to, mirror.ratio);
    }
  }

  void write_perfect_mirrors() {
    for (const Bias& bias : circuit_.biases)
      line("ibias_{} vdd {} {:.12e}", plain(bias.node), plain(bias.node),
           bias.times * setting_.ia_a * factor("bias." + bias.node) / factor("reference"));
    for (const Mirror& mirror : circuit_.mirrors) {
      const std::string from = plain(mirror.from);
      line("vmirror_{} vdd {} 1", from, from);
      line("fmirror_{} vdd {} vmirror_{} {:.12g}", from, plain(mirror.to), from,
           mirror.ratio * factor("out." + mirror.from) / factor("in." + mirror.from));
    }
  }

  /// Where the solver starts: every current I_a, as about x = 0. From elsewhere it may find no output at all.
  void write_guesses() {
    const double temperature_c = setting_.conditions.temperature_c;
    const double mite =
        thermal_v_ / (2 * kMite.kappa) * std::log(setting_.ia_a / preexponential_current(kMite, temperature_c));
    const double mirror =
        setting_.conditions.supply_v -
        thermal_v_ / kMirror.kappa * std::log(setting_.ia_a / preexponential_current(kMirror, temperature_c));
    std::string guesses = ".nodeset";
    for (const Mite& each : circuit_.mites)
      if (each.gates[0] == each.drain || each.gates[1] == each.drain)
        guesses += fmt::format(" v({})={:.6g}", plain(each.drain), mite);
    if (setting_.level == Level::kRealistic) {
      guesses += fmt::format(" v(reference)={:.6g}", mirror);
      for (const Mirror& each : circuit_.mirrors) guesses += fmt::format(" v({})={:.6g}", plain(each.from), mirror);
    }
    lines_.push_back(guesses);
  }

  const Translinear& circuit_;
  const Setting& setting_;
  double thermal_v_;
  std::vector<std::string> names_;
  std::map<std::string, double> capacitance_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> netlist(const Translinear& circuit, const Setting& setting, const Input& input) {
  return Writer(circuit, setting).lines(input);
}

std::string source_name(const std::string& device) { return "b" + plain(device); }

}  // namespace mote::analog
