#include "mote/filter/gaussian.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

Eigen::MatrixXd some_root(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd root(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) root(i, j) = std::sin(1.0 + 3.0 * static_cast<double>(i * columns + j));
  return root;
}

TEST(Triangular, IsALowerRootOfTheSameProduct) {
  for (const auto& [rows, columns] : {std::pair{1, 1}, {3, 3}, {3, 8}, {4, 2}, {2, 0}}) {
    const Eigen::MatrixXd root = some_root(rows, columns);
    const Eigen::MatrixXd lower = triangular(root);
    ASSERT_EQ(lower.rows(), rows);
    ASSERT_EQ(lower.cols(), rows);
    EXPECT_LT((lower * lower.transpose() - root * root.transpose()).norm(), 1e-13);
    EXPECT_EQ(lower.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().norm(), 0);
  }
}

TEST(StandardNormalPoints, HaveExactlyTheMoments) {
  for (const auto& [d, n, expected] :
       {std::tuple{1U, 1U, 2}, {1U, 1000U, 1000}, {2U, 7U, 8}, {4U, 2U, 8}, {6U, 1000U, 1000}}) {
    const Eigen::MatrixXd z = standard_normal_points(d, n);
    ASSERT_EQ(z.rows(), d);
    ASSERT_EQ(z.cols(), expected);
    EXPECT_LT(z.rowwise().mean().norm(), 1e-13);
    const Eigen::MatrixXd covariance = z * z.transpose() / static_cast<double>(expected);
    EXPECT_LT((covariance - Eigen::MatrixXd::Identity(d, d)).norm(), 1e-12) << d << ", " << n;
  }
}

// Quantiles of the points are those of the normal law: 1 % in 1000 points.
TEST(StandardNormalPoints, HaveTheQuantiles) {
  const Eigen::MatrixXd z = standard_normal_points(3, 1000);
  for (Eigen::Index d = 0; d < 3; ++d)
    for (const double level : {-1.2816, 0.0, 0.6745})
      EXPECT_NEAR((z.row(d).array() < level).cast<double>().mean(), 0.5 * std::erfc(-level / std::sqrt(2.0)), 0.01);
}

template <class Transform>
void expect_exact_for_linear() {
  const Eigen::MatrixXd A = some_root(3, 4);
  const auto f = [&]<class S>(const std::vector<S>& z) {
    std::vector<S> out;
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      S sum(2.0 * static_cast<double>(i));
      for (Eigen::Index j = 0; j < A.cols(); ++j) sum = sum + S(A(i, j)) * z[static_cast<std::size_t>(j)];
      out.push_back(sum);
    }
    return out;
  };
  const Gaussian law = Transform::image(f, 4, {false, false, false});
  EXPECT_LT((law.mean - Eigen::Vector3d(0, 2, 4)).norm(), 1e-13);
  EXPECT_LT((law.covariance() - A * A.transpose()).norm(), 1e-12);
}

TEST(Transforms, AreExactForLinearFunctions) {
  expect_exact_for_linear<Tangent>();
  expect_exact_for_linear<Unscented>();
}

// x = m + s z, f = x^2: the mean is m^2 + s^2, the variance 4 m^2 s^2 + 2 s^4. Three points have it exactly; the
// tangent, the twin, leaves the powers of s beyond the first out.
TEST(Transforms, SigmaPointsSeeCurvature) {
  const auto f = []<class S>(const std::vector<S>& z) {
    const S x = S(1.5) + S(2.0) * z[0];
    return std::vector<S>{x * x};
  };
  const Gaussian unscented = Unscented::image(f, 1, {false});
  EXPECT_NEAR(unscented.mean(0), 2.25 + 4, 1e-13);
  EXPECT_NEAR(unscented.covariance()(0, 0), 4 * 2.25 * 4 + 2 * 16, 1e-12);
  const Gaussian tangent = Tangent::image(f, 1, {false});
  EXPECT_NEAR(tangent.mean(0), 2.25, 1e-13);
  EXPECT_NEAR(tangent.covariance()(0, 0), 4 * 2.25 * 4, 1e-12);
}

// Points on both sides of the cut at pi: an angle is averaged across it, a plain number (the twin) is not.
TEST(Transforms, SigmaPointsWrapAngles) {
  const auto f = []<class S>(const std::vector<S>& z) { return std::vector<S>{numbers::wrap(S(3.1) + S(0.2) * z[0])}; };
  const Gaussian angle = Unscented::image(f, 1, {true});
  EXPECT_NEAR(angle.mean(0), 3.1, 1e-12);
  EXPECT_NEAR(angle.covariance()(0, 0), 0.04, 1e-12);
  EXPECT_GT(Unscented::image(f, 1, {false}).covariance()(0, 0), 1);
}

}  // namespace
}  // namespace mote
