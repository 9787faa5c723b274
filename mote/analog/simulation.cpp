#include "mote/analog/simulation.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mote/analog/spice.hpp"
#include "mote/base/refusal.hpp"

namespace mote::analog {
namespace {

constexpr double kFarOff = 0.5;
constexpr double kHalfStep = 1.0 / 512;  // of 8 bits
constexpr double kSteps = 120;           // of the time that a pulse is high, at least
constexpr int kLengthened = 8;           // times that a transient is made twice as long

void refuse_outside(const char* what, double value, double least, double most, const char* unit, const char* next) {
  if (value >= least && value <= most) return;  // NaN is refused
  throw Refusal(ExitCode::kWrongUse, {"analog circuit", what, fmt::format("{:g} to {:g} {}", least, most, unit),
                                      fmt::format("{:g}", value), next});
}

[[noreturn]] void refuse_points(const Translinear& circuit, const std::string& expected, const std::string& got) {
  throw Refusal(ExitCode::kOutsideTool,
                {"ngspice", name_of(circuit.function), expected, got, "Choose another I_a, temperature or supply."});
}

std::string node_name(std::string node) {
  std::replace(node.begin(), node.end(), '.', '_');
  return "v(" + node + ")";
}

/// Reads the points of one half off the simulator and puts them behind those of `sweep`.
void note(Sweep& sweep, const Setting& setting, const Watch& watch, std::size_t points, double first, double step) {
  const Spice& spice = Spice::loaded();
  const std::vector<double> out = spice.values("vout#branch");
  const std::vector<double> supply = spice.values("vdd#branch");
  for (std::size_t k = 0; k < std::min(points, out.size()); ++k) {
    const double x = first + static_cast<double>(k) * step;
    sweep.x.push_back(x);
    sweep.y.push_back(out[k] / setting.ia_a);
    sweep.power_w.push_back(setting.conditions.supply_v * (std::max(x, 0.0) * setting.ia_a - supply[k]));
  }
  const auto behind = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (const std::string& device : watch.devices)
    behind(sweep.current_a[device], spice.values("@" + source_name(device) + "[i]"));
  for (const std::string& node : watch.nodes) behind(sweep.voltage_v[node], spice.values(node_name(node)));
}

/// The points from about 0 to one end, in that order.
Sweep half_sweep(const Translinear& circuit, const Setting& setting, const Watch& watch, std::size_t half, bool between,
                 int sign) {
  const double step = sign * kRange / static_cast<double>(half);
  const double first = between ? step / 2 : 0;
  const std::size_t points = between ? half : half + 1;
  const double last = first + (static_cast<double>(points) - 0.75) * step;
  Spice::loaded().run(
      fmt::format("dc iin {:.15e} {:.15e} {:.15e}", first * setting.ia_a, last * setting.ia_a, step * setting.ia_a));
  Sweep sweep;
  note(sweep, setting, watch, points, first, step);
  if (sweep.x.size() != points)
    refuse_points(circuit, fmt::format("{} points", points), fmt::format("{}", sweep.x.size()));
  return sweep;
}

/// The lower half turned round, without the point 0 that both have, and then the upper.
std::vector<double> joined(std::vector<double> lower, const std::vector<double>& upper, bool both_have_zero) {
  std::reverse(lower.begin(), lower.end());
  if (both_have_zero) lower.pop_back();
  lower.insert(lower.end(), upper.begin(), upper.end());
  return lower;
}

Sweep joined(const Sweep& lower, const Sweep& upper, bool between) {
  Sweep all{joined(lower.x, upper.x, !between), joined(lower.y, upper.y, !between),
            joined(lower.power_w, upper.power_w, !between)};
  for (const auto& [name, values] : upper.current_a)
    all.current_a[name] = joined(lower.current_a.at(name), values, !between);
  for (const auto& [name, values] : upper.voltage_v)
    all.voltage_v[name] = joined(lower.voltage_v.at(name), values, !between);
  return all;
}

void refuse_another_solution(const Translinear& circuit, const Sweep& sweep) {
  for (std::size_t k = 0; k < sweep.x.size(); ++k)
    if (const double expected = approximation(circuit.function, sweep.x[k]);
        !(std::abs(sweep.y[k] - expected) <= kFarOff))
      refuse_points(circuit, fmt::format("about {:.3f} at x = {:g}", expected, sweep.x[k]),
                    fmt::format("{:.3f}", sweep.y[k]));
}

/// Seconds after `from` until the values stay within half a step of `end`; between two points the error falls evenly.
double settled(const std::vector<double>& time, const std::vector<double>& y, double from, double until, double end) {
  const auto excess = [&](std::size_t k) { return std::abs(y[k] - end) - kHalfStep; };
  double last = from;
  for (std::size_t k = 0; k + 1 < time.size(); ++k)
    if (time[k] > from && time[k] < until && excess(k) > 0)
      last = time[k] + (time[k + 1] - time[k]) * excess(k) / std::max(excess(k) - excess(k + 1), excess(k));
  return last - from;
}

/// The last value before a time.
double value_before(const std::vector<double>& time, const std::vector<double>& y, double moment) {
  const auto after = std::upper_bound(time.begin(), time.end(), moment);
  return y[static_cast<std::size_t>(after - time.begin()) - 1];
}

/// A pulse of the input, of this length: the longer of its two settling times.
double settled_after_pulse(const Translinear& circuit, const Setting& setting, double step, double length_s) {
  Spice& spice = Spice::loaded();
  spice.take(netlist(circuit, setting, {step, length_s}));
  spice.run(fmt::format("tran {:.6e} {:.6e} 0 {:.6e}", length_s / kSteps, 3 * length_s, length_s / kSteps));
  const std::vector<double> time = spice.values("time");
  std::vector<double> y = spice.values("vout#branch");
  for (double& value : y) value /= setting.ia_a;
  return std::max(settled(time, y, length_s, 2 * length_s, value_before(time, y, 2 * length_s)),
                  settled(time, y, 2 * length_s, 3 * length_s, y.back()));
}

}  // namespace

void refuse_absurd(const Setting& setting) {
  refuse_outside("I_a", 1e9 * setting.ia_a, 0.01, 100, "nA", "The paper's are 0.1 to 20 nA.");
  refuse_outside("temperature", setting.conditions.temperature_c, -40, 125, "degrees C", "27 is room temperature.");
  refuse_outside("supply", setting.conditions.supply_v, 2.5, 5.5, "V", "The paper's is 3 V.");
}

Sweep swept(const Translinear& circuit, const Setting& setting, std::size_t half, bool between, const Watch& watch) {
  refuse_absurd(setting);
  std::vector<std::string> lines = netlist(circuit, setting);
  std::string saved = ".save all";
  for (const std::string& device : watch.devices) saved += " @" + source_name(device) + "[i]";
  lines.push_back(saved);
  Spice::loaded().take(lines);
  const Sweep lower = half_sweep(circuit, setting, watch, half, between, -1);
  const Sweep all = joined(lower, half_sweep(circuit, setting, watch, half, between, 1), between);
  refuse_another_solution(circuit, all);
  return all;
}

double settling_time(const Translinear& circuit, const Setting& setting, double step) {
  refuse_absurd(setting);
  const double unit = 2 * kMite.gate_f * thermal_voltage(setting.conditions.temperature_c) / kMite.kappa;
  double length_s = 250 * unit / setting.ia_a;
  for (int k = 0; k < kLengthened; ++k, length_s *= 2)
    if (const double found = settled_after_pulse(circuit, setting, step, length_s); found < length_s / 2) return found;
  refuse_points(circuit, fmt::format("an output that settles within {:g} s", length_s), "none");
}

}  // namespace mote::analog
