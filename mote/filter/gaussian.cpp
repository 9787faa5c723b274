#include "mote/filter/gaussian.hpp"

#include "mote/filter/sobol.hpp"

namespace mote {

Eigen::MatrixXd triangular(const Eigen::MatrixXd& root) {
  const Eigen::Index rows = root.rows();
  const Eigen::Index full = std::min(rows, root.cols());
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(rows, rows);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(root.transpose());
  const Eigen::MatrixXd upper = qr.matrixQR().topRows(full).triangularView<Eigen::Upper>();
  lower.leftCols(full) = upper.transpose();
  return lower;
}

Eigen::MatrixXd standard_normal_points(std::size_t dimensions, std::size_t count) {
  const std::size_t half = std::max(dimensions, (count + 1) / 2);
  const Sobol sobol(dimensions);
  const ScrambledPoints points(sobol, half, Draws{0, 0});
  const auto n = static_cast<Eigen::Index>(half);
  Eigen::MatrixXd z(static_cast<Eigen::Index>(dimensions), 2 * n);
  for (std::size_t i = 0; i < half; ++i) {
    PointDraw<double> draw(points, i);
    for (Eigen::Index d = 0; d < z.rows(); ++d) z(d, static_cast<Eigen::Index>(i)) = draw.normal();
  }
  const Eigen::MatrixXd root = triangular(z.leftCols(n) / std::sqrt(static_cast<double>(half)));
  root.triangularView<Eigen::Lower>().solveInPlace(z.leftCols(n));
  z.rightCols(n) = -z.leftCols(n);
  return z;
}

}  // namespace mote
