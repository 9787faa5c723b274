#pragma once
/// Golden filters on a model's datapath against the double filters, at equal numbers of particles.

#include <algorithm>
#include <cmath>

#include "mote/filter/imh.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/hardware/filters/imh.hpp"
#include "mote/hardware/filters/sisr.hpp"
#include "mote/referee/solver.hpp"
#include "tests/hardware/models.hpp"
#include "tests/statistics/support.hpp"

namespace mote::hardware {

/// Errors of a circuit's filter over those of a double filter, one a recording.
struct Paired {
  std::vector<double> circuit, software;  ///< root mean square errors to the exact means

  /// exp(mean log ratio), and its standard error.
  std::pair<double, double> ratio() const {
    statistics::Sample logs;
    for (std::size_t k = 0; k < circuit.size(); ++k) logs.values.push_back(std::log(circuit[k] / software[k]));
    return {std::exp(logs.mean()), logs.error()};
  }
  double ratio_of_means() const {
    double above = 0;
    double below = 0;
    for (std::size_t k = 0; k < circuit.size(); ++k) {
      above += circuit[k];
      below += software[k];
    }
    return above / below;
  }
};

/// What a run of filters is.
struct AccuracyDesign {
  std::size_t recordings = 1;
  std::uint32_t particles = 1000;
  Step steps = 50;
  bool sharpened = false;  ///< the twin that must fail: log weights are four times what they should be
};

/// The distance of means, by step and state, from the exact ones.
inline double distance(const std::vector<std::vector<double>>& means, const std::vector<std::vector<double>>& exact) {
  double squares = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
    for (std::size_t d = 0; d < exact[k].size(); ++d) squares += std::pow(means[k][d] - exact[k][d], 2);
  return std::sqrt(squares / static_cast<double>(exact.size() * exact[0].size()));
}

/// The means that a golden filter, started, gives along a recording.
template <class Golden>
std::vector<std::vector<double>> golden_means(Golden& filter, const Subject& subject, const Recording& recording) {
  std::vector<std::vector<double>> means;
  for (const ObservedStep& step : recording.steps) {
    const auto observed = subject.datapath.observe(step.rows[0], subject.recorded.schedule(step.t));
    const Estimate estimate = filter.step(observed);
    means.push_back(subject.datapath.means(estimate.mean));
  }
  return means;
}

inline std::vector<std::vector<double>> double_means(Filter& filter, std::size_t dims, const Recording& recording) {
  std::vector<std::vector<double>> means;
  for (const ObservedStep& step : recording.steps) {
    StepReport report = filter.update(step.t, step.rows);
    std::vector<double>& mean = means.emplace_back();
    for (std::size_t d = 0; d < dims; ++d) mean.push_back(filter.moments(d, false).mean);
    filter.select(step.t, report);
  }
  return means;
}

/// SISR and IMH of the growth model, each against its double filter.
template <std::size_t Copies>
std::pair<Paired, Paired> growth_accuracy(const AccuracyDesign& design) {
  const Ungm<Copies> model;
  Subject growth = subject("growth", *catalogue_model("ungm", {"copies=" + std::to_string(Copies)}));
  if (design.sharpened) {
    auto& weigh = growth.datapath.arithmetic.weigh;
    weigh = [full = weigh](unsigned t, Observed y, const Particles& x, std::span<std::int64_t> log_weights) {
      full(t, y, x, log_weights);
      for (std::int64_t& log_weight : log_weights) log_weight = std::max<std::int64_t>(4 * log_weight, -(1 << 23));
    };
  }
  const auto solver = referee::solver_of(model);
  std::pair<Paired, Paired> all;
  for (std::uint64_t seed = 1; seed <= design.recordings; ++seed) {
    Recording recording = statistics::simulate(model, design.steps, seed).recording;
    recording.observations = model.columns();
    const auto exact = solver->solve(recording).value().means;
    Sisr sisr(growth.datapath.arithmetic, seed);
    sisr.start(design.particles);
    Imh imh(growth.datapath.arithmetic, seed);
    imh.start({design.particles, design.particles, 0, false});
    all.first.circuit.push_back(distance(golden_means(sisr, growth, recording), exact));
    all.second.circuit.push_back(distance(golden_means(imh, growth, recording), exact));
    const auto double_sisr = make_sisr(model, design.particles, seed);
    const auto double_imh = make_imh(model, design.particles, seed);
    all.first.software.push_back(distance(double_means(*double_sisr, Copies, recording), exact));
    all.second.software.push_back(distance(double_means(*double_imh, Copies, recording), exact));
  }
  return all;
}

inline void print(const char* what, const Paired& paired) {
  const auto [ratio, error] = paired.ratio();
  std::printf("%s: error of the circuit over the double filter's: %.4f +- %.4f (geometric mean of %zu), %.4f (means)\n",
              what, ratio, error, paired.circuit.size(), paired.ratio_of_means());
}

}  // namespace mote::hardware
