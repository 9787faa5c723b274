#pragma once
/// A damped pendulum, seen through its noisy horizontal position. Copy this file and write your own model into it.

#include <array>

#include <mote/model/densities.hpp>
#include <mote/model/model.hpp>

/// State (angle, rate), one step of Euler's semi-implicit rule a period:
///
///   rate'  = rate + T (-(g / L) sin(angle) - damping rate) + N(0, sigma_rate^2)
///   angle' = angle + T rate'
///   y      = L sin(angle) + N(0, sigma_y^2)
///
/// Every function is generic in its number type S: engines run it with floats, doubles, vectors of them and numbers
/// that record a circuit. So never branch on an S: use select() – and draw as many numbers in every call.
struct Pendulum {
  double period_s = 0.05, length_m = 1, damping = 0.3, sigma_rate = 0.1, sigma_y = 0.1;

  template <class S>
  using State = std::array<S, 2>;

  std::vector<mote::Quantity> states() const { return {{"angle", "rad", true}, {"rate", "rad/s"}}; }
  std::vector<mote::Column> columns() const { return {{"horizontal", "m"}}; }

  /// x_0: pulled aside by about 60 degrees and let go.
  template <class S, class D>
  State<S> initial(D& draw) const {
    const S angle = S(1) + S(0.2) * draw.normal();
    const S rate = S(0.2) * draw.normal();
    return {angle, rate};
  }

  /// x_t from x_{t-1}.
  template <class S, class D>
  State<S> next(mote::Step, const State<S>& before, D& draw) const {
    using namespace mote::numbers;
    const S rate = undisturbed_rate(before) + S(sigma_rate) * draw.normal();
    return {wrap(before[0] + S(period_s) * rate), rate};
  }

  /// log p(y_t | x_t); a missing measurement says nothing.
  template <class S>
  S log_likelihood(mote::Step, const State<S>& x, const mote::Row<S>& y) const {
    using namespace mote::numbers;
    if (!y.seen(0)) return S(0);
    return mote::normal_log_density(y[0] - S(length_m) * sin(x[0]), sigma_y * sigma_y);
  }

  // What follows is optional: simulating needs observe(), proposals other than the model itself need the transition's
  // density.

  template <class S, class D>
  mote::Row<S> observe(mote::Step, const State<S>& x, const mote::Row<S>&, D& draw) const {
    using namespace mote::numbers;
    return mote::Row<S>::of({S(length_m) * sin(x[0]) + S(sigma_y) * draw.normal()});
  }

  /// One noise drives two states, so the density is that of the noise.
  mote::Density density() const { return mote::Density::kNoise; }
  template <class S>
  S log_transition(mote::Step, const State<S>& x, const State<S>& before) const {
    return mote::normal_log_density(x[1] - undisturbed_rate(before), sigma_rate * sigma_rate);
  }

 private:
  template <class S>
  S undisturbed_rate(const State<S>& before) const {
    using namespace mote::numbers;
    const S pull = S(-9.81 / length_m) * sin(before[0]) - S(damping) * before[1];
    return before[1] + S(period_s) * pull;
  }
};
