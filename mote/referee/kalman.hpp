#pragma once
/// The Kalman filter: exact means, covariances and evidence of linear Gaussian models, the referee of every particle
/// filter.

#include <vector>

#include <Eigen/Dense>

#include "mote/engine/recording.hpp"
#include "mote/model/linear_gaussian.hpp"
#include "mote/model/local_level.hpp"

namespace mote::referee {

/// The law of the state at one step, and what the step's data say of the model.
struct Gaussian {
  Step t;
  Eigen::VectorXd mean;        // (n,)
  Eigen::MatrixXd covariance;  // (n, n)
  double log_evidence;         // log p(y_t | y_{1:t-1}) of all rows of the step, nat; 0 without an observation
};

/// The local level as a linear Gaussian model of one state.
inline LinearGaussianParameters as_linear_gaussian(const LocalLevel& model) {
  const auto scalar = [](double v) { return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, v)); };
  return {scalar(1),
          scalar(model.p.var_level),
          scalar(1),
          scalar(model.p.var_obs),
          scalar(model.p.level0),
          scalar(model.p.p0),
          {"level"},
          {"y"}};
}
inline LinearGaussianParameters as_linear_gaussian(const LinearGaussian& model) { return model.parameters(); }

/// The filter in motion, one row at a time.
///
///   mean <- F mean,  P <- F P F' + Q;   S = H P H' + R,  K = P H' S^-1,  mean <- mean + K (y - H mean),  P <- (I - K
///   H) P (I - K H)' + K R K'
///
/// source  Kalman 1960; the covariance in Joseph's form, which stays symmetric and positive
class Kalman {
 public:
  explicit Kalman(LinearGaussianParameters p) : p_(std::move(p)), mean_(p_.mean), covariance_(p_.covariance) {}

  void predict() {
    mean_ = p_.F * mean_;
    covariance_ = p_.F * covariance_ * p_.F.transpose() + p_.Q;
  }
  /// Conditions on the entries of a row that were seen; returns the log density of what was seen.
  double update(const Row<double>& row) {
    std::vector<Eigen::Index> seen;
    for (Eigen::Index j = 0; j < p_.H.rows(); ++j)
      if (row.seen(static_cast<std::size_t>(j))) seen.push_back(j);
    if (seen.empty()) return 0;
    const Eigen::MatrixXd H = p_.H(seen, Eigen::all);
    const Eigen::MatrixXd R = p_.R(seen, seen);
    Eigen::VectorXd residual = -H * mean_;
    for (Eigen::Index j = 0; j < residual.size(); ++j)
      residual(j) += row[static_cast<std::size_t>(seen[static_cast<std::size_t>(j)])];
    const Eigen::MatrixXd S = H * covariance_ * H.transpose() + R;
    const Eigen::MatrixXd K = covariance_ * H.transpose() * S.inverse();
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(mean_.size(), mean_.size()) - K * H;
    mean_ += K * residual;
    covariance_ = rest * covariance_ * rest.transpose() + K * R * K.transpose();
    const double squares = residual.dot(S.inverse() * residual);
    return -0.5 * (squares + std::log(S.determinant()) + static_cast<double>(seen.size()) * std::log(2 * kPi));
  }
  const Eigen::VectorXd& mean() const { return mean_; }
  const Eigen::MatrixXd& covariance() const { return covariance_; }

 private:
  LinearGaussianParameters p_;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
};

/// The exact laws at the steps of a recording: gaps are predicted, rows of a step condition one after the other.
template <class M>
std::vector<Gaussian> kalman(const M& model, const Recording& recording) {
  Kalman filter(as_linear_gaussian(model));
  std::vector<Gaussian> laws;
  Step t = 0;
  for (const ObservedStep& step : recording.steps) {
    for (; t < step.t; ++t) filter.predict();
    double log_evidence = 0;
    for (const Row<double>& row : step.rows) log_evidence += filter.update(row);
    laws.push_back({t, filter.mean(), filter.covariance(), log_evidence});
  }
  return laws;
}

/// log p(y) of a whole recording.
inline double log_evidence(const std::vector<Gaussian>& laws) {
  double sum = 0;
  for (const Gaussian& law : laws) sum += law.log_evidence;
  return sum;
}

}  // namespace mote::referee
