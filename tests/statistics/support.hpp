#pragma once
/// What the statistical tests share: recordings that models simulate, runs of filters, and figures of merit.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mote/engine/run.hpp"
#include "mote/filter/imh.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/filter/sqmc.hpp"

namespace mote::statistics {

/// Two-sided 1e-6 of the standard normal law.
inline constexpr double kOneInAMillion = 4.89;

/// A recording of `steps` steps drawn from the model, and the states behind it.
template <Observable M>
struct Simulated {
  Recording recording;
  std::vector<StateOf<M, double>> truth;  // x_1 .. x_T
};

/// Simulates under an address of its own: filters of the same seed share no draw with it.
///
///   edit(t, rows) may drop, blank or add rows
template <Observable M, class Edit>
Simulated<M> simulate(const M& model, Step steps, std::uint64_t seed, Edit&& edit) {
  Simulated<M> all;
  auto block = Draws{seed, 0}.block(Purpose::kObserve);
  auto draw = block.particle(0);
  auto x = model.template initial<double>(draw);
  for (Step t = 1; t <= steps; ++t) {
    x = model.template next<double>(t, x, draw);
    std::vector<Row<double>> rows{model.template observe<double>(t, x, blank_row(model), draw)};
    edit(t, rows);
    all.truth.push_back(x);
    all.recording.steps.push_back({t, std::move(rows)});
  }
  return all;
}
template <Observable M>
Simulated<M> simulate(const M& model, Step steps, std::uint64_t seed) {
  return simulate(model, steps, seed, [](Step, std::vector<Row<double>>&) {});
}

/// A filter by name, ready to be made for any size and seed.
struct Maker {
  std::string name;
  std::function<std::unique_ptr<Filter>(std::size_t particles, std::uint64_t seed)> make;
  double bias = 0;  ///< of a posterior mean at N = 1000, in posterior standard deviations, that a test allows it
};

/// What a filter says of a recording.
struct Trace {
  std::vector<std::vector<double>> means;  // (T, D)
  double log_evidence = 0;
};

inline Trace trace(Filter& filter, const std::vector<Quantity>& states, const Recording& recording) {
  RunRequest request;
  request.states = states;
  const RunRecord record = run(filter, Plan{}, recording, request);
  Trace all;
  for (const EstimateRow& row : record.rows) {
    std::vector<double> means;
    for (const Moments& m : row.states) means.push_back(m.mean);
    all.means.push_back(std::move(means));
    all.log_evidence += row.report.log_evidence;
  }
  return all;
}

/// Mean, its standard error and z scores of a sample.
struct Sample {
  std::vector<double> values;

  double mean() const {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
  }
  double variance() const {
    const double m = mean();
    double squares = 0;
    for (const double v : values) squares += (v - m) * (v - m);
    return squares / static_cast<double>(values.size() - 1);
  }
  double error() const { return std::sqrt(variance() / static_cast<double>(values.size())); }
  double z(double expected) const { return (mean() - expected) / error(); }
  double median() const {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    return n % 2 == 1 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
  }
};

/// exp(log_evidence - exact) over `runs` seeds: its mean is 1 for a filter whose evidence is unbiased.
inline Sample evidence_ratios(const Maker& maker, const std::vector<Quantity>& states, const Recording& recording,
                              std::size_t particles, std::size_t runs, double exact) {
  Sample ratios;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const auto filter = maker.make(particles, seed);
    ratios.values.push_back(std::exp(trace(*filter, states, recording).log_evidence - exact));
  }
  return ratios;
}

/// Prints a measured figure: what the README and the issues quote comes from these lines.
inline void measured(const std::string& what, double value, double error) {
  std::printf("[measured] %-64s %9.4f +- %.4f\n", what.c_str(), value, error);
}

/// Mean square over the steps of a difference to exact means of component d.
inline double mean_square_error(const Trace& got, const std::vector<double>& exact, std::size_t d = 0) {
  double sum = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) sum += std::pow(got.means[k][d] - exact[k], 2);
  return sum / static_cast<double>(exact.size());
}

}  // namespace mote::statistics
