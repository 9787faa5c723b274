#pragma once
/// Log densities that models share, generic in the number type.

#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote {

/// The normal density of one variance, its constants computed once.
///
///   log N(e; 0, variance) = -e^2 / (2 variance) - log(2 pi variance) / 2
///
/// shape   variance > 0, the same for all particles
///
/// A log_likelihood that makes one before it asks whether a value was seen has its constants taken out of the loop over
/// particles; behind a condition they are computed for every vector of particles.
class NormalDensity {
 public:
  explicit NormalDensity(double variance) : scale_(-0.5 / variance), constant_(-0.5 * std::log(2 * kPi * variance)) {}

  template <class S>
  S log(const S& residual) const {
    return residual * residual * S(scale_) + S(constant_);
  }

 private:
  double scale_, constant_;
};

/// log N(e; 0, variance) for one use.
template <class S>
S normal_log_density(const S& residual, double variance) {
  return NormalDensity(variance).log(residual);
}

/// Student's log density with `dof` degrees of freedom and a scale.
///
///   log [ Gamma((v+1)/2) / (Gamma(v/2) sqrt(v pi) s) ] - (v+1)/2 log(1 + e^2 / (v s^2))
///
/// shape   dof > 0, scale > 0
template <class S>
S student_log_density(const S& residual, double scale, double dof) {
  using namespace numbers;
  const double constant =
      std::lgamma((dof + 1) / 2) - std::lgamma(dof / 2) - 0.5 * std::log(dof * kPi) - std::log(scale);
  return S(constant) - S((dof + 1) / 2) * log(S(1) + residual * residual * S(1 / (dof * scale * scale)));
}

}  // namespace mote
