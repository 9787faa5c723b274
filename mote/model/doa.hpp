#pragma once
/// Direction of arrival from frames of noisy directions of one source.

#include <array>

#include "mote/model/densities.hpp"
#include "mote/model/guided.hpp"
#include "mote/model/model.hpp"
#include "mote/model/parameter.hpp"

namespace mote {

struct DoaParameters {
  double sigma_theta = 0.02, sigma_q = 0.005, sigma_phi = 0.05, sigma_o = 0.05;
  double theta0 = 0.5, q0 = 0.05, phi0 = 0.8;
  double sd_theta = 0.2, sd_q = 0.02, sd_phi = 0.3;
  double correlation = 0, dof = 0;
};

/// A source at direction theta, with velocity-to-range ratio q and heading phi, seen in frames of M directions:
///
///   tan theta' = (sin theta + q sin phi) / (cos theta + q cos phi) + v1,   in the undisturbed direction's half plane
///   q'   = q / sqrt(1 + q^2 + 2 q cos(theta - phi)) + v2
///   phi' = phi + v3
///   y_m = theta + e_m,   e ~ N(0, V) or Student's t(dof) of M dimensions,   m = 1..M
///   V = sigma_o^2 [ (1 - correlation) I + correlation 1 1' ]
///
/// The papers' model has correlation 0 and Gaussian errors: log p(y | theta) = K - sum_m wrap(y_m - theta)^2 / (2
/// sigma_o^2).
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
  using Proposals = std::tuple<Prior, Guided>;
  static constexpr std::size_t kNoise = 3;

  static constexpr std::array<Parameter<Parameters>, 12> kParameters{{
      {"sigma_theta", &Parameters::sigma_theta, Range::kNotNegative, "",
       "standard deviation of the noise on tan theta"},
      {"sigma_q", &Parameters::sigma_q, Range::kNotNegative, "1/step", "standard deviation of the noise on q"},
      {"sigma_phi", &Parameters::sigma_phi, Range::kNotNegative, "rad", "standard deviation of the noise on phi"},
      {"sigma_o", &Parameters::sigma_o, Range::kPositive, "rad",
       "standard deviation (scale, with dof) of one measured direction"},
      {"theta0", &Parameters::theta0, Range::kAny, "rad", "mean of theta at t = 0"},
      {"q0", &Parameters::q0, Range::kAny, "1/step", "mean of q at t = 0"},
      {"phi0", &Parameters::phi0, Range::kAny, "rad", "mean of phi at t = 0"},
      {"sd_theta", &Parameters::sd_theta, Range::kNotNegative, "rad", "standard deviation of theta at t = 0"},
      {"sd_q", &Parameters::sd_q, Range::kNotNegative, "1/step", "standard deviation of q at t = 0"},
      {"sd_phi", &Parameters::sd_phi, Range::kNotNegative, "rad", "standard deviation of phi at t = 0"},
      {"correlation", &Parameters::correlation, Range::kFraction, "",
       "correlation of the errors of two directions in one frame"},
      {"dof", &Parameters::dof, Range::kNotNegative, "",
       "degrees of freedom of Student's t error of a whole frame; 0 = Gaussian"},
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
    const NormalDensity error(p.sigma_o * p.sigma_o);
    if (p.correlation > 0 || p.dof > 0) return joint_log_likelihood(x[0], y);
    S sum = S(0);
    for (std::size_t m = 0; m < frame; ++m)
      if (y.seen(m)) sum = sum + error.log(wrap(y[m] - x[0]));
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

  template <class S>
  std::array<S, kNoise> noise(Step, const State<S>& x, const State<S>& before) const {
    using namespace numbers;
    const Undisturbed<S> u = undisturbed(before);
    return {(tan(x[0]) - u.sine / u.cosine) * S(1 / p.sigma_theta), (x[1] - u.q) * S(1 / p.sigma_q),
            wrap(x[2] - before[2]) * S(1 / p.sigma_phi)};
  }

  /// One innovation a frame: its mean error, which alone depends on the state.
  template <class S, class Add>
  void innovations(Step, const State<S>& x, const Row<S>& y, Add add) const {
    const Errors<S> e = errors(x[0], y);
    if (e.each.empty()) return;
    const auto n = static_cast<double>(e.each.size());
    const S residual = e.mean * S(std::sqrt(n / along(n)));
    add(residual, p.dof > 0 ? S(p.dof + n) / (S(p.dof) + mahalanobis(e)) : S(1));
  }

  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>&, D& draw) const {
    using namespace numbers;
    // each error given those before it is normal, or Student's t with one more degree of freedom each time
    std::vector<S> y;
    S sum = S(0);
    S squares = S(0);  // Mahalanobis
    for (std::size_t m = 0; m < frame; ++m) {
      const auto k = static_cast<double>(m);
      const double gain = m == 0 ? 0 : p.correlation / (1 + (k - 1) * p.correlation);
      const double sd = p.sigma_o * std::sqrt(1 - k * p.correlation * gain);
      const S expected = S(gain) * sum;
      const S noise =
          p.dof > 0 ? sqrt((S(p.dof) + squares) * S(1 / (p.dof + k))) * student<S>(p.dof + k, draw) : S(draw.normal());
      const S error = expected + S(sd) * noise;
      sum = sum + error;
      squares = squares + noise * noise;
      y.push_back(wrap(x[0] + error));
    }
    return Row<S>::of(std::move(y));
  }

 private:
  /// log density of the n errors that are seen, n = 1..M; V has the eigenvalue 1 + (n - 1) correlation along the mean
  /// error, 1 - correlation across.
  ///
  ///   delta = n mean(e)^2 / (sigma_o^2 (1 + (n - 1) c)) + sum (e - mean(e))^2 / (sigma_o^2 (1 - c))
  ///   N: -delta / 2 - log |2 pi V| / 2;   t: log [ Gamma((v+n)/2) / Gamma(v/2) ] - log |v pi V| / 2 - (v+n)/2 log(1 +
  ///   delta / v)
  template <class S>
  S joint_log_likelihood(const S& theta, const Row<S>& y) const {
    using namespace numbers;
    const Errors<S> e = errors(theta, y);
    if (e.each.empty()) return S(0);
    const auto n = static_cast<double>(e.each.size());
    const double half_log_det = 0.5 * (std::log(along(n)) + (n - 1) * std::log(across()));
    const S delta = mahalanobis(e);
    if (p.dof <= 0) return S(-0.5) * delta - S(half_log_det + 0.5 * n * std::log(2 * kPi));
    const double v = p.dof;
    const double constant = log_gamma((v + n) / 2) - log_gamma(v / 2) - 0.5 * n * std::log(v * kPi) - half_log_det;
    return S(constant) - S((v + n) / 2) * log(S(1) + delta * S(1 / v));
  }

  /// The errors of the directions that are seen, and their mean.
  template <class S>
  struct Errors {
    SmallVector<S> each;
    S mean;
  };
  template <class S>
  Errors<S> errors(const S& theta, const Row<S>& y) const {
    using namespace numbers;
    Errors<S> e{{}, S(0)};
    for (std::size_t m = 0; m < frame; ++m) {
      if (!y.seen(m)) continue;
      e.each.push_back(wrap(y[m] - theta));
      e.mean = e.mean + e.each.back();
    }
    if (!e.each.empty()) e.mean = e.mean * S(1 / static_cast<double>(e.each.size()));
    return e;
  }
  double along(double n) const { return p.sigma_o * p.sigma_o * (1 + (n - 1) * p.correlation); }
  double across() const { return p.sigma_o * p.sigma_o * (1 - p.correlation); }
  /// delta of the errors.
  template <class S>
  S mahalanobis(const Errors<S>& e) const {
    const auto n = static_cast<double>(e.each.size());
    S delta = e.mean * e.mean * S(n / along(n));
    for (const S& error : e.each) delta = delta + (error - e.mean) * (error - e.mean) * S(1 / across());
    return delta;
  }

  template <class S>
  struct Undisturbed {
    S sine, cosine, q;  // sine and cosine up to a common positive factor
  };
  template <class S>
  [[gnu::always_inline]] static Undisturbed<S> undisturbed(
      const State<S>& x) {  // g++ leaves out some calls' flattening
    using namespace numbers;
    const S q = x[1];
    const auto theta = sin_cos(x[0]);
    const auto phi = sin_cos(x[2]);
    const S sine = theta.sine + q * phi.sine;
    const S cosine = theta.cosine + q * phi.cosine;
    return {sine, cosine, q / sqrt(sine * sine + cosine * cosine)};  // 1 + q^2 + 2 q cos(theta - phi)
  }
};

}  // namespace mote
