/// A control loop at 1 kHz that follows a target by its bearing with 10 000 particles, and says how long its steps
/// took.
///
///   control_loop [seconds]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <mote/engine/stream.hpp>
#include <mote/model/bearings.hpp>
#include <mote/software/simd/here.hpp>

int main(int argc, char** argv) {
  using namespace std::chrono;
  constexpr auto kPeriod = milliseconds(1);
  const double run_for = argc > 1 ? std::atof(argv[1]) : 1;

  const mote::Bearings model{{.period = 0.001, .sigma_u = 0.5}};
  mote::Plan plan;
  plan.particles = 10000;
  plan.precision = mote::Precision::kFloat;
  mote::Stream stream(mote::make_vector_filter(model, plan, "control_loop"), model.states(), model.columns());

  // the plant, drawn from the model itself; a real one would read its sensor here
  auto block = mote::Draws{7, 0}.block(mote::Purpose::kTruth);
  auto draw = block.particle(0);
  auto truth = model.initial<double>(draw);

  const auto steps = static_cast<int>(run_for * 1000);
  int late = 0;
  double error = 0;
  auto wake = steady_clock::now();
  for (int k = 1; k <= steps; ++k) {
    truth = model.next<double>(k, truth, draw);
    const mote::Row<double> row = model.observe<double>(k, truth, mote::blank_row(model), draw);
    const auto& now = stream.step({&row, 1});
    error += std::hypot(now.states[0].mean - truth[0], now.states[2].mean - truth[2]) / steps;
    wake += kPeriod;
    late += steady_clock::now() > wake ? 1 : 0;
    std::this_thread::sleep_until(wake);
  }
  const auto us = [](nanoseconds time) { return static_cast<double>(time.count()) / 1000; };
  const mote::Latency& latency = stream.latency();
  std::printf("%d steps of %zu particles: p50 %.0f us, p99 %.0f us, max %.0f us; %d of %d late; mean error %.3f m\n",
              steps, plan.particles, us(latency.quantile(0.5)), us(latency.quantile(0.99)), us(latency.largest()), late,
              steps, error);
}
