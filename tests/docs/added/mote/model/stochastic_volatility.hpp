#pragma once
/// Stochastic volatility: returns whose log variance wanders.

#include <array>

#include "mote/model/densities.hpp"
#include "mote/model/model.hpp"
#include "mote/model/parameter.hpp"

namespace mote {

struct StochasticVolatilityParameters {
  double mu = -1, phi = 0.97, sigma = 0.2, sd0 = 0.8;
};

/// Log variance x of a return y:  x_t = mu + phi (x_{t-1} - mu) + N(0, sigma^2),   y_t = exp(x_t / 2) N(0, 1).
///
/// source  Taylor 1986; Kim, Shephard & Chib 1998, (1)
struct StochasticVolatility {
  using Parameters = StochasticVolatilityParameters;
  template <class S>
  using State = std::array<S, 1>;
  using Proposals = std::tuple<Prior>;

  static constexpr std::array<Parameter<Parameters>, 4> kParameters{{
      {"mu", &Parameters::mu, Range::kAny, "", "mean of the log variance"},
      {"phi", &Parameters::phi, Range::kAny, "", "persistence of the log variance per step"},
      {"sigma", &Parameters::sigma, Range::kNotNegative, "", "standard deviation of its step"},
      {"sd0", &Parameters::sd0, Range::kNotNegative, "", "standard deviation of x_0 about mu"},
  }};

  Parameters p{};

  std::vector<Quantity> states() const { return {{"log_variance", ""}}; }
  std::vector<Column> columns() const { return {{"y", ""}}; }
  std::vector<Function<StochasticVolatility>> functions() const {
    return {{{"volatility", ""}, [](const auto& x) { return std::exp(0.5 * x[0]); }}};
  }
  Density density() const { return p.sigma > 0 ? Density::kState : Density::kNone; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    return {S(p.mu) + S(p.sd0) * draw.normal()};
  }

  /// The state before its noise.
  template <class S>
  S drift(const S& x) const {
    return S(p.mu) + S(p.phi) * (x - S(p.mu));
  }

  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    return {drift(before[0]) + S(p.sigma) * draw.normal()};
  }

  template <class S>
  S log_likelihood(Step, const State<S>& x, const Row<S>& y) const {
    using namespace numbers;
    if (!y.seen(0)) return S(0);
    return S(-0.5) * (x[0] + y[0] * y[0] * exp(-x[0])) - S(0.5 * std::log(2 * kPi));
  }

  template <class S>
  S log_transition(Step, const State<S>& x, const State<S>& before) const {
    return normal_log_density(x[0] - drift(before[0]), p.sigma * p.sigma);
  }

  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>&, D& draw) const {
    using namespace numbers;
    return Row<S>::of({exp(S(0.5) * x[0]) * draw.normal()});
  }
};

}  // namespace mote
