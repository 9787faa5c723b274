#pragma once
/// What the tests of the SIMD engine's filters have in common: models, recordings, both engines along one, their
/// distance. For tests; included by files that are compiled for one instruction set each.

#include "mote/engine/checkpoint_laws.hpp"
#include "mote/model/linear_gaussian.hpp"
#include "mote/software/engines.hpp"
#include "mote/software/reference.hpp"
#include "mote/software/simd/here.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// Twelve steps of a recording of the model, with a gap before the fifth and two rows in the eighth.
template <class M>
Recording recording_of(const M& model) {
  Recording recording;
  auto truth = Draws{3, 0}.block(Purpose::kTruth);
  auto draw = truth.particle(0);
  auto x = model.template initial<double>(draw);
  for (Step t = 1; t <= 12; ++t) {
    x = model.template next<double>(t, x, draw);
    if (t == 4) continue;
    ObservedStep step{t, {model.template observe<double>(t, x, blank_row(model), draw)}};
    if (t == 8) step.rows.push_back(model.template observe<double>(t, x, blank_row(model), draw));
    recording.steps.push_back(std::move(step));
  }
  return recording;
}

template <class M>
std::vector<EstimateRow> rows_of(const M& model, Filter& filter, const Plan& plan, const Recording& recording) {
  RunRequest request;
  request.states = model.states();
  return run(filter, plan, recording, request).rows;
}

/// The worst difference between two runs: of means in standard deviations, of these, of evidence in nat, of the ESS.
inline double distance(const std::vector<EstimateRow>& a, const std::vector<EstimateRow>& b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t d = 0; d < a[k].states.size(); ++d) {
      const double scale = a[k].states[d].sd + 1e-9;
      worst = std::max({worst, std::abs(a[k].states[d].mean - b[k].states[d].mean) / scale,
                        std::abs(a[k].states[d].sd - b[k].states[d].sd) / scale});
    }
    worst = std::max(worst, std::abs(a[k].report.log_evidence - b[k].report.log_evidence));
    worst = std::max(worst, std::abs(a[k].report.ess / b[k].report.ess - 1));
  }
  return worst;
}

inline Plan plan_of(std::size_t particles = 1501, std::uint64_t seed = 5, Precision precision = Precision::kDouble) {
  Plan plan;
  plan.particles = particles;
  plan.seed = seed;
  plan.precision = precision;
  return plan;
}
inline Plan float_plan(std::size_t particles) { return plan_of(particles, 5, Precision::kFloat); }

/// A random walk whose likelihood is zero at the third step, and no number where the state is negative.
struct Doomed {
  template <class S>
  using State = std::array<S, 1>;
  bool zero_at_three = true;

  std::vector<Quantity> states() const { return {{"x", ""}}; }
  std::vector<Column> columns() const { return {{"y", ""}}; }
  template <class S, class D>
  State<S> initial(D& draw) const {
    return {draw.normal()};
  }
  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    return {before[0] + draw.normal()};
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    using namespace numbers;
    if (zero_at_three && t == 3) return S(-kInfinity);
    return normal_log_density(y[0] - x[0], 1.0) + select(less(x[0], S(-1)), S(kNaN), S(0));
  }
  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>&, D& draw) const {
    return Row<S>::of({x[0] + draw.normal()});
  }
};

/// A filter on the vectors that this file is compiled for.
template <class M>
std::unique_ptr<Filter> vectors(const M& model, const Plan& plan) {
  return simd_filter<M, kIsaHere>(model, plan, "test");
}
inline std::unique_ptr<Filter> vectors(const Doomed& model, const Plan& plan) {
  return make_vector_filter(model, plan, "test");
}

template <class M>
std::unique_ptr<Filter> by_reference(const M& model, const Plan& plan) {
  return reference_filter(model, plan, "test");
}
inline std::unique_ptr<Filter> by_reference(const Doomed& model, const Plan& plan) {
  return make_reference_filter(model, plan, "test");
}

/// Both engines along one recording, from the same seed.
template <class M>
double distance_of_engines(const M& model, const Plan& plan) {
  const Recording recording = recording_of(model);
  return distance(rows_of(model, *by_reference(model, plan), plan, recording),
                  rows_of(model, *vectors(model, plan), plan, recording));
}

inline LinearGaussian sixteen_states() {
  LinearGaussianParameters p;
  p.F = 0.9 * Eigen::MatrixXd::Identity(16, 16);
  p.F(0, 15) = 0.3;
  p.Q = 0.5 * Eigen::MatrixXd::Identity(16, 16);
  p.H = Eigen::MatrixXd::Identity(2, 16);
  p.R = Eigen::MatrixXd::Identity(2, 2);
  p.mean = Eigen::VectorXd::Zero(16);
  p.covariance = Eigen::MatrixXd::Identity(16, 16);
  for (int i = 0; i < 16; ++i) p.state_names.push_back("x" + std::to_string(i));
  p.observation_names = {"y1", "y2"};
  return LinearGaussian(p);
}

/// What differs when a run is broken off and resumed; its filters alternate between one thread and two.
template <class M>
std::string broken_promise(const M& model, Plan plan) {
  Recording recording = recording_of(model);
  recording.steps[5].rows.clear();
  RunRequest request;
  request.states = model.states();
  std::size_t made = 0;
  return laws::broken_promise(
      [&] {
        plan.threads = 1 + made++ % 2;
        return vectors(model, plan);
      },
      plan, recording, request);
}

}  // namespace HWY_NAMESPACE
}  // namespace mote
