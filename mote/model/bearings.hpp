#pragma once
/// Bearings-only tracking by one or several, still or moving sensors.

#include <array>

#include "mote/model/densities.hpp"
#include "mote/model/guided.hpp"
#include "mote/model/model.hpp"
#include "mote/model/parameter.hpp"

namespace mote {

struct BearingsParameters {
  double period = 1, sigma_u = 0.001, sigma_r = 0.0488692, damping = 1;
  double x0 = 0.250, vx0 = 0.001, y0 = 0.240, vy0 = -0.005;
  double sd_x = 0.02, sd_vx = 0.002, sd_y = 0.02, sd_vy = 0.002;
  double dof = 0, correlation = 0, distortion = 0;
  double sigma_across = 0, cruise = 0;
};

struct BearingsWide;

/// Target with damped velocity, driven by white acceleration, seen by its bearing from a sensor:
///
///   x' = x + T vx + T^2/2 u,  vx' = damping vx + T u,  (y likewise),   u ~ N(0, sigma_u^2) in each axis
///   v' = damping v + (1 - damping) cruise e + T (u_1 e + u_2 n),   with sigma_across or cruise:
///        e = v / |v|, n its normal to the left, u_1 ~ N(0, sigma_u^2), u_2 ~ N(0, sigma_across^2); x' as above
///   b  = atan2(y - sensor_y, x - sensor_x) - sensor_heading
///   z  = b - distortion sin^3 b + r,   r ~ s times N(0, 1) or Student's t(dof)
///   s  = sigma_r sqrt((1 + correlation) / (1 - correlation))
///
/// correlation is that of a sensor's errors in successive steps. The model takes errors for independent; n of them with
/// autocorrelation c tell as much about a resting target as n (1 - c) / (1 + c) independent ones, so each is given the
/// scale that makes it tell so little. distortion: a sensor that sees targets off its axis too near to the axis, by up
/// to that angle; one-to-one below 0.86 rad. A vehicle keeps its course better than its speed, and its speed is not
/// drawn to 0: sigma_across below sigma_u and cruise say so. A target at rest has the course of the x axis.
///
/// shape   state (x, vx, y, vy) in m, m/s; a row is one bearing in rad, relative to the sensor's heading
/// source  MIXED (1)-(3): T = 1 s, damping 1, the sensor at the origin; docs/models.md
///
/// The noise has two dimensions in a state of four: p(x_t | x_{t-1}) has no density there. log_transition is the
/// density of u (Density::kNoise): ratios p/g are right, mixture sums over parents are not; docs/filters.md (F31).
struct Bearings {
  using Parameters = BearingsParameters;
  template <class S>
  using State = std::array<S, 4>;
  using Proposals = std::tuple<Prior, BearingsWide, Guided>;
  static constexpr std::size_t kNoise = 2;

  static constexpr std::array<Parameter<Parameters>, 17> kParameters{{
      {"period", &Parameters::period, Range::kPositive, "s", "time between steps"},
      {"sigma_u", &Parameters::sigma_u, Range::kNotNegative, "m/s^2",
       "standard deviation of the acceleration, per axis"},
      {"sigma_r", &Parameters::sigma_r, Range::kPositive, "rad",
       "standard deviation (scale, with dof) of the bearing error"},
      {"damping", &Parameters::damping, Range::kAny, "", "factor on the velocity per step"},
      {"x0", &Parameters::x0, Range::kAny, "m", "mean of x at t = 0"},
      {"vx0", &Parameters::vx0, Range::kAny, "m/s", "mean of vx at t = 0"},
      {"y0", &Parameters::y0, Range::kAny, "m", "mean of y at t = 0"},
      {"vy0", &Parameters::vy0, Range::kAny, "m/s", "mean of vy at t = 0"},
      {"sd_x", &Parameters::sd_x, Range::kNotNegative, "m", "standard deviation of x at t = 0"},
      {"sd_vx", &Parameters::sd_vx, Range::kNotNegative, "m/s", "standard deviation of vx at t = 0"},
      {"sd_y", &Parameters::sd_y, Range::kNotNegative, "m", "standard deviation of y at t = 0"},
      {"sd_vy", &Parameters::sd_vy, Range::kNotNegative, "m/s", "standard deviation of vy at t = 0"},
      {"dof", &Parameters::dof, Range::kNotNegative, "", "degrees of freedom of Student's t error; 0 = Gaussian"},
      {"correlation", &Parameters::correlation, Range::kFraction, "",
       "correlation of a sensor's successive errors: each weighs as if its scale were sqrt((1+c)/(1-c)) larger"},
      {"distortion", &Parameters::distortion, Range::kAny, "rad",
       "by how much a target across the sensor's axis is seen too near to the axis"},
      {"sigma_across", &Parameters::sigma_across, Range::kNotNegative, "m/s^2",
       "standard deviation of the acceleration across the course, sigma_u being that along it; 0 = sigma_u"},
      {"cruise", &Parameters::cruise, Range::kNotNegative, "m/s",
       "speed that damping below 1 draws the target to, along its course"},
  }};

  Parameters p{};

  std::vector<Quantity> states() const { return {{"x", "m"}, {"vx", "m/s"}, {"y", "m"}, {"vy", "m/s"}}; }
  std::vector<Column> columns() const {
    return {{.name = "bearing", .unit = "rad", .angle = true},
            {"sensor_x", "m", true},
            {"sensor_y", "m", true},
            {"sensor_heading", "rad", true}};
  }
  std::vector<Function<Bearings>> functions() const {
    return {{{"speed", "m/s"}, [](const auto& x) { return std::hypot(x[1], x[3]); }},
            {{"course", "rad", true}, [](const auto& x) { return std::atan2(x[3], x[1]); }},
            {{"range", "m"}, [](const auto& x) { return std::hypot(x[0], x[2]); }},
            {{"azimuth", "rad", true}, [](const auto& x) { return std::atan2(x[2], x[0]); }}};
  }
  Density density() const { return p.sigma_u > 0 ? Density::kNoise : Density::kNone; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    const S x = S(p.x0) + S(p.sd_x) * draw.normal();
    const S vx = S(p.vx0) + S(p.sd_vx) * draw.normal();
    const S y = S(p.y0) + S(p.sd_y) * draw.normal();
    const S vy = S(p.vy0) + S(p.sd_vy) * draw.normal();
    return {x, vx, y, vy};
  }

  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    const S first = S(p.sigma_u) * draw.normal();
    const S second = S(across()) * draw.normal();
    return moved(before, first, second);
  }

  /// The state after one step under two accelerations: along x and y, or, of a vehicle, along and across its course.
  template <class S>
  State<S> moved(const State<S>& before, const S& first, const S& second) const {
    if (!vehicle()) return pushed(before, first, second, S(p.damping) * before[1], S(p.damping) * before[3]);
    const std::array<S, 2> e = course(before);
    const std::array<S, 2> v = undisturbed(before, e);
    return pushed(before, first * e[0] - second * e[1], first * e[1] + second * e[0], v[0], v[1]);
  }

  /// Standard deviation of the second acceleration, in m/s^2.
  double across() const { return p.sigma_across > 0 ? p.sigma_across : p.sigma_u; }

  // Inlined with what it calls: or the SIMD engine's loop over particles would hand states over through memory, and
  // take a logarithm of the parameters for each.
  template <class S>
  [[gnu::always_inline]] S log_likelihood(Step, const State<S>& x, const Row<S>& y) const {
    const NormalDensity normal(scale() * scale());
    if (!y.seen(0)) return S(0);
    const S residual = error(x, y);
    return p.dof > 0 ? student_log_density(residual, scale(), p.dof) : normal.log(residual);
  }

  /// Scale of one bearing error, in rad, widened for errors that repeat: sigma_r sqrt((1 + c) / (1 - c)).
  double scale() const { return p.sigma_r * std::sqrt((1 + p.correlation) / (1 - p.correlation)); }

  /// The bearing error of a row that sees the state x, in rad.
  template <class S>
  [[gnu::always_inline]] S error(const State<S>& x, const Row<S>& y) const {
    using namespace numbers;
    const S azimuth = atan2(x[2] - y[2], x[0] - y[1]);
    return wrap(y[0] + y[3] - azimuth + bend(azimuth - y[3]));
  }

  /// The accelerations that lead from `before` to `x`, in standard deviations, read off the velocities.
  template <class S>
  std::array<S, kNoise> noise(Step, const State<S>& x, const State<S>& before) const {
    const auto change = velocity_change(x, before);
    return {change[0] * S(1 / (p.period * p.sigma_u)), change[1] * S(1 / (p.period * across()))};
  }

  template <class S, class Add>
  void innovations(Step, const State<S>& x, const Row<S>& y, Add add) const {
    if (!y.seen(0)) return;
    const S residual = error(x, y) * S(1 / scale());
    add(residual, student_weight(residual, p.dof));
  }

  /// The density of the accelerations that lead from `before` to `x`, read off the velocities.
  template <class S>
  S log_transition(Step, const State<S>& x, const State<S>& before) const {
    return log_noise(x, before, 1);
  }

  /// The same density with standard deviations `wider` times the model's.
  template <class S>
  S log_noise(const State<S>& x, const State<S>& before, double wider) const {
    const S per_period = S(1 / p.period);
    const auto change = velocity_change(x, before);
    const double along = wider * p.sigma_u;
    const double over = wider * across();
    return normal_log_density(change[0] * per_period, along * along) +
           normal_log_density(change[1] * per_period, over * over);
  }

  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>& inputs, D& draw) const {
    using namespace numbers;
    const S error = S(scale()) * (p.dof > 0 ? student<S>(p.dof, draw) : S(draw.normal()));
    const S relative = atan2(x[2] - inputs[2], x[0] - inputs[1]) - inputs[3];
    return Row<S>::of({wrap(relative - bend(relative) + error), inputs[1], inputs[2], inputs[3]});
  }

 private:
  /// Whether the accelerations are along and across the course.
  bool vehicle() const { return p.sigma_across > 0 || p.cruise > 0; }

  /// The unit vector along the velocity; along x for a target at rest.
  template <class S>
  static std::array<S, 2> course(const State<S>& x) {
    using namespace numbers;
    constexpr double kRest = 1e-30;  // m^2/s^2, a normal number in float, too
    const S square = x[1] * x[1] + x[3] * x[3];
    const auto rests = less(square, S(kRest));
    const S per_speed = S(1) / sqrt(select(rests, S(1), square));
    return {select(rests, S(1), x[1] * per_speed), select(rests, S(0), x[3] * per_speed)};
  }

  /// A vehicle's velocity after one step without acceleration.
  template <class S>
  std::array<S, 2> undisturbed(const State<S>& before, const std::array<S, 2>& e) const {
    const S d = S(p.damping);
    const S gain = S((1 - p.damping) * p.cruise);
    return {d * before[1] + gain * e[0], d * before[3] + gain * e[1]};
  }

  /// The state after one step that turns the velocity into (vx, vy) but for the accelerations (ux, uy).
  template <class S>
  State<S> pushed(const State<S>& before, const S& ux, const S& uy, const S& vx, const S& vy) const {
    const S T = S(p.period);
    const S half = S(0.5 * p.period * p.period);
    return {before[0] + T * before[1] + half * ux, vx + T * ux, before[2] + T * before[3] + half * uy, vy + T * uy};
  }

  /// T times the accelerations that lead from `before` to `x`.
  template <class S>
  std::array<S, kNoise> velocity_change(const State<S>& x, const State<S>& before) const {
    const S d = S(p.damping);
    if (!vehicle()) return {x[1] - d * before[1], x[3] - d * before[3]};
    const std::array<S, 2> e = course(before);
    const std::array<S, 2> v = undisturbed(before, e);
    const S dx = x[1] - v[0];
    const S dy = x[3] - v[1];
    return {dx * e[0] + dy * e[1], dy * e[0] - dx * e[1]};
  }

  /// distortion sin^3 relative: how much too near to its axis the sensor sees a target.
  template <class S>
  S bend(const S& relative) const {
    using namespace numbers;
    if (p.distortion == 0) return S(0);
    const S sine = sin(relative);
    return S(p.distortion) * sine * sine * sine;
  }
};

/// A proposal in noise space: accelerations three times wider than the model's, for targets that manoeuvre more than it
/// says.
///
///   u ~ g = N(0, 9 V), V the model's,   weight p(z | x) p(u) / g(u)
struct BearingsWide {
  static constexpr std::string_view kName = "wide";
  static constexpr std::string_view kMeaning =
      "accelerations drawn three times wider than the model's, weighted in noise space";
  static constexpr double kWider = 3;

  template <class S, class D>
  std::array<S, 4> propose(const Bearings& model, Step, const std::array<S, 4>& before, Rows<S>, D& draw) const {
    const S first = S(kWider * model.p.sigma_u) * draw.normal();
    const S second = S(kWider * model.across()) * draw.normal();
    return model.moved(before, first, second);
  }
  template <class S>
  S log_density(const Bearings& model, Step, const std::array<S, 4>& x, const std::array<S, 4>& before, Rows<S>) const {
    return model.log_noise(x, before, kWider);
  }
};

}  // namespace mote
