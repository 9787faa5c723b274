#pragma once
/// The univariate non-stationary growth model, in one or several independent copies.

#include <array>
#include <cstdint>

#include "mote/model/densities.hpp"
#include "mote/model/model.hpp"
#include "mote/model/parameter.hpp"

namespace mote {

struct UngmParameters {
  double a = 0.5, omega = 1.2, q = 10, r = 1, p0 = 5;
};

struct UngmObservation;
struct UngmObservationSum;

/// Growth model [kitagawa1987, gordon1993] in `Copies` independent copies, each observed by itself:
///
///   x_t = a x_{t-1} + 25 x_{t-1} / (1 + x_{t-1}^2) + 8 cos(omega (t - 1)) + N(0, q),   y_t = x_t^2 / 20 + N(0, r)
///
/// shape   x, y: (Copies,)
/// source  FPGA (3, 4) with a = 1/2, omega = 1.2; IMH-OPT (41, 42) with a = 1, omega = 2
template <std::size_t Copies>
struct Ungm {
  using Parameters = UngmParameters;
  template <class S>
  using State = std::array<S, Copies>;
  using Proposals = std::tuple<Prior, UngmObservation, UngmObservationSum>;

  static constexpr std::array<Parameter<Parameters>, 5> kParameters{{
      {"a", &Parameters::a, Range::kAny, "", "linear gain of the drift"},
      {"omega", &Parameters::omega, Range::kAny, "rad", "phase per step of the drift's cosine"},
      {"q", &Parameters::q, Range::kNotNegative, "", "variance of the state noise"},
      {"r", &Parameters::r, Range::kPositive, "", "variance of the measurement noise"},
      {"p0", &Parameters::p0, Range::kNotNegative, "", "variance of x_0"},
  }};

  Parameters p{};

  std::vector<Quantity> states() const {
    if (Copies == 1) return {{"x", ""}};
    return {{"x", ""}, {"y", ""}};
  }
  std::vector<Column> columns() const {
    if (Copies == 1) return {{"y", ""}};
    return {{"y1", ""}, {"y2", ""}};
  }
  /// One of the copies by itself: the whole is their product.
  Ungm<1> part() const requires(Copies > 1) { return {p}; }
  Density density() const { return p.q > 0 ? Density::kState : Density::kNone; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    State<S> x{};
    for (S& component : x) component = S(std::sqrt(p.p0)) * draw.normal();
    return x;
  }

  /// The state before its noise: f(x, t).
  template <class S>
  S drift(Step t, const S& x) const {
    return x * (S(p.a) + S(25) / (S(1) + x * x)) + S(8 * std::cos(p.omega * (t - 1)));
  }

  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    State<S> x{};
    for (std::size_t c = 0; c < Copies; ++c) x[c] = drift(t, before[c]) + S(std::sqrt(p.q)) * draw.normal();
    return x;
  }

  template <class S>
  S log_likelihood(Step, const State<S>& x, const Row<S>& y) const {
    const NormalDensity error(p.r);
    S sum = S(0);
    for (std::size_t c = 0; c < Copies; ++c)
      if (y.seen(c)) sum = sum + error.log(y[c] - x[c] * x[c] * S(0.05));
    return sum;
  }

  template <class S>
  S log_transition(Step t, const State<S>& x, const State<S>& before) const {
    S sum = S(0);
    for (std::size_t c = 0; c < Copies; ++c) sum = sum + normal_log_density(x[c] - drift(t, before[c]), p.q);
    return sum;
  }

  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>&, D& draw) const {
    std::vector<S> y;
    for (const S& component : x) y.push_back(component * component * S(0.05) + S(std::sqrt(p.r)) * draw.normal());
    return Row<S>::of(std::move(y));
  }
};

/// A mixture of two normal modes, per copy: what both proposals of the growth model are.
template <class S>
struct TwoModes {
  S low, high;    // means
  S weight_high;  // probability of the high mode
  S sd;           // of both

  template <class D>
  S draw_from(D& draw) const {
    using namespace numbers;
    const S u = draw.uniform();
    return select(less(u, weight_high), high, low) + sd * draw.normal();
  }
  S log_density(const S& x) const {
    using namespace numbers;
    const S a = (x - low) / sd;
    const S b = (x - high) / sd;
    const S sum = (S(1) - weight_high) * exp(S(-0.5) * a * a) + weight_high * exp(S(-0.5) * b * b);
    return log(sum) - log(sd) - S(0.5 * std::log(2 * kPi));
  }
};

/// The first measurement of copy c in the rows, or nullptr.
template <class S>
const S* measurement(Rows<S> rows, std::size_t c) {
  for (const Row<S>& row : rows)
    if (row.seen(c)) return &row[c];
  return nullptr;
}

/// IMH-OPT (50) read literally: observation plus prediction, x ~ N(+-sqrt(20 |y|) + f(x_{t-1}), 1), both signs alike.
///
/// A step without a measurement of a copy proposes that copy from N(f, 1). The modes are far from the posterior's
/// unless the prediction is near zero; shown because the paper prints it.
struct UngmObservationSum {
  static constexpr std::string_view kName = "observation-sum";
  static constexpr std::string_view kMeaning =
      "IMH-OPT (50) as printed: modes at prediction +- sqrt(20 |y|), variance 1";

  template <class S, std::size_t C, class D>
  std::array<S, C> propose(const Ungm<C>& model, Step t, const std::array<S, C>& before, Rows<S> y, D& draw) const {
    std::array<S, C> x{};
    for (std::size_t c = 0; c < C; ++c) x[c] = modes(model, t, before[c], measurement(y, c)).draw_from(draw);
    return x;
  }
  template <class S, std::size_t C>
  S log_density(const Ungm<C>& model, Step t, const std::array<S, C>& x, const std::array<S, C>& before,
                Rows<S> y) const {
    S sum = S(0);
    for (std::size_t c = 0; c < C; ++c) sum = sum + modes(model, t, before[c], measurement(y, c)).log_density(x[c]);
    return sum;
  }

 private:
  template <class S, std::size_t C>
  static TwoModes<S> modes(const Ungm<C>& model, Step t, const S& before, const S* y) {
    using namespace numbers;
    const S centre = model.drift(t, before);
    const S offset = y == nullptr ? S(0) : sqrt(S(20) * abs(*y));
    return {centre - offset, centre + offset, S(0.5), S(1)};
  }
};

/// What (50) means: modes near +-sqrt(20 max(y, 0)), blended with the prediction by their precisions, and a defensive
/// prior part.
///
///   g = 1/5 N(f, q) + 4/5 [ c N(m+, v) + (1 - c) N(m-, v) ],   h = s / 10,  1/v' = 1/q + h^2 / r,  v = 2 v'
///   m+- = v' (f / q +- h^2 s / r),   c by the predictive densities of the modes;   s = sqrt(20 max(y, 0))
///
/// the likelihood linearised at +-s; without a measurement g is the prior
struct UngmObservation {
  static constexpr std::string_view kName = "observation";
  static constexpr std::string_view kMeaning =
      "modes near +-sqrt(20 max(y,0)) blended with the prediction, one fifth from the prior";
  static constexpr double kDefensive = 0.2;

  template <class S, std::size_t C, class D>
  std::array<S, C> propose(const Ungm<C>& model, Step t, const std::array<S, C>& before, Rows<S> y, D& draw) const {
    using namespace numbers;
    std::array<S, C> x{};
    for (std::size_t c = 0; c < C; ++c) {
      const S centre = model.drift(t, before[c]);
      const S* measured = measurement(y, c);
      const S which = draw.uniform();
      const S guided = modes(model.p, centre, measured).draw_from(draw);
      const S plain = centre + S(std::sqrt(model.p.q)) * draw.normal();
      x[c] = measured == nullptr ? plain : select(less(which, S(kDefensive)), plain, guided);
    }
    return x;
  }
  template <class S, std::size_t C>
  S log_density(const Ungm<C>& model, Step t, const std::array<S, C>& x, const std::array<S, C>& before,
                Rows<S> y) const {
    using namespace numbers;
    S sum = S(0);
    for (std::size_t c = 0; c < C; ++c) {
      const S centre = model.drift(t, before[c]);
      const S* measured = measurement(y, c);
      const S plain = normal_log_density(x[c] - centre, model.p.q);
      if (measured == nullptr) {
        sum = sum + plain;
      } else {
        const S guided = modes(model.p, centre, measured).log_density(x[c]);
        sum = sum + log(S(kDefensive) * exp(plain) + S(1 - kDefensive) * exp(guided));
      }
    }
    return sum;
  }

 private:
  template <class S>
  static TwoModes<S> modes(const UngmParameters& p, const S& centre, const S* y) {
    using namespace numbers;
    const S clipped = y == nullptr ? S(0) : (abs(*y) + *y) * S(0.5);
    const S s = sqrt(S(20) * clipped);
    const S precision = s * s * S(0.01 / p.r);
    const S variance = S(1) / (S(1 / p.q) + precision);
    const S high = variance * (centre * S(1 / p.q) + precision * s);
    const S low = variance * (centre * S(1 / p.q) - precision * s);
    // log odds of the modes: N(s; f, q + 1/precision) against N(-s; f, q + 1/precision)
    const S odds = exp(S(-2) * s * centre * precision / (S(1) + S(p.q) * precision));
    return {low, high, S(1) / (S(1) + odds), sqrt(S(2) * variance)};
  }
};

}  // namespace mote
