#include <gtest/gtest.h>

#include "mote/referee/grid.hpp"
#include "mote/referee/kalman.hpp"
#include "tests/statistics/linear_models.hpp"

namespace mote::statistics {
namespace {

/// All states x_0..x_T and all seen entries of a recording as one Gaussian vector, conditioned by brute force.
struct Joint {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  double log_evidence;
};

Joint conditioned(const LinearGaussianParameters& p, const Recording& recording) {
  const Eigen::Index n = p.F.rows();
  const Eigen::Index steps = recording.steps.back().t;
  Eigen::VectorXd mean((steps + 1) * n);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero((steps + 1) * n, (steps + 1) * n);
  mean.head(n) = p.mean;
  covariance.topLeftCorner(n, n) = p.covariance;
  for (Eigen::Index t = 1; t <= steps; ++t) {
    mean.segment(t * n, n) = p.F * mean.segment((t - 1) * n, n);
    const Eigen::MatrixXd past = covariance.topLeftCorner(t * n, t * n);
    covariance.block(t * n, 0, n, t * n) = p.F * past.bottomRows(n);
    covariance.block(0, t * n, t * n, n) = covariance.block(t * n, 0, n, t * n).transpose();
    covariance.block(t * n, t * n, n, n) =
        p.F * covariance.block((t - 1) * n, (t - 1) * n, n, n) * p.F.transpose() + p.Q;
  }
  // every seen entry: a row of the big observation matrix; entries of one row share R
  std::vector<Eigen::VectorXd> observers;
  std::vector<double> values;
  std::vector<std::pair<std::size_t, Eigen::Index>> origin;
  std::size_t row_count = 0;
  for (const ObservedStep& step : recording.steps)
    for (const Row<double>& row : step.rows) {
      for (Eigen::Index j = 0; j < p.H.rows(); ++j) {
        if (!row.seen(static_cast<std::size_t>(j))) continue;
        Eigen::VectorXd h = Eigen::VectorXd::Zero(mean.size());
        h.segment(step.t * n, n) = p.H.row(j);
        observers.push_back(h);
        values.push_back(row[static_cast<std::size_t>(j)]);
        origin.emplace_back(row_count, j);
      }
      ++row_count;
    }
  const auto m = static_cast<Eigen::Index>(values.size());
  Eigen::MatrixXd H(m, mean.size());
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd y(m);
  for (Eigen::Index a = 0; a < m; ++a) {
    const auto& [row, j] = origin[static_cast<std::size_t>(a)];
    H.row(a) = observers[static_cast<std::size_t>(a)];
    y(a) = values[static_cast<std::size_t>(a)];
    for (Eigen::Index b = 0; b < m; ++b)
      if (origin[static_cast<std::size_t>(b)].first == row)
        R(a, b) = p.R(j, origin[static_cast<std::size_t>(b)].second);
  }
  const Eigen::MatrixXd S = H * covariance * H.transpose() + R;
  const Eigen::LLT<Eigen::MatrixXd> factor(S);
  const Eigen::VectorXd residual = y - H * mean;
  const Eigen::MatrixXd K = covariance * H.transpose() * S.inverse();
  const double log_determinant = 2 * Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
  return {mean + K * residual, covariance - K * H * covariance,
          -0.5 * (residual.dot(factor.solve(residual)) + log_determinant + static_cast<double>(m) * std::log(2 * kPi))};
}

template <class M>
void expect_kalman_conditions(const M& model, const Recording& recording) {
  const auto laws = referee::kalman(model, recording);
  const auto p = referee::as_linear_gaussian(model);
  const Joint joint = conditioned(p, recording);
  const Eigen::Index n = p.F.rows();
  ASSERT_EQ(laws.size(), recording.steps.size());
  EXPECT_LT((joint.mean.tail(n) - laws.back().mean).norm(), 1e-10);
  EXPECT_LT((joint.covariance.bottomRightCorner(n, n) - laws.back().covariance).norm(), 1e-10);
  EXPECT_NEAR(joint.log_evidence, referee::log_evidence(laws), 1e-9);
}

TEST(Kalman, IsTheConditionalOfTheJointGaussian) {
  expect_kalman_conditions(local_level(), local_level_recording());
  expect_kalman_conditions(plane(), plane_recording());
}

// Durbin & Koopman 2012, sec. 2.2: the first steps of the local level by their scalar recursion.
TEST(Kalman, FollowsTheScalarRecursion) {
  const LocalLevel nile;
  Recording recording;
  const std::vector<double> flow{1120, 1160, 963};
  for (std::size_t k = 0; k < flow.size(); ++k)
    recording.steps.push_back({static_cast<Step>(k + 1), {Row<double>::of({flow[k]})}});
  const auto laws = referee::kalman(nile, recording);
  double a = 1120;
  double P = 1e5;
  for (std::size_t k = 0; k < flow.size(); ++k) {
    P += 1469.1;
    const double F = P + 15099;
    EXPECT_NEAR(laws[k].log_evidence, -0.5 * (std::log(2 * kPi * F) + (flow[k] - a) * (flow[k] - a) / F), 1e-10);
    a += P / F * (flow[k] - a);
    P *= 15099 / F;
    EXPECT_NEAR(laws[k].mean(0), a, 1e-9);
    EXPECT_NEAR(laws[k].covariance(0, 0), P, 1e-9);
  }
}

TEST(Grid, AgreesWithAGridOfAQuarterTheStep) {
  const Ungm<1> model;
  Recording recording = simulate(model, 12, 3).recording;
  recording.steps[4].rows.clear();
  recording.steps[8].rows.push_back(Row<double>::of({2.0}));
  recording.steps.erase(recording.steps.begin() + 6);
  const auto usual = referee::Grid(model).filter(recording);
  const auto fine = referee::Grid(model, 60, 4801).filter(recording);
  ASSERT_EQ(usual.means.size(), 11U);
  for (std::size_t k = 0; k < usual.means.size(); ++k) EXPECT_NEAR(usual.means[k], fine.means[k], 1e-6) << k;
  EXPECT_NEAR(usual.log_evidence, fine.log_evidence, 1e-6);
  const auto coarse = referee::Grid(model, 60, 241).filter(recording);
  double worst = 0;
  for (std::size_t k = 0; k < usual.means.size(); ++k)
    worst = std::max(worst, std::abs(coarse.means[k] - fine.means[k]));
  EXPECT_GT(worst, 1e-3) << "the twin: a step of 0.5 does not resolve the drift";
}

}  // namespace
}  // namespace mote::statistics
