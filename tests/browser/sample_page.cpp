// sample_page OUT.html: a page with every kind of chart, what a report may hold at its worst, for the browser check.
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "mote/report/page.hpp"

using mote::report::Chart;
using mote::report::Page;
using mote::report::Series;

namespace {

using Values = std::vector<double>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Deterministic noise in [-1, 1].
double noise(int i) { return std::remainder(std::sin(12.9898 * i) * 43758.5453, 2.0); }

template <class F>
Values table(int n, F f) {
  Values values;
  for (int i = 1; i <= n; ++i) values.push_back(f(i));
  return values;
}

Values counted(int n) {
  return table(n, [](int i) { return double(i); });
}

double level(int i) { return 12 * std::sin(0.11 * i) + 3 * std::cos(0.7 * i); }

double estimate(int i) { return level(i) + 1.5 * noise(i); }

Chart state_chart() {
  const int n = 120;
  const auto gap = [](int i) { return i >= 70 && i <= 76 ? kNan : 0.0; };
  const auto sd = [](int i) { return 1.5 + std::abs(noise(3 * i)); };
  return {
      .title = "State x",
      .x_label = "t (step)",
      .y_label = "x",
      .bands = {{"estimate ± 2 sd", counted(n), table(n, [&](int i) { return estimate(i) - 2 * sd(i) + gap(i); }),
                 table(n, [&](int i) { return estimate(i) + 2 * sd(i) + gap(i); })}},
      .series = {{"estimate", Series::Mark::kLine, counted(n), table(n, [&](int i) { return estimate(i) + gap(i); })},
                 {"observation", Series::Mark::kPoints, counted(n),
                  table(n, [](int i) { return i % 9 == 0 ? kNan : level(i) + 4 * noise(7 * i); })},
                 {"truth", Series::Mark::kLine, counted(n), table(n, level)}}};
}

Chart steps_chart() {
  const int n = 120;
  return {.title = "Effective sample size",
          .x_label = "t (step)",
          .y_label = "ESS (particles)",
          .series = {{"ess", Series::Mark::kSteps, counted(n), table(n, [](int i) { return 500 + 450 * noise(i); })}}};
}

Chart track_chart() {
  const int n = 400;
  const auto angle = [](int i) { return 2 * std::numbers::pi * i / 400; };
  const auto x = [=](int i) { return 0.1 * std::cos(angle(i)) + 0.02 * std::cos(5 * angle(i)); };
  const auto y = [=](int i) { return 0.24 + 0.05 * std::sin(2 * angle(i)); };
  return {.title = "Track",
          .x_label = "x (km)",
          .y_label = "y (km)",
          .series = {{"estimate", Series::Mark::kLine, table(n, [=](int i) { return x(i) + 0.004 * noise(i); }),
                      table(n, [=](int i) { return y(i) + 0.004 * noise(5 * i); })},
                     {"truth", Series::Mark::kLine, table(n, x), table(n, y)}},
          .equal_axes = true};
}

Chart error_chart() {
  const Values particles{10, 30, 100, 300, 1000, 3000, 10000, 30000};
  const auto falling = [&](double scale) {
    Values y;
    for (const double n : particles) y.push_back(scale / std::sqrt(n));
    return y;
  };
  return {.title = "Error against work",
          .x_label = "particles",
          .y_label = "rmse",
          .series = {{"bootstrap", Series::Mark::kLine, particles, falling(9)},
                     {"auxiliary", Series::Mark::kLine, particles, falling(5)},
                     {"independent Metropolis–Hastings", Series::Mark::kMarkedLine, particles, falling(3)},
                     {"EKF", Series::Mark::kPoints, {10, 1000}, {4, 0}}},
          .log_x = true,
          .log_y = true};
}

Chart long_chart() {
  const int n = 100000;
  return {.title = "100 000 points",
          .x_label = "t (ms)",
          .y_label = "log weight (nat)",
          .bands = {{"quantiles 5–95 %", counted(n), table(n, [](int i) { return std::sin(i / 9e3) - 1; }),
                     table(n, [](int i) { return std::sin(i / 9e3) + 1; })}},
          .series = {{"sampled", Series::Mark::kPoints, counted(n),
                      table(n, [](int i) { return std::sin(i / 9e3) + noise(i); })},
                     {"mean", Series::Mark::kLine, counted(n),
                      table(n, [](int i) { return std::sin(i / 9e3) + 0.2 * noise(3 * i); })}}};
}

Chart bars_chart() {
  return {.title = "Stages at work",
          .x_label = "ms",
          .bars = {{"propose", {0, 2, 4}, {2, 4, 6}, {0, 0, 0}}, {"weigh", {2, 5, 4}, {5, 9, 7}, {1, 1, 2}}},
          .rows = {"propose 1", "weigh 1", "weigh 2"}};
}

Page sample() {
  return {
      .title = "Growth model, bootstrap filter",
      .summary = "1000 particles follow the univariate growth model for 120 steps; the estimate is the weighted mean.",
      .command =
          "mote run ungm --data obs.csv --truth truth.csv --filter sisr --particles 1000 --seed 1 "
          "--set q=10 --out estimates.csv --report report.html",
      .facts = {{"model", "ungm"},
                {"filter", "sisr"},
                {"engine", "simd"},
                {"particles", "1000"},
                {"seed", "1"},
                {"steps", "120"},
                {"log evidence (nat)", "−287.41"},
                {"mean ESS", "512.6"},
                {"time per particle step", "4.1 ns"},
                {"rmse of x", "1.52"}},
      .charts = {state_chart(),
                 steps_chart(),
                 track_chart(),
                 error_chart(),
                 long_chart(),
                 bars_chart(),
                 {.title = "Nothing </script><b>&\"' Ω",
                  .x_label = "t (step)",
                  .y_label = "<i>y</i>",
                  .series = {{"<u>all</u> gaps", Series::Mark::kLine, {1, 2}, {kNan, kNan}}}}},
      .tables = {{"Engines",
                  {"engine", "ns per particle step", "rmse", "agreement"},
                  {{"reference", "61.2", "1.52", "is the referee"},
                   {"simd", "4.1", "1.52", "bit-exact"},
                   {"pipeline", "2.6", "1.52", "bit-exact"}}}},
      .notes = {"Steps 70 to 76 have no estimate: the line and its band break there.",
                "A name may hold <markup> & \"quotes\"."}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ofstream out(argv[1], std::ios::binary);
  out << mote::report::html(sample());
  return out.flush() ? 0 : 6;
}
