#pragma once
// The contract of the analog room: a Behaviour is a circuit as a filter sees it, a function fitted to a simulation.
// characterised() makes one (characterise.hpp); whoever runs a filter takes it by value and needs no simulator any
// more.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mote/base/draws.hpp"

namespace mote::analog {

/// What a circuit computes of its normalised input x = I_in / I_a, as y = I_out / I_a.
enum class Function {
  kArctan,   ///< y = arctan(x) in rad: I_a is 1 rad
  kGaussian  ///< y = exp(-x^2 / 2)
};

/// I_a of the tracker's circuits in ampere; the Gaussian's stands for sigma_r = 0.29 degrees.
///
/// source  MIXED, Table III
constexpr double table3_current(Function function) { return function == Function::kArctan ? 10e-9 : 0.1e-9; }

/// How much of the transistors a simulation has.
enum class Level {
  kIdeal,     ///< the MITE law and perfect mirrors
  kRealistic  ///< weak to strong inversion, finite output resistance, mirrors of transistors
};

/// Inputs are characterised from -10 to +10 I_a (MIXED, Table II).
inline constexpr double kRange = 10;

/// What a draw of a circuit is for: purposes behind those of filters.
inline constexpr Purpose kMismatch{64};  ///< which die: one draw a device
inline constexpr Purpose kNoise{65};     ///< noise of an evaluation

/// y = arctan(x) or exp(-x^2 / 2), exactly.
double exact(Function function, double x);

/// "arctan" or "gaussian".
std::string name_of(Function function);

/// A function on [-kRange, kRange] as a cubic between equidistant points; outside it keeps its values there.
///
/// cost    O(1), about 5 ns
class Curve {
 public:
  Curve() = default;
  /// The curve through the points, with the slopes of the natural cubic spline.
  ///
  /// shape   values: two or more, at equal distances from -kRange to kRange
  explicit Curve(const std::vector<double>& values);

  double operator()(double x) const {
    const double place = std::clamp((x + kRange) * per_unit_, 0.0, last_);
    const std::size_t k = std::min(static_cast<std::size_t>(place), cells_.size() - 1);
    const double d = place - static_cast<double>(k);
    const Cell& c = cells_[k];
    return c.c0 + d * (c.c1 + d * (c.c2 + d * c.c3));
  }

 private:
  struct Cell {
    double c0, c1, c2, c3;
  };
  std::vector<Cell> cells_{{0, 0, 0, 0}};
  double per_unit_ = 0, last_ = 0;
};

/// What ln I of each device of a circuit deviates by on a die: normal numbers of these standard deviations, drawn at
/// (seed, die), each circuit's in a stream of its own.
std::vector<double> deviations_of_die(Function function, const std::vector<double>& sds, std::uint64_t seed,
                                      std::uint32_t die);

/// How a device's current differs between dies, and what it does to the output.
struct Sensitivity {
  std::string device;
  double sd = 0;  ///< of ln I, from die to die
  Curve slope;    ///< dy / d ln I
};

/// A circuit as a function of its normalised input.
class Behaviour {
 public:
  /// What is known of it. Errors are in units of y (I_a), over |x| <= kRange.
  struct Facts {
    Function function = Function::kArctan;
    Level level = Level::kRealistic;
    double ia_a = 0;          ///< I_a, in ampere
    double rms = 0;           ///< root mean square of y - exact
    double worst = 0;         ///< largest |y - exact|
    double residual = 0;      ///< largest |curve - simulation| at points between those fitted
    double power_w = 0;       ///< of the 3 V supply, mirrors and bias included: the largest over the input
    double settling_s = 0;    ///< after a step of the input, until y is within 1/512 of its end: half a step of 8 bits
    double bandwidth_hz = 0;  ///< of the noise: that of one pole that settles so
  };

  Behaviour(Facts facts, Curve transfer, Curve power, Curve noise, std::vector<Sensitivity> devices);

  /// y at x = I_in / I_a, without noise.
  double operator()(double x) const { return transfer_(x); }
  /// y with noise, for a standard normal number; NaN stays NaN.
  double noisy_at(double x, double normal) const {
    if (std::isnan(x)) return x;
    return noisy_ ? transfer_(x) + noise_sd(x) * normal : transfer_(x);
  }
  /// Whether there is any noise.
  bool noisy() const { return noisy_; }
  /// Standard deviation of the noise of y: shot noise of every device in the circuit's own bandwidth.
  double noise_sd(double x) const { return std::max(0.0, noise_(x)); }
  /// Power drawn from the supply, in watt.
  double power_w(double x) const { return power_(x); }

  const Facts& facts() const { return facts_; }
  /// "arctan, realistic, I_a 10 nA".
  std::string name() const;
  const std::vector<Sensitivity>& devices() const { return devices_; }

  /// The same circuit on die number `die`: devices differ as Pelgrom's law says, by draws addressed by (seed, die).
  ///
  ///   y_die(x) = y(x) + sum_k e_k dy/d ln I_k,   e = deviations_of_die()
  ///
  /// Of its facts, the errors are the die's, the others the circuit's.
  ///
  /// cost    O(devices x points), some 50 us
  Behaviour on_die(std::uint64_t seed, std::uint32_t die) const;

 private:
  Facts facts_;
  Curve transfer_, power_, noise_;
  bool noisy_ = false;
  std::vector<Sensitivity> devices_;
};

}  // namespace mote::analog
