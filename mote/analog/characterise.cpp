#include "mote/analog/characterise.hpp"

#include <cmath>
#include <limits>

#include "mote/analog/simulation.hpp"
#include "mote/base/refusal.hpp"

namespace mote::analog {
namespace {

constexpr std::size_t kFine = 100, kCoarse = 25;  // steps from 0 to kRange: of a fit, of what is small
constexpr double kOff = 0.01;                     // of ln I, for a sensitivity

/// Standard deviations of ln I, in the order of devices().
std::vector<double> deviation_sds(const Translinear& circuit, bool trimmed) {
  std::vector<double> sds;
  for (const Mite& mite : circuit.mites) sds.push_back(deviation_sd(kMite, mite.width, trimmed));
  sds.push_back(deviation_sd(kMirror, 1, trimmed));
  for (const Bias& bias : circuit.biases) sds.push_back(deviation_sd(kMirror, bias.times, trimmed));
  for (const Mirror& mirror : circuit.mirrors) {
    sds.push_back(deviation_sd(kMirror, 1, trimmed));
    sds.push_back(deviation_sd(kMirror, mirror.ratio, trimmed));
  }
  return sds;
}

/// dy / d ln I of each device over the input, by differences.
std::vector<std::vector<double>> slopes(const Translinear& circuit, Setting setting, const std::vector<double>& y) {
  std::vector<std::vector<double>> all(devices(circuit).size());
  for (std::size_t d = 0; d < all.size(); ++d) {
    setting.deviations.assign(all.size(), 0.0);
    setting.deviations[d] = kOff;
    all[d] = swept(circuit, setting, kCoarse).y;
    for (std::size_t k = 0; k < all[d].size(); ++k) all[d][k] = (all[d][k] - y[k]) / kOff;
  }
  return all;
}

std::vector<Sensitivity> sensitivities(const Translinear& circuit, const std::vector<std::vector<double>>& slope,
                                       bool trimmed) {
  const std::vector<std::string> names = devices(circuit);
  const std::vector<double> sds = deviation_sds(circuit, trimmed);
  std::vector<Sensitivity> all;
  for (std::size_t d = 0; d < names.size(); ++d) all.push_back({names[d], sds[d], Curve(slope[d])});
  return all;
}

std::vector<double> noise(const Translinear& circuit, const Sweep& sweep, double bandwidth_hz,
                          const std::vector<std::vector<double>>& slope) {
  const std::vector<std::string> names = devices(circuit);
  std::vector<double> sd(sweep.x.size());
  for (std::size_t k = 0; k < sd.size(); ++k) {
    double variance = 0;
    for (std::size_t d = 0; d < names.size(); ++d)
      if (const auto current = sweep.current_a.find(names[d]); current != sweep.current_a.end())
        variance += slope[d][k] * slope[d][k] * 2 * kElectron_c * bandwidth_hz / std::abs(current->second[k]);
    sd[k] = std::sqrt(variance);
  }
  return sd;
}

double largest_residual(const Curve& curve, const Sweep& fresh) {
  double largest = 0;
  for (std::size_t k = 0; k < fresh.x.size(); ++k)
    largest = std::max(largest, std::abs(curve(fresh.x[k]) - fresh.y[k]));
  return largest;
}

/// The devices that a netlist has as sources of their own: perfect mirrors have none.
std::vector<std::string> watched(const Translinear& circuit, Level level) {
  std::vector<std::string> names = devices(circuit);
  if (level == Level::kIdeal) names.resize(circuit.mites.size());
  return names;
}

double rms_error(Function function, const Sweep& sweep) {
  double squares = 0;
  for (std::size_t k = 0; k < sweep.x.size(); ++k)
    squares += (sweep.y[k] - exact(function, sweep.x[k])) * (sweep.y[k] - exact(function, sweep.x[k]));
  return std::sqrt(squares / static_cast<double>(sweep.x.size()));
}

double error_of_die(const Translinear& circuit, const Setting& setting) {
  try {
    return rms_error(circuit.function, swept(circuit, setting, kCoarse));
  } catch (const Refusal& refusal) {
    if (refusal.code() != ExitCode::kOutsideTool) throw;
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

Behaviour characterised(Function function, double ia_a, Level level, const Conditions& conditions, Detail detail) {
  const Translinear circuit = translinear(function);
  const Setting setting{level, ia_a, conditions};
  const Sweep fine = swept(circuit, setting, kFine);
  const Curve transfer(fine.y);
  Behaviour::Facts facts{.function = function, .level = level, .ia_a = ia_a};
  facts.residual = largest_residual(transfer, swept(circuit, setting, kFine, true));
  facts.power_w = *std::max_element(fine.power_w.begin(), fine.power_w.end());
  facts.settling_s = settling_time(circuit, setting, 1);
  facts.bandwidth_hz = std::log(512.0) / (4 * facts.settling_s);
  const Curve power(fine.power_w);
  if (detail == Detail::kTransfer) return {facts, transfer, power, {}, {}};
  const Sweep coarse = swept(circuit, setting, kCoarse, false, {watched(circuit, level)});
  const std::vector<std::vector<double>> slope = slopes(circuit, setting, coarse.y);
  return {facts, transfer, power, Curve(noise(circuit, coarse, facts.bandwidth_hz, slope)),
          sensitivities(circuit, slope, conditions.trimmed)};
}

double Dies::yield(double most) const {
  const auto first_above = std::upper_bound(rms.begin(), rms.end(), most);
  return static_cast<double>(first_above - rms.begin()) / static_cast<double>(rms.size());
}

double Dies::quantile(double share) const {
  return rms[static_cast<std::size_t>(std::lround(share * static_cast<double>(rms.size() - 1)))];
}

Dies simulated_dies(Function function, double ia_a, const Conditions& conditions, std::uint64_t seed,
                    std::uint32_t count) {
  const Translinear circuit = translinear(function);
  const std::vector<double> sds = deviation_sds(circuit, conditions.trimmed);
  Dies dies;
  for (std::uint32_t die = 1; die <= count; ++die)
    dies.rms.push_back(
        error_of_die(circuit, {Level::kRealistic, ia_a, conditions, deviations_of_die(function, sds, seed, die)}));
  std::sort(dies.rms.begin(), dies.rms.end());
  return dies;
}

}  // namespace mote::analog
