#include "mote/app/compare/study.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "mote/app/compare/statistics.hpp"
#include "mote/app/terminal/suggestion.hpp"
#include "mote/base/refusal.hpp"
#include "mote/filter/estimate.hpp"

namespace mote::compare {
namespace {

/// Squared distance of the target between estimated means and other values.
double squared_distance(const Design& design, const std::vector<Moments>& estimated,
                        const std::vector<double>& values) {
  const std::vector<Quantity> states = design.catalogue_model->states();
  double sum = 0;
  for (const std::size_t d : design.target.states) {
    const double e = estimated[d].mean - values[d];
    sum += std::pow(states[d].angle ? numbers::wrap(e) : e, 2);
  }
  return sum;
}

/// Mean of what is a number; NaN when nothing is.
class Average {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    sum_ += value;
    ++count_;
  }
  double value() const { return count_ == 0 ? kNaN : sum_ / count_; }

 private:
  double sum_ = 0;
  double count_ = 0;
};

RunRequest request_of(const Design& design, const std::string& where, const std::atomic<bool>& stop) {
  RunRequest request;
  request.where = where;
  request.states = design.catalogue_model->states();
  request.stop = &stop;
  return request;
}

/// What run_job() wants, on one of the design's recordings.
Job job_on(const Design& design, Recording recording) {
  Job job;
  job.model_name = design.model;
  job.model = design.catalogue_model;
  job.recording = std::move(recording);
  return job;
}

[[noreturn]] void refuse_interrupted(const Design& design, const std::string& done) {
  throw Refusal(ExitCode::kInterrupted, fmt::format("{}: interrupted {}; no file was written.", design.where, done));
}

void mark_collapsed(const Design& design, Measured& run) {
  run.collapsed = true;
  run.mse_truth = run.final_error = design.has_truth() ? kInfinity : kNaN;
  run.mse_reference = design.reference.name.empty() ? kNaN : kInfinity;
  run.log_evidence = -kInfinity;
  run.seconds = run.ns_per_particle_step = run.messages_per_step = run.bytes_per_step = kNaN;
}

std::string place_of(const Design& design, const Contender& contender) {
  return design.where + ": --filters: " + contender.name;
}

Measured measured_run(const Design& design, const Job& job, std::size_t contender, const Plan& plan,
                      std::size_t recording, const std::atomic<bool>& stop) {
  const std::string where = place_of(design, design.contenders[contender]);
  Measured run{.seed = plan.seed, .recording = recording};
  RunRequest request = request_of(design, where, stop);
  const Truth& truth = design.scenes[recording].truth;
  request.dump = [&](Step t, const WeightedSet& set) {
    const auto known = truth.states.find(t);
    if (known == truth.states.end()) return;
    const Nees nees = normalised_error(set, request.states, known->second);
    run.nees += nees.value;
    run.nees_dof += nees.degrees_of_freedom;
    run.judged_steps += 1;
    if (nees.degrees_of_freedom > 0 && nees.value <= chi_square_quantile(nees.degrees_of_freedom, kConfidence))
      run.covered_steps += 1;
  };
  try {
    const RunRecord record = run_job(job, plan, request, where);
    if (!record.interrupted) measure(design, record, run);
  } catch (const Refusal& refusal) {
    if (refusal.code() != ExitCode::kCollapsed) throw;
    mark_collapsed(design, run);
  }
  return run;
}

}  // namespace

void measure(const Design& design, const RunRecord& record, Measured& run) {
  const Scene& scene = design.scenes[run.recording];
  Average truth;
  Average reference;
  run.final_error = kNaN;
  for (std::size_t k = 0; k < record.rows.size(); ++k) {
    const EstimateRow& row = record.rows[k];
    if (!design.reference.name.empty())
      reference.add(squared_distance(design, row.states, design.reference.solutions[run.recording].means[k]));
    const auto known = scene.truth.states.find(row.t);
    if (known == scene.truth.states.end()) continue;
    const double squared = squared_distance(design, row.states, known->second);
    truth.add(squared);
    if (!std::isnan(squared)) run.final_error = std::sqrt(squared);
  }
  const Summary summary = summarise(record, nullptr);
  run.mse_truth = truth.value();
  run.mse_reference = reference.value();
  run.log_evidence = summary.log_evidence;
  run.collapsed = summary.collapses > 0;
  run.seconds = record.step_seconds;
  run.ns_per_particle_step = summary.ns_per_particle_step;
  run.messages_per_step = summary.traffic_per_step.messages;
  run.bytes_per_step = summary.traffic_per_step.bytes;
}

Target target_of(const std::string& name, const std::vector<Quantity>& states, const std::string& where) {
  std::vector<std::string> known;
  Target position{"position", "", {}};
  for (std::size_t d = 0; d < states.size(); ++d) {
    known.push_back(states[d].name);
    if (states[d].name == "x" || states[d].name == "y") {
      position.states.push_back(d);
      position.unit = states[d].unit;
    }
  }
  const bool plane = position.states.size() == 2;
  if (plane && (name.empty() || name == position.name)) return position;
  for (std::size_t d = 0; d < states.size(); ++d)
    if (name == states[d].name || name.empty()) return {states[d].name, states[d].unit, {d}};
  if (plane) known.push_back(position.name);
  throw Refusal(ExitCode::kWrongUse, {where, "--state", fmt::format("one of {}", fmt::join(known, ", ")),
                                      "\"" + name + "\"", hint(name, known, "Leave --state out for its default.")});
}

Nees normalised_error(const WeightedSet& set, const std::vector<Quantity>& states, std::span<const double> truth) {
  std::vector<std::size_t> places;
  std::vector<Moments> middles;
  for (std::size_t d = 0; d < states.size(); ++d)
    if (!std::isnan(truth[d])) {
      places.push_back(d);
      middles.push_back(component_moments(set, d, states[d].angle));
    }
  const auto n = static_cast<Eigen::Index>(places.size());
  const auto apart = [&](std::size_t a, double value) {
    const double e = value - middles[a].mean;
    return states[places[a]].angle ? numbers::wrap(e) : e;
  };
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  set.visit([&](const auto& particles) {
    Eigen::VectorXd e(n);
    for (std::size_t i = 0; i < set.size(); ++i) {
      for (Eigen::Index a = 0; a < n; ++a) {
        const auto at = static_cast<std::size_t>(a);
        e(a) = apart(at, static_cast<double>(particles.component(places[at])[i]));
      }
      covariance += set.weights[i] / set.total * e * e.transpose();
    }
  });
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);  // errors in deviations
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const double e = apart(static_cast<std::size_t>(a), truth[places[static_cast<std::size_t>(a)]]);
    if (sd(a) == 0 && e != 0) return {kInfinity, static_cast<double>(n)};
    if (sd(a) > 0) z(a) = e / sd(a);
    for (Eigen::Index b = 0; b < n; ++b)
      if (sd(a) > 0 && sd(b) > 0) correlation(a, b) = covariance(a, b) / (sd(a) * sd(b));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(correlation);
  Nees nees{0, 0};
  for (Eigen::Index a = 0; a < n; ++a)
    if (directions.eigenvalues()(a) > 1e-9) {
      nees.value += std::pow(directions.eigenvectors().col(a).dot(z), 2) / directions.eigenvalues()(a);
      nees.degrees_of_freedom += 1;
    }
  return nees;
}

Reference exact_reference(const Design& design, const ProgressOf& progress, const std::atomic<bool>& stop) {
  const auto solver = design.catalogue_model->solver();
  if (!solver) return {};
  Reference reference{fmt::format("{} (exact)", solver->name()), true, {}};
  for (const Scene& scene : design.scenes) {
    if (stop) refuse_interrupted(design, "in its reference");
    auto solution = solver->solve(scene.recording);
    if (!solution) return {};
    reference.solutions.push_back(std::move(*solution));
    progress(reference.solutions.size(), design.scenes.size());
  }
  return reference;
}

Reference run_reference(const Design& design, const Plan& plan, const std::string& name, const ProgressOf& progress,
                        const std::atomic<bool>& stop) {
  Reference reference{name, false, {}};
  const std::string where = design.where + ": --reference: " + name;
  Plan seeded = plan;
  seeded.seed = design.seed_of(design.scenes.size(), 0);
  for (const Scene& scene : design.scenes) {
    const RunRecord record = run_job(job_on(design, scene.recording), seeded, request_of(design, where, stop), where);
    if (record.interrupted) refuse_interrupted(design, "in its reference");
    referee::Solution& solution = reference.solutions.emplace_back();
    solution.log_evidence = summarise(record, nullptr).log_evidence;
    for (const EstimateRow& row : record.rows) {
      auto& means = solution.means.emplace_back();
      for (const Moments& m : row.states) means.push_back(m.mean);
    }
    progress(reference.solutions.size(), design.scenes.size());
  }
  return reference;
}

void check_contenders(const Design& design) {
  const std::atomic<bool> never{false};
  const Job nothing = job_on(design, {});
  for (const Contender& contender : design.contenders)
    for (const Plan& plan : contender.plans) {
      const std::string where = place_of(design, contender);
      run_job(nothing, plan, request_of(design, where, never), where);
    }
}

std::vector<std::vector<std::vector<Measured>>> run_study(const Design& design, const ProgressOf& progress,
                                                          const std::atomic<bool>& stop) {
  const std::size_t count = design.contenders.size();
  std::vector<std::vector<std::vector<Measured>>> all(count,
                                                      std::vector<std::vector<Measured>>(design.particles.size()));
  std::size_t work = 0;
  std::size_t done = 0;
  std::size_t runs = 0;
  for (const std::size_t n : design.particles) work += n * count * design.runs();
  for (std::size_t k = 0; k < design.scenes.size(); ++k) {
    const Job job = job_on(design, design.scenes[k].recording);
    for (std::size_t r = 0; r < design.repeats; ++r)
      for (std::size_t size = 0; size < design.particles.size(); ++size)
        for (std::size_t turn = 0; turn < count; ++turn) {
          const std::size_t c = (turn + k + r) % count;
          Plan plan = design.contenders[c].plans[size];
          plan.seed = design.seed_of(k, r);
          all[c][size].push_back(measured_run(design, job, c, plan, k, stop));
          if (stop)
            refuse_interrupted(
                design, fmt::format("after {} of {} runs", runs, count * design.particles.size() * design.runs()));
          ++runs;
          progress(done += design.particles[size], work);
        }
  }
  return all;
}

}  // namespace mote::compare
