#pragma once
/// Budgets: what a filter takes by Method-1, 2, 3 and as a digital circuit, and against the rate of particles.

#include <array>
#include <string>
#include <vector>

#include "mote/analog/power.hpp"

namespace mote::analog {

/// watt + macs P, with P what one analog multiply-accumulate takes.
struct Power {
  double watt = 0, macs = 0;

  double at(double mac_w) const { return watt + macs * mac_w; }
  friend Power operator+(const Power& a, const Power& b) { return {a.watt + b.watt, a.macs + b.macs}; }
};

/// The contenders of MIXED, Table V, and Method-3.
enum class Implementation { kMethod1, kMethod2, kDigital, kMethod3 };
inline constexpr std::size_t kImplementations = 4;
std::string name_of(Implementation implementation);

/// What a budget is of.
struct Load {
  double arctan_w = printed_arctan_power(10e-9);  ///< the circuits, at the currents that they are counted at
  double gaussian_w = printed_gaussian_power(10e-9);
  ConverterSheet dac = tlc5615(), adc = ads7830();
  Process process;
  int bits = 12;                  ///< of the CORDIC
  double clock_hz = 1e6;          ///< of the CORDIC
  double rate_hz = kCircuitRate;  ///< particles a second of one circuit, that adders follow
  int additions = 6;              ///< of a particle's move, MIXED (1)
  int normals = 2;                ///< normal numbers of a particle's move
};

/// A row of Table V: nonlinear functions, converters, additions, multiply-accumulate.
struct Operation {
  std::string name;
  std::array<Power, kImplementations> power;
  double rounded_to_w = 0;  ///< as the paper rounds: "nearly 120 uW", "nearly 1 mW"; 0: not at all
};

/// Table V from the components, Method-3 beside it.
///
///   Method-3: arctangent, squarer (no more than the Gaussian of which it is the first half), comparator, P
///
/// shape   rows in the paper's order
std::vector<Operation> table5(const Load& load);

/// What Table V leaves out: an ADC by which Method-2's resampler reads weights, and random numbers.
std::vector<Operation> left_out(const Load& load);

/// The sum of rows; rounded as the paper rounds each, or as they are. What would be rounded to nothing stays as it is.
Power overall(const std::vector<Operation>& rows, Implementation implementation, bool rounded);

/// How many times less `b` takes than `a`, at P.
double saving(const Power& a, const Power& b, double mac_w);

/// How many times less `b` takes than `a` over all P: at P = 0 and for large P, the least first.
std::array<double, 2> saving_range(const Power& a, const Power& b);

/// The largest P at which `b` takes `times` less than `a`: infinity if it always does, negative if never.
double most_mac_for_saving(const Power& a, const Power& b, double times);

/// Particles a second of one circuit with its converters.
double rate_of_copy(const Load& load, Implementation implementation);

/// Power of an implementation that is to handle `rate_hz` particles a second. Digital parts follow the rate; circuits
/// and converters take their power all the time, and as many copies work side by side as the rate asks for, each of
/// load.rate_hz, to which P belongs.
///
/// unit    watt
double power_at_rate(const Load& load, Implementation implementation, double rate_hz, double mac_w);

/// The same with what Table V leaves out: the ADC of Method-2 and the random numbers.
double whole_power_at_rate(const Load& load, Implementation implementation, double rate_hz, double mac_w);

/// The least rate from which on `a` takes no more than `b` up to `most_hz`; NaN if it does nowhere.
///
/// cost    some hundred evaluations
double crossover(const Load& load, Implementation a, Implementation b, double mac_w, double least_hz = 1,
                 double most_hz = 1e8);

}  // namespace mote::analog
