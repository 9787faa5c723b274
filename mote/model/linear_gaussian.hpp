#pragma once
/// The linear Gaussian model of any size: the exactly solvable reference.

#include <Eigen/Dense>

#include "mote/model/densities.hpp"
#include "mote/model/model.hpp"

namespace mote {

class LinearGaussianOptimal;

/// Matrices of a linear Gaussian model with n states and m observations.
struct LinearGaussianParameters {
  Eigen::MatrixXd F, Q, H, R;  // (n, n), (n, n), (m, n), (m, m)
  Eigen::VectorXd mean;        // (n,), of x_0
  Eigen::MatrixXd covariance;  // (n, n), of x_0
  std::vector<std::string> state_names, observation_names;
};

/// x_t = F x_{t-1} + w,  y_t = H x_t + v,  w ~ N(0, Q),  v ~ N(0, R),  x_0 ~ N(mean, covariance).
///
/// shape   Q and covariance positive semidefinite, R positive definite; a row with gaps uses R's block of the others
/// error   the constructor refuses wrong shapes, asymmetric or indefinite matrices: std::invalid_argument naming one
class LinearGaussian {
 public:
  template <class S>
  using State = SmallVector<S>;
  using Proposals = std::tuple<Prior, LinearGaussianOptimal>;

  explicit LinearGaussian(LinearGaussianParameters parameters);

  const LinearGaussianParameters& parameters() const { return p_; }
  std::vector<Quantity> states() const;
  std::vector<Column> columns() const;
  Density density() const { return definite_ ? Density::kState : Density::kNone; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    State<S> mean;
    for (const double component : p_.mean) mean.push_back(S(component));
    return correlated(prior_root_, std::move(mean), draw);
  }
  template <class S, class D>
  State<S> next(Step, const State<S>& before, D& draw) const {
    return correlated(noise_root_, product(p_.F, before), draw);
  }
  template <class S>
  S log_likelihood(Step, const State<S>& x, const Row<S>& y) const {
    const State<S> expected = product(p_.H, x);
    std::vector<Eigen::Index> seen;
    for (Eigen::Index j = 0; j < p_.H.rows(); ++j)
      if (y.seen(static_cast<std::size_t>(j))) seen.push_back(j);
    if (seen.empty()) return S(0);
    State<S> residual(seen.size());
    for (std::size_t j = 0; j < seen.size(); ++j) {
      const auto k = static_cast<std::size_t>(seen[j]);
      residual[j] = y[k] - expected[k];
    }
    if (seen.size() == static_cast<std::size_t>(p_.H.rows())) return log_density(observation_root_, residual);
    return log_density(Eigen::MatrixXd(p_.R(seen, seen)).llt().matrixL(), residual);
  }
  template <class S>
  S log_transition(Step, const State<S>& x, const State<S>& before) const {
    State<S> residual = product(p_.F, before);
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = x[i] - residual[i];
    return log_density(noise_root_, residual);
  }
  template <class S, class D>
  Row<S> observe(Step, const State<S>& x, const Row<S>&, D& draw) const {
    const State<S> y = correlated(observation_root_, product(p_.H, x), draw);
    return Row<S>::of({y.begin(), y.end()});
  }

  /// A v, in the number type of v.
  template <class S>
  static State<S> product(const Eigen::MatrixXd& A, const State<S>& v) {
    State<S> sums(static_cast<std::size_t>(A.rows()), S(0));
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      for (Eigen::Index j = 0; j < A.cols(); ++j) {
        S& sum = sums[static_cast<std::size_t>(i)];
        sum = sum + S(A(i, j)) * v[static_cast<std::size_t>(j)];
      }
    return sums;
  }

  /// mean + L z, z standard normal: L is a lower-triangular or any other root of the covariance.
  template <class S, class D>
  static State<S> correlated(const Eigen::MatrixXd& root, State<S> mean, D& draw) {
    State<S> z(static_cast<std::size_t>(root.cols()));
    for (S& component : z) component = draw.normal();
    const State<S> noise = product(root, z);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = mean[i] + noise[i];
    return mean;
  }

  /// log N(residual; 0, L L') for a lower-triangular L with positive diagonal.
  template <class S>
  static S log_density(const Eigen::MatrixXd& L, const State<S>& residual) {
    State<S> z(residual.size());
    S sum = S(0);
    double log_root = 0;
    for (Eigen::Index i = 0; i < L.rows(); ++i) {
      S rest = residual[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < i; ++j) rest = rest - S(L(i, j)) * z[static_cast<std::size_t>(j)];
      z[static_cast<std::size_t>(i)] = rest * S(1 / L(i, i));
      sum = sum + z[static_cast<std::size_t>(i)] * z[static_cast<std::size_t>(i)];
      log_root += std::log(L(i, i));
    }
    return sum * S(-0.5) + S(-log_root - 0.5 * static_cast<double>(L.rows()) * std::log(2 * kPi));
  }

 private:
  LinearGaussianParameters p_;
  Eigen::MatrixXd prior_root_, noise_root_, observation_root_;
  bool definite_;  // Q has full rank
};

/// The optimal proposal p(x_t | x_{t-1}, y_t) of a linear Gaussian model with a definite Q.
///
///   C = (Q^-1 + n H' R^-1 H)^-1,   mean = C (Q^-1 F x_{t-1} + H' R^-1 sum y),   n complete rows in the step
///
/// rows with missing entries are left to the weight; the gains for up to eight rows a step are computed once
class LinearGaussianOptimal {
 public:
  static constexpr std::string_view kName = "optimal";
  static constexpr std::string_view kMeaning = "p(x_t | x_{t-1}, y_t), exact for this model";

  explicit LinearGaussianOptimal(const LinearGaussian& model);

  template <class S, class D>
  SmallVector<S> propose(const LinearGaussian& model, Step, const SmallVector<S>& before, Rows<S> y, D& draw) const {
    const Conditional<S> c = conditional(model, before, y);
    return LinearGaussian::correlated(c.root, c.mean, draw);
  }
  template <class S>
  S log_density(const LinearGaussian& model, Step, const SmallVector<S>& x, const SmallVector<S>& before,
                Rows<S> y) const {
    Conditional<S> c = conditional(model, before, y);
    for (std::size_t i = 0; i < x.size(); ++i) c.mean[i] = x[i] - c.mean[i];
    return LinearGaussian::log_density(c.root, c.mean);
  }

 private:
  template <class S>
  struct Conditional {
    SmallVector<S> mean;
    Eigen::MatrixXd root;
  };
  /// C's root, C Q^-1 F and C H' R^-1 depend on the number of complete rows only.
  struct Gains {
    Eigen::MatrixXd root, from_state, from_observation;
  };
  static Gains gains(const LinearGaussian& model, std::size_t complete_rows);

  template <class S>
  Conditional<S> conditional(const LinearGaussian& model, const SmallVector<S>& before, Rows<S> rows) const {
    SmallVector<S> sum(static_cast<std::size_t>(model.parameters().H.rows()), S(0));
    std::size_t complete = 0;
    for (const Row<S>& row : rows) {
      bool whole = true;
      for (std::size_t j = 0; j < sum.size(); ++j) whole = whole && row.seen(j);
      if (!whole) continue;
      ++complete;
      for (std::size_t j = 0; j < sum.size(); ++j) sum[j] = sum[j] + row[j];
    }
    const Gains g = complete < gains_.size() ? gains_[complete] : gains(model, complete);
    SmallVector<S> mean = LinearGaussian::product(g.from_state, before);
    const SmallVector<S> correction = LinearGaussian::product(g.from_observation, sum);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = mean[i] + correction[i];
    return {std::move(mean), g.root};
  }

  std::vector<Gains> gains_;  // by the number of complete rows
};

}  // namespace mote
