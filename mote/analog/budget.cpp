#include "mote/analog/budget.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::analog {
namespace {

std::array<Power, kImplementations> of(Power method1, Power method2, Power digital, Power method3) {
  return {method1, method2, digital, method3};
}

Power nonlinear(const Load& load, Implementation i) {
  if (i == Implementation::kDigital) return {2 * cordic_power(load.process, load.bits, load.clock_hz), 0};
  const double comparator = i == Implementation::kMethod3 ? kComparatorPower : 0;
  return {load.arctan_w + load.gaussian_w + comparator, 0};
}

/// How many circuits a rate asks for; rounding asks for none more.
double copies_for(const Load& load, Implementation implementation, double rate_hz) {
  return std::ceil(rate_hz / rate_of_copy(load, implementation) * (1 - 1e-9));
}

}  // namespace

std::string name_of(Implementation implementation) {
  constexpr std::array<const char*, kImplementations> kNames{"Method-1", "Method-2", "digital (ASIC)",
                                                             "Method-3 (IMH)"};
  return kNames[static_cast<std::size_t>(implementation)];
}

std::vector<Operation> table5(const Load& load) {
  using I = Implementation;
  const Power adders{load.additions * adder_power(load.rate_hz), 0};
  const Power digital_mac{0, kAnalogMacSaving};
  const Power mac{0, 1};
  return {{"nonlinear functions",
           of(nonlinear(load, I::kMethod1), nonlinear(load, I::kMethod2), nonlinear(load, I::kDigital),
              nonlinear(load, I::kMethod3)),
           10e-6},
          {"ADC/DAC", of({load.dac.power_w + load.adc.power_w, 0}, {}, {}, {}), 1e-3},
          {"additions", of(adders, {}, adders, {}), 10e-6},
          {"multiply-accumulate", of(digital_mac, mac, digital_mac, mac), 0}};
}

std::vector<Operation> left_out(const Load& load) {
  const Power words{random_words_power(load.normals, load.rate_hz), 0};
  const Power chain_words{random_words_power(load.normals + 1, load.rate_hz), 0};  // a uniform one decides a step
  return {{"ADC that reads weights for the resampler", of({}, {load.adc.power_w, 0}, {}, {}), 0},
          {"random numbers", of(words, {load.normals * kNoiseSourcePower, 0}, words, chain_words), 0}};
}

Power overall(const std::vector<Operation>& rows, Implementation implementation, bool rounded) {
  Power sum;
  for (const Operation& row : rows) {
    Power power = row.power[static_cast<std::size_t>(implementation)];
    const double whole = row.rounded_to_w > 0 ? row.rounded_to_w * std::round(power.watt / row.rounded_to_w) : 0;
    if (rounded && whole > 0) power.watt = whole;
    sum = sum + power;
  }
  return sum;
}

double saving(const Power& a, const Power& b, double mac_w) { return a.at(mac_w) / b.at(mac_w); }

std::array<double, 2> saving_range(const Power& a, const Power& b) {
  const auto [least, most] = std::minmax({saving(a, b, 0), a.macs / b.macs});
  return {least, most};
}

double most_mac_for_saving(const Power& a, const Power& b, double times) {
  const double ahead = a.watt - times * b.watt;
  const double loss = times * b.macs - a.macs;
  if (loss <= 0) return ahead >= 0 ? kInfinity : -1;
  return ahead / loss;
}

double rate_of_copy(const Load& load, Implementation implementation) {
  return implementation == Implementation::kMethod1 ? std::min({load.rate_hz, load.dac.rate_hz, load.adc.rate_hz})
                                                    : load.rate_hz;
}

double power_at_rate(const Load& load, Implementation implementation, double rate_hz, double mac_w) {
  Load follows = load;
  follows.rate_hz = rate_hz;
  follows.clock_hz = rate_hz;
  const auto rows = table5(follows);
  const auto place = static_cast<std::size_t>(implementation);
  const bool analog = implementation != Implementation::kDigital;
  const double copies = copies_for(load, implementation, rate_hz);
  const double digital_mac = kAnalogMacSaving * mac_w * rate_hz / load.rate_hz;
  const bool analog_mac = implementation == Implementation::kMethod2 || implementation == Implementation::kMethod3;
  return (analog ? copies : 1) * (rows[0].power[place].watt + rows[1].power[place].watt) + rows[2].power[place].watt +
         (analog_mac ? copies * mac_w : digital_mac);
}

double whole_power_at_rate(const Load& load, Implementation implementation, double rate_hz, double mac_w) {
  Load follows = load;
  follows.rate_hz = rate_hz;
  const double rest = overall(left_out(follows), implementation, false).watt;
  const bool in_copies = implementation == Implementation::kMethod2;
  return power_at_rate(load, implementation, rate_hz, mac_w) +
         (in_copies ? copies_for(load, implementation, rate_hz) : 1) * rest;
}

double crossover(const Load& load, Implementation a, Implementation b, double mac_w, double least_hz, double most_hz) {
  constexpr int kSteps = 400;
  double found = kNaN;
  for (int k = kSteps; k >= 0; --k) {
    const double rate = least_hz * std::pow(most_hz / least_hz, k / static_cast<double>(kSteps));
    if (power_at_rate(load, a, rate, mac_w) > power_at_rate(load, b, rate, mac_w)) break;
    found = rate;
  }
  return found;
}

}  // namespace mote::analog
