#include "mote/model/linear_gaussian.hpp"

#include <stdexcept>

namespace mote {
namespace {

using Matrix = Eigen::MatrixXd;

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

void require_shape(const Matrix& A, Eigen::Index rows, Eigen::Index columns, const std::string& name) {
  require(A.rows() == rows && A.cols() == columns, name + " must be " + std::to_string(rows) + " x " +
                                                       std::to_string(columns) + ", it is " + std::to_string(A.rows()) +
                                                       " x " + std::to_string(A.cols()));
  require(A.allFinite(), name + " has an entry that is not a finite number");
}

/// A root of a covariance: the Cholesky factor if it is definite, else from its eigenvalues. `definite` says which.
Matrix root_of(const Matrix& A, const std::string& name, bool& definite) {
  require((A - A.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * (1 + A.cwiseAbs().maxCoeff()),
          name + " must be symmetric");
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(A);
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  require(eigen.eigenvalues().minCoeff() >= -1e-9 * largest,
          name + " must have no negative eigenvalue (it is a covariance)");
  definite = eigen.eigenvalues().minCoeff() > 1e-12 * largest;
  if (definite) return A.llt().matrixL();
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

std::vector<std::string> names_or(std::vector<std::string> given, const std::string& stem, Eigen::Index n,
                                  const std::string& what) {
  if (given.empty() && n == 1) return {stem};
  for (Eigen::Index i = 1; given.size() < static_cast<std::size_t>(n) && i <= n; ++i)
    given.push_back(stem + std::to_string(i));
  require(given.size() == static_cast<std::size_t>(n), "there must be " + std::to_string(n) + " names of " + what);
  return given;
}

}  // namespace

LinearGaussian::LinearGaussian(LinearGaussianParameters parameters) : p_(std::move(parameters)), definite_(false) {
  const Eigen::Index n = p_.F.rows();
  const Eigen::Index m = p_.H.rows();
  require(n > 0 && m > 0, "F and H must not be empty");
  require_shape(p_.F, n, n, "F");
  require_shape(p_.Q, n, n, "Q");
  require_shape(p_.H, m, n, "H");
  require_shape(p_.R, m, m, "R");
  require_shape(p_.mean, n, 1, "mean");
  require_shape(p_.covariance, n, n, "covariance");
  bool ignored = false;
  bool observation_definite = false;
  noise_root_ = root_of(p_.Q, "Q", definite_);
  prior_root_ = root_of(p_.covariance, "covariance", ignored);
  observation_root_ = root_of(p_.R, "R", observation_definite);
  require(observation_definite, "R must be positive definite");
  p_.state_names = names_or(std::move(p_.state_names), "x", n, "states");
  p_.observation_names = names_or(std::move(p_.observation_names), "y", m, "observations");
}

std::vector<Quantity> LinearGaussian::states() const {
  std::vector<Quantity> all;
  for (const std::string& name : p_.state_names) all.push_back({name, ""});
  return all;
}

std::vector<Column> LinearGaussian::columns() const {
  std::vector<Column> all;
  for (const std::string& name : p_.observation_names) all.push_back({name, ""});
  return all;
}

LinearGaussianOptimal::LinearGaussianOptimal(const LinearGaussian& model) {
  for (std::size_t rows = 0; rows <= 8; ++rows) gains_.push_back(gains(model, rows));
}

LinearGaussianOptimal::Gains LinearGaussianOptimal::gains(const LinearGaussian& model, std::size_t complete_rows) {
  const auto& p = model.parameters();
  const Matrix Qi = p.Q.inverse();
  const Matrix HtRi = p.H.transpose() * p.R.inverse();
  const Matrix C = (Qi + static_cast<double>(complete_rows) * HtRi * p.H).inverse();
  return {C.llt().matrixL(), C * Qi * p.F, C * HtRi};
}

}  // namespace mote
