#pragma once
// A model of your own: a damped pendulum pushed by noise, seen by the horizontal place of its bob.

#include <array>

#include <mote/model/densities.hpp>
#include <mote/model/model.hpp>

/// angle' = angle + h rate,   rate' = rate - h (g sin angle + damping rate) + sqrt(h) N(0, push^2),   y = sin angle +
/// N(0, blur^2)
struct Pendulum {
  double h = 0.05, gravity = 9.81, damping = 0.2, push = 0.5, blur = 0.1;

  template <class S>
  using State = std::array<S, 2>;

  std::vector<mote::Quantity> states() const { return {{"angle", "rad", true}, {"rate", "rad/s"}}; }
  std::vector<mote::Column> columns() const { return {{"y", "m"}}; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    return {S(0.5) * draw.normal(), S(0.5) * draw.normal()};
  }
  template <class S, class D>
  State<S> next(mote::Step, const State<S>& x, D& draw) const {
    using namespace mote::numbers;
    const S pull = S(gravity) * sin(x[0]) + S(damping) * x[1];
    const S rate = x[1] - S(h) * pull + S(push * std::sqrt(h)) * draw.normal();
    return {wrap(x[0] + S(h) * x[1]), rate};
  }
  template <class S>
  S log_likelihood(mote::Step, const State<S>& x, const mote::Row<S>& y) const {
    using namespace mote::numbers;
    return y.seen(0) ? mote::normal_log_density(y[0] - sin(x[0]), blur * blur) : S(0);
  }
};
