#pragma once
/// Gaussian laws, and how a function maps them: by its tangent, or by sigma points.

#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "mote/base/archive.hpp"
#include "mote/base/numbers.hpp"
#include "mote/filter/dual.hpp"

namespace mote {

/// N(mean, root root'): a root of the covariance stays positive semidefinite whatever the rounding.
struct Gaussian {
  Eigen::VectorXd mean;  // (D,)
  Eigen::MatrixXd root;  // (D, K), any K

  Eigen::MatrixXd covariance() const { return root * root.transpose(); }
  /// Writes or reads a law whose root is square.
  void keep(Archive& archive) {
    archive.fill(std::span(mean.data(), static_cast<std::size_t>(mean.size())));
    archive.fill(std::span(root.data(), static_cast<std::size_t>(root.size())));
  }
};

/// The lower-triangular square root with the same product: L L' = root root'.
///
/// shape   root: (D, K); L: (D, D), its diagonal of either sign, zero where the covariance is singular
/// cost    O(D^2 K), by Householder reflections
/// source  Golub & Van Loan 2013, sec. 5.2: L' is the triangle of root' = Q L'
Eigen::MatrixXd triangular(const Eigen::MatrixXd& root);

/// `count` points or a few more with exactly the moments of a standard normal law: pairs z, -z of scrambled Sobol'
/// points through the normal quantile, sheared until their covariance is the identity.
///
/// shape   (D, max(2 D, count rounded up to an even number)); the same at every call
/// cost    O(D^2 count)
Eigen::MatrixXd standard_normal_points(std::size_t dimensions, std::size_t count);

/// The transform of the extended Kalman filter: f's tangent at the mean.
///
///   z ~ N(0, I):   mean = f(0),   root = df/dz at 0, column by column with dual numbers
///
/// shape   f: n numbers of type S, as a vector, to a vector of S; exact for linear f
/// cost    n evaluations of f
struct Tangent {
  template <class F>
  static Gaussian image(const F& f, std::size_t n, const std::vector<bool>&) {
    Gaussian law;
    std::vector<Dual> z(n);
    for (std::size_t k = 0; k < n; ++k) {
      z[k].slope = 1;
      const std::vector<Dual> out = f(z);
      z[k].slope = 0;
      const auto rows = static_cast<Eigen::Index>(out.size());
      if (k == 0) law = {Eigen::VectorXd(rows), Eigen::MatrixXd(rows, static_cast<Eigen::Index>(n))};
      for (Eigen::Index i = 0; i < rows; ++i) {
        law.mean(i) = out[static_cast<std::size_t>(i)].value;
        law.root(i, static_cast<Eigen::Index>(k)) = out[static_cast<std::size_t>(i)].slope;
      }
    }
    return law;
  }
};

/// The transform of the unscented Kalman filter: the moments of f at 2 n + 1 sigma points.
///
///   z ~ N(0, I):   points 0 and +-sqrt(n + k) e_j with weights k / (n + k) and 1 / (2 (n + k)),   k = max(0, 3 - n)
///   mean = sum w f,   root columns sqrt(w) (f - mean)
///
/// k matches the normal law's fourth moments for n <= 3; beyond, where that wants a negative weight and may give a
/// negative variance, it is 0. Differences of angles are wrapped, so their images must lie within half a turn of f(0).
///
/// shape   as Tangent; `angle` marks the components of f that are angles
/// cost    2 n + 1 evaluations of f
/// source  Julier & Uhlmann 1997; for k = 0 the cubature rule of Arasaratnam & Haykin 2009
struct Unscented {
  template <class F>
  static Gaussian image(const F& f, std::size_t n, const std::vector<bool>& angle) {
    const double spread = std::max(3.0, static_cast<double>(n));
    const double weight = 0.5 / spread;
    const double weight_of_centre = 1 - 2 * weight * static_cast<double>(n);
    std::vector<double> z(n);
    const std::vector<double> centre = f(z);
    const auto rows = static_cast<Eigen::Index>(centre.size());
    Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(2 * n + 1));
    for (std::size_t k = 0; k < 2 * n; ++k) {
      z[k / 2] = (k % 2 == 0 ? 1 : -1) * std::sqrt(spread);
      const std::vector<double> out = f(z);
      z[k / 2] = 0;
      for (std::size_t i = 0; i < out.size(); ++i) {
        const double difference = out[i] - centre[i];
        differences(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            angle[i] ? numbers::wrap(difference) : difference;
      }
    }
    const Eigen::VectorXd shift = weight * differences.rowwise().sum();
    Gaussian law{shift + Eigen::Map<const Eigen::VectorXd>(centre.data(), rows), differences.colwise() - shift};
    law.root.leftCols(static_cast<Eigen::Index>(2 * n)) *= std::sqrt(weight);
    law.root.rightCols(1) *= std::sqrt(std::max(0.0, weight_of_centre));
    return law;
  }
};

}  // namespace mote
