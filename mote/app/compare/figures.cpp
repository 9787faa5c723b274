#include "mote/app/compare/figures.hpp"

#include <algorithm>
#include <cmath>

namespace mote::compare {
namespace {

using Runs = std::vector<Measured>;

template <class Value>
std::vector<double> values_of(const Runs& runs, Value&& value) {
  std::vector<double> all;
  for (const Measured& run : runs) all.push_back(value(run));
  return all;
}

std::vector<double> squares_of(const Design& design, const Runs& runs) {
  return values_of(
      runs, [&](const Measured& run) { return design.reference.name.empty() ? run.mse_truth : run.mse_reference; });
}

std::vector<double> at(std::span<const std::size_t> places, const std::vector<double>& values) {
  std::vector<double> drawn;
  for (const std::size_t i : places) drawn.push_back(values[i]);
  return drawn;
}

Estimate estimated(const Sampling& sampling, const std::vector<double>& values, double (*middle)(std::vector<double>)) {
  return {middle(values),
          bootstrap(sampling, [&](std::span<const std::size_t> places) { return middle(at(places, values)); })};
}

Estimate ratio_of(const Sampling& sampling, const std::vector<double>& values, const std::vector<double>& first) {
  const auto ratio = [&](const std::vector<double>& a, const std::vector<double>& b) { return median(a) / median(b); };
  return {ratio(values, first), bootstrap(sampling, [&](std::span<const std::size_t> places) {
            return ratio(at(places, values), at(places, first));
          })};
}

double median_of_finished(const Runs& runs, double Measured::*value) {
  std::vector<double> all;
  for (const Measured& run : runs)
    if (!std::isnan(run.*value)) all.push_back(run.*value);
  return all.empty() ? kNaN : median(all);
}

Figures summed(const Design& design, const Runs& runs, const Runs& first, std::optional<double> lost_beyond) {
  const Sampling sampling{design.scenes.size(), design.repeats};
  const std::vector<double> squares = squares_of(design, runs);
  const auto of = [&](double Measured::*value) {
    return values_of(runs, [&](const Measured& run) { return run.*value; });
  };
  Figures f{};
  f.rmse_truth = std::sqrt(mean(of(&Measured::mse_truth)));
  f.median_mse = estimated(sampling, squares, median);
  f.mean_mse = estimated(sampling, squares, [](std::vector<double> values) { return mean(values); });
  if (&runs != &first) f.ratio = ratio_of(sampling, squares, squares_of(design, first));
  const double dof = mean(of(&Measured::nees_dof)) * static_cast<double>(runs.size());
  f.nees = mean(of(&Measured::nees)) * static_cast<double>(runs.size()) / dof;
  f.nees_band = chi_square_band(dof / static_cast<double>(design.repeats));  // repeats share a recording's errors
  f.coverage = mean(of(&Measured::covered_steps)) / mean(of(&Measured::judged_steps));
  f.collapsed = static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](auto& r) { return r.collapsed; }));
  if (lost_beyond)
    f.lost = static_cast<std::size_t>(std::count_if(
        runs.begin(), runs.end(), [&](const Measured& r) { return r.collapsed || r.final_error > *lost_beyond; }));
  const std::vector<double> evidence = of(&Measured::log_evidence);
  f.log_evidence = mean(evidence);
  f.log_evidence_sd = pooled_deviation(evidence, design.repeats);
  f.seconds = median_of_finished(runs, &Measured::seconds);
  f.ns_per_particle_step = median_of_finished(runs, &Measured::ns_per_particle_step);
  f.messages_per_step = median_of_finished(runs, &Measured::messages_per_step);
  f.bytes_per_step = median_of_finished(runs, &Measured::bytes_per_step);
  return f;
}

}  // namespace

std::vector<std::vector<Figures>> figures_of(const Design& design,
                                             const std::vector<std::vector<std::vector<Measured>>>& runs,
                                             std::optional<double> lost_beyond) {
  std::vector<std::vector<Figures>> all(runs.size());
  for (std::size_t c = 0; c < runs.size(); ++c)
    for (std::size_t size = 0; size < design.particles.size(); ++size)
      all[c].push_back(summed(design, runs[c][size], runs.front()[size], lost_beyond));
  return all;
}

}  // namespace mote::compare
