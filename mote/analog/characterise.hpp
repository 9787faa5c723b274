#pragma once
/// From a circuit to a behaviour: simulate, judge, fit.

#include "mote/analog/technology.hpp"

namespace mote::analog {

/// The behaviour of a circuit, fitted to simulations that are made now: 201 points of its steady states, 200 between
/// them for the residual, a pulse from 0 to 1 and back for the settling time, and each device by itself off by 1 %, for
/// mismatch and noise.
///
///   noise   var y = sum over devices of (dy / d ln I_k)^2 2 q B / I_k,   B = 1 / (4 tau), tau = settling / ln 512
///
/// error   Refusal (kOutsideTool) when ngspice is missing or finds no solution; Refusal (kWrongUse) for an I_a, a
///         temperature or a supply that no such circuit works at
/// cost    about a second
Behaviour characterised(Function function, double ia_a, Level level, const Conditions& conditions = {});

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
