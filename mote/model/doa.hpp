#pragma once
/// Direction of arrival from frames of noisy directions of one source.

#include <array>

#include "mote/model/densities.hpp"
#include "mote/model/model.hpp"
#include "mote/model/parameter.hpp"

namespace mote {

struct DoaParameters {
  double sigma_theta = 0.02, sigma_q = 0.005, sigma_phi = 0.05, sigma_o = 0.05;
  double theta0 = 0.5, q0 = 0.05, phi0 = 0.8;
  double sd_theta = 0.2, sd_q = 0.02, sd_phi = 0.3;
};

/// A source at direction theta, with velocity-to-range ratio q and heading phi, seen in frames of M directions:
///
///   tan theta' = (sin theta + q sin phi) / (cos theta + q cos phi) + v1,   in the undisturbed direction's half plane
///   q'   = q / sqrt(1 + q^2 + 2 q cos(theta - phi)) + v2
///   phi' = phi + v3
///   log p(y | theta) = K - sum_m wrap(y_m - theta)^2 / (2 sigma_o^2),   m = 1..M
///
/// shape   state (theta, q, phi), angles in rad and wrapped; a frame (M,), missing entries skipped
/// source  IMH-HW (14), (15); docs/models.md, its density docs/filters.md (F32)
///
/// v1 sits on tan theta, so the density of theta' carries the Jacobian sec^2 theta' and vanishes in the other half
/// plane.
struct Doa {
  using Parameters = DoaParameters;
  template <class S>
  using State = std::array<S, 3>;
  using Proposals = std::tuple<Prior>;

  static constexpr std::array<Parameter<Parameters>, 10> kParameters{{
      {"sigma_theta", &Parameters::sigma_theta, Range::kNotNegative, "",
       "standard deviation of the noise on tan theta"},
      {"sigma_q", &Parameters::sigma_q, Range::kNotNegative, "1/step", "standard deviation of the noise on q"},
      {"sigma_phi", &Parameters::sigma_phi, Range::kNotNegative, "rad", "standard deviation of the noise on phi"},
      {"sigma_o", &Parameters::sigma_o, Range::kPositive, "rad", "standard deviation of one measured direction"},
      {"theta0", &Parameters::theta0, Range::kAny, "rad", "mean of theta at t = 0"},
      {"q0", &Parameters::q0, Range::kAny, "1/step", "mean of q at t = 0"},
      {"phi0", &Parameters::phi0, Range::kAny, "rad", "mean of phi at t = 0"},
      {"sd_theta", &Parameters::sd_theta, Range::kNotNegative, "rad", "standard deviation of theta at t = 0"},
      {"sd_q", &Parameters::sd_q, Range::kNotNegative, "1/step", "standard deviation of q at t = 0"},
      {"sd_phi", &Parameters::sd_phi, Range::kNotNegative, "rad", "standard deviation of phi at t = 0"},
  }};

  Parameters p{};
  std::size_t frame = 1;  ///< M, the number of doa columns

  std::vector<Quantity> states() const { return {{"theta", "rad", true}, {"q", "1/step"}, {"phi", "rad", true}}; }
  std::vector<Column> columns() const {
    std::vector<Column> all;
    for (std::size_t m = 1; m <= frame; ++m)
      all.push_back({.name = "doa" + std::to_string(m), .unit = "rad", .state = "theta", .angle = true});
    return all;
  }
  Density density() const {
    return p.sigma_theta > 0 && p.sigma_q > 0 && p.sigma_phi > 0 ? Density::kState : Density::kNone;
  }

  template <class S, class D>
  State<S> initial(D& draw) const {
    using namespace numbers;
    const S theta = S(p.theta0) + S(p.sd_theta) * draw.normal();
    const S q = S(p.q0) + S(p.sd_q) * draw.normal();
    const S phi = S(p.phi0) + S(p.sd_phi) * draw.normal();
    return {wrap(theta), q, wrap(phi)};
  }

  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    using namespace numbers;
    const Undisturbed<S> u = undisturbed(before);
    const S v1 = S(p.sigma_theta) * draw.normal();
    const S v2 = S(p.sigma_q) * draw.normal();
    const S v3 = S(p.sigma_phi) * draw.normal();
    // atan2(num + v den, den) has tangent num/den + v and keeps the sign of den: the quadrant of the undisturbed
    // direction
    return {atan2(u.sine + v1 * u.cosine, u.cosine), u.q + v2, wrap(before[2] + v3)};
  }

  template <class S>
  S log_likelihood(Step, const State<S>& x, const Row<S>& y) const {
    using namespace numbers;
    S sum = S(0);
    for (std::size_t m = 0; m < frame; ++m)
      if (y.seen(m)) sum = sum + normal_log_density(wrap(y[m] - x[0]), p.sigma_o * p.sigma_o);
    return sum;
  }

  template <class S>
  S log_transition(Step, const State<S>& x, const State<S>& before) const {
    using namespace numbers;
    const Undisturbed<S> u = undisturbed(before);
    const S cosine = cos(x[0]);
    const S v1 = tan(x[0]) - u.sine / u.cosine;
    const S in_theta = normal_log_density(v1, p.sigma_theta * p.sigma_theta) - log(cosine * cosine);
    const S in_q = normal_log_density(x[1] - u.q, p.sigma_q * p.sigma_q);
    const S in_phi = normal_log_density(wrap(x[2] - before[2]), p.sigma_phi * p.sigma_phi);
    return select(less(cosine * u.cosine, S(0)), S(-kInfinity), in_theta + in_q + in_phi);
  }

  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>&, D& draw) const {
    using namespace numbers;
    std::vector<S> y;
    for (std::size_t m = 0; m < frame; ++m) y.push_back(wrap(x[0] + S(p.sigma_o) * draw.normal()));
    return Row<S>::of(std::move(y));
  }

 private:
  template <class S>
  struct Undisturbed {
    S sine, cosine, q;  // sine and cosine up to a common positive factor
  };
  template <class S>
  static Undisturbed<S> undisturbed(const State<S>& x) {
    using namespace numbers;
    const S q = x[1];
    const S stretch = S(1) + q * q + S(2) * q * cos(x[0] - x[2]);
    return {sin(x[0]) + q * sin(x[2]), cos(x[0]) + q * cos(x[2]), q / sqrt(stretch)};
  }
};

}  // namespace mote
