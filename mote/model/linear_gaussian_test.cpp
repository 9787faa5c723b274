#include "mote/model/linear_gaussian.hpp"

#include <stdexcept>

#include "mote/model/laws.hpp"

namespace mote {
namespace {

LinearGaussianParameters plane(Eigen::Index n, Eigen::Index m) {
  LinearGaussianParameters p;
  p.F = 0.9 * Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) p.F(i, i + 1) = 0.2;
  p.Q = Eigen::MatrixXd::Constant(n, n, 0.1) + 0.5 * Eigen::MatrixXd::Identity(n, n);
  p.H = Eigen::MatrixXd::Zero(m, n);
  for (Eigen::Index j = 0; j < m; ++j) p.H(j, j % n) = 1 + 0.1 * static_cast<double>(j);
  p.R = Eigen::MatrixXd::Constant(m, m, 0.3) + Eigen::MatrixXd::Identity(m, m);
  p.mean = Eigen::VectorXd::Constant(n, 0.5);
  p.covariance = 2 * Eigen::MatrixXd::Identity(n, n);
  return p;
}

LinearGaussian made(Eigen::Index n, Eigen::Index m) { return LinearGaussian(plane(n, m)); }

MOTE_MODEL_LAWS(LinearGaussianScalar, made(1, 1))
MOTE_MODEL_LAWS(LinearGaussianThree, made(3, 2))
MOTE_MODEL_LAWS(LinearGaussianTen, made(10, 4))

TEST(LinearGaussian, PartialRowUsesTheBlockOfItsNoise) {
  const auto model = made(3, 2);
  const SmallVector<double> x{1, 2, 3};
  const Row<double> partial{{kNaN, 2.5}, {false, true}};
  const double residual = 2.5 - 1.1 * 2;
  EXPECT_NEAR(model.log_likelihood<double>(1, x, partial), normal_log_density(residual, 1.3), 1e-12);
}

TEST(LinearGaussian, OptimalProposalIsBayesRule) {
  const auto model = made(3, 2);
  const LinearGaussianOptimal optimal(model);
  const std::vector<Row<double>> y{Row<double>::of({0.4, 1.5}), Row<double>::of({0.9, 1.1})};
  const SmallVector<double> before{1, -1, 0.5};
  const auto log_weight = [&](const SmallVector<double>& x) {
    double sum = model.log_transition<double>(1, x, before) - optimal.log_density<double>(model, 1, x, before, y);
    for (const auto& row : y) sum += model.log_likelihood<double>(1, x, row);
    return sum;
  };
  EXPECT_NEAR(log_weight({0, 0, 0}), log_weight({1, 2, -3}), 1e-9);
}

TEST(LinearGaussian, AllowsDegenerateNoiseAndSaysSo) {
  auto p = plane(2, 1);
  p.Q << 0.25, 0.5, 0.5, 1;  // rank one
  const LinearGaussian model(p);
  EXPECT_EQ(model.density(), Density::kNone);
  EXPECT_EQ(made(2, 1).density(), Density::kState);
}

TEST(LinearGaussian, RefusesWrongMatrices) {
  auto wrong_shape = plane(2, 1);
  wrong_shape.H = Eigen::MatrixXd::Ones(1, 3);
  EXPECT_THROW(LinearGaussian{wrong_shape}, std::invalid_argument);
  auto asymmetric = plane(2, 1);
  asymmetric.Q(0, 1) += 0.1;
  EXPECT_THROW(LinearGaussian{asymmetric}, std::invalid_argument);
  auto indefinite = plane(2, 1);
  indefinite.Q(0, 0) = -1;
  EXPECT_THROW(LinearGaussian{indefinite}, std::invalid_argument);
  auto exact = plane(2, 1);
  exact.R(0, 0) = 0;
  EXPECT_THROW(LinearGaussian{exact}, std::invalid_argument);
}

}  // namespace
}  // namespace mote
