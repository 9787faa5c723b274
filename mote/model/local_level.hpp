#pragma once
/// The local-level model: a random walk seen in noise. Exactly solvable.

#include <array>

#include "mote/model/densities.hpp"
#include "mote/model/guided.hpp"
#include "mote/model/model.hpp"
#include "mote/model/parameter.hpp"

namespace mote {

struct LocalLevelParameters {
  double var_level = 1469.1, var_obs = 15099, level0 = 1120, p0 = 1e5;
};

struct LocalLevelOptimal;

/// Local level:  x_t = x_{t-1} + N(0, var_level),   y_t = x_t + N(0, var_obs),   x_0 ~ N(level0, p0).
///
/// The defaults are the maximum-likelihood variances of the Nile's annual flow 1871-1970.
/// source  Durbin & Koopman 2012, ch. 2
struct LocalLevel {
  using Parameters = LocalLevelParameters;
  template <class S>
  using State = std::array<S, 1>;
  using Proposals = std::tuple<Prior, LocalLevelOptimal, Guided>;
  static constexpr std::size_t kNoise = 1;

  static constexpr std::array<Parameter<Parameters>, 4> kParameters{{
      {"var_level", &Parameters::var_level, Range::kNotNegative, "", "variance of the level's step"},
      {"var_obs", &Parameters::var_obs, Range::kPositive, "", "variance of the measurement noise"},
      {"level0", &Parameters::level0, Range::kAny, "", "mean of x_0"},
      {"p0", &Parameters::p0, Range::kNotNegative, "", "variance of x_0"},
  }};

  Parameters p{};

  std::vector<Quantity> states() const { return {{"level", ""}}; }
  std::vector<Column> columns() const { return {{.name = "y", .unit = "", .state = "level"}}; }
  Density density() const { return p.var_level > 0 ? Density::kState : Density::kNone; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    return {S(p.level0) + S(std::sqrt(p.p0)) * draw.normal()};
  }
  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    return {before[0] + S(std::sqrt(p.var_level)) * draw.normal()};
  }
  template <class S>
  S log_likelihood(Step, const State<S>& x, const Row<S>& y) const {
    const NormalDensity error(p.var_obs);
    return y.seen(0) ? error.log(y[0] - x[0]) : S(0);
  }
  template <class S>
  S log_transition(Step, const State<S>& x, const State<S>& before) const {
    return normal_log_density(x[0] - before[0], p.var_level);
  }
  template <class S>
  std::array<S, kNoise> noise(Step, const State<S>& x, const State<S>& before) const {
    return {(x[0] - before[0]) * S(1 / std::sqrt(p.var_level))};
  }
  template <class S, class Add>
  void innovations(Step, const State<S>& x, const Row<S>& y, Add add) const {
    if (y.seen(0)) add((y[0] - x[0]) * S(1 / std::sqrt(p.var_obs)), S(1));
  }
  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>&, D& draw) const {
    return Row<S>::of({x[0] + S(std::sqrt(p.var_obs)) * draw.normal()});
  }
};

/// The optimal proposal p(x_t | x_{t-1}, y_t): its weight does not depend on the draw.
///
///   1/v = 1/var_level + n/var_obs,   mean = v (x_{t-1}/var_level + sum y/var_obs),   n measurements in the step
struct LocalLevelOptimal {
  static constexpr std::string_view kName = "optimal";
  static constexpr std::string_view kMeaning = "p(x_t | x_{t-1}, y_t), exact for this model";

  template <class S, class D>
  std::array<S, 1> propose(const LocalLevel& model, Step, const std::array<S, 1>& before, Rows<S> y, D& draw) const {
    const Conditional<S> c = conditional(model.p, before[0], y);
    return {c.mean + S(std::sqrt(c.variance)) * draw.normal()};
  }
  template <class S>
  S log_density(const LocalLevel& model, Step, const std::array<S, 1>& x, const std::array<S, 1>& before,
                Rows<S> y) const {
    const Conditional<S> c = conditional(model.p, before[0], y);
    return normal_log_density(x[0] - c.mean, c.variance);
  }

 private:
  template <class S>
  struct Conditional {
    S mean;
    double variance;
  };
  template <class S>
  static Conditional<S> conditional(const LocalLevelParameters& p, const S& before, Rows<S> rows) {
    double precision = 1 / p.var_level;
    S weighted = before * S(1 / p.var_level);
    for (const Row<S>& row : rows) {
      if (!row.seen(0)) continue;
      precision += 1 / p.var_obs;
      weighted = weighted + row[0] * S(1 / p.var_obs);
    }
    return {weighted * S(1 / precision), 1 / precision};
  }
};

}  // namespace mote
