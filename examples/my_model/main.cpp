// Simulates the pendulum, then follows it by SISR and by the independent Metropolis-Hastings filter.

#include <cmath>
#include <cstdio>
#include <vector>

#include "pendulum.hpp"
#include <mote/filter/estimate.hpp>
#include <mote/filter/imh.hpp>
#include <mote/filter/sisr.hpp>

int main() {
  const Pendulum pendulum;
  static_assert(mote::Model<Pendulum>);
  const auto sisr = mote::make_sisr(pendulum, 2000, 1);
  const auto imh = mote::make_imh(pendulum, 2000, 1);
  auto block = mote::Draws{7, 0}.block(mote::Purpose::kTruth);
  auto draw = block.particle(0);
  auto x = pendulum.initial<double>(draw);
  double squares_sisr = 0;
  double squares_imh = 0;
  constexpr int kSteps = 200;
  for (mote::Step t = 1; t <= kSteps; ++t) {
    x = pendulum.next<double>(t, x, draw);
    const std::vector<mote::Row<double>> y{mote::Row<double>::of({std::sin(x[0]) + pendulum.blur * draw.normal()})};
    const auto error = [&](mote::Filter& filter) {
      mote::StepReport report = filter.update(t, y);
      const double e = mote::numbers::wrap(mote::component_moments(filter.weighted(), 0, true).mean - x[0]);
      filter.select(t, report);
      return e * e;
    };
    squares_sisr += error(*sisr);
    squares_imh += error(*imh);
  }
  std::printf("angle RMSE: SISR %.3f rad, IMH %.3f rad\n", std::sqrt(squares_sisr / kSteps),
              std::sqrt(squares_imh / kSteps));
  return squares_sisr / kSteps < 0.01 && squares_imh / kSteps < 0.01 ? 0 : 1;
}
