#pragma once
/// From a circuit to a behaviour: simulate, judge, fit.

#include "mote/analog/technology.hpp"

namespace mote::analog {

/// How much of a circuit is looked at.
enum class Detail {
  kTransfer,  ///< no noise, and all dies alike
  kDevices    ///< each device by itself off by 1 %: mismatch and noise, at ten times the cost
};

/// The behaviour of a circuit, fitted to simulations that are made now: 201 points of its steady states, 200 between
/// them for the residual, a pulse of the input from 0 to I_a and back for the settling time.
///
///   noise   var y = sum over devices of (dy / d ln I_k)^2 2 q B / I_k,   B = 1 / (4 tau), tau = settling / ln 512
///
/// error   Refusal (kOutsideTool) when ngspice is missing or finds no solution; Refusal (kWrongUse) for an I_a, a
///         temperature or a supply that no such circuit works at
/// cost    0.1 s; with its devices a second or two
Behaviour characterised(Function function, double ia_a, Level level, const Conditions& conditions = {},
                        Detail detail = Detail::kDevices);

/// Errors of dies, each simulated with all its devices off at once: the least first.
struct Dies {
  std::vector<double> rms;  ///< of y, in units of I_a
  /// The share of dies whose error is at most this.
  double yield(double most) const;
  double quantile(double share) const;
};

/// Simulates dies 1 to `count`, drawn as Behaviour::on_die() draws them.
///
/// error   as characterised(); a die whose solution is not found, or is another, has error infinity
/// cost    about 20 ms a die
Dies simulated_dies(Function function, double ia_a, const Conditions& conditions, std::uint64_t seed,
                    std::uint32_t count);

}  // namespace mote::analog
