#pragma once
/// Log densities that models share, generic in the number type.

#include <cmath>

#include "mote/base/log_gamma.hpp"
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
  const double constant = log_gamma((dof + 1) / 2) - log_gamma(dof / 2) - 0.5 * std::log(dof * kPi) - std::log(scale);
  return S(constant) - S((dof + 1) / 2) * log(S(1) + residual * residual * S(1 / (dof * scale * scale)));
}

/// The curvature that stands for Student's -log density in a Gauss-Newton step: its gradient is weight times residual.
///
///   (v + 1) / (v + e^2);   1 for dof = 0, a normal error
///
/// shape   residual in scales
template <class S>
S student_weight(const S& residual, double dof) {
  return dof > 0 ? S(dof + 1) / (S(dof) + residual * residual) : S(1);
}

/// A draw of Student's t by Bailey's polar formula.
///
///   sqrt(v (U1^(-2/v) - 1)) cos(2 pi U2)
///
/// shape   dof v > 0; takes two uniforms
/// source  Bailey 1994, Polar generation of random variates with the t-distribution
template <class S, class D>
S student(double dof, D& draw) {
  using namespace numbers;
  const S u = draw.uniform();
  const S angle = draw.uniform();
  return sqrt(S(dof) * (exp(log(u) * S(-2 / dof)) - S(1))) * cos(S(2 * kPi) * angle);
}

}  // namespace mote
