#pragma once
/// Extended and unscented Kalman filters of any model: one Gaussian instead of particles.

#include <memory>
#include <optional>
#include <stdexcept>

#include "mote/filter/filter.hpp"
#include "mote/filter/gaussian.hpp"
#include "mote/filter/options.hpp"
#include "mote/filter/still.hpp"

namespace mote {

/// Draws that are given: the normal numbers of a list, in order. A uniform number is not among them.
template <class S>
class GivenDraw {
 public:
  GivenDraw(const std::vector<S>& numbers, std::size_t first) : numbers_(&numbers), next_(first) {}
  S normal() { return numbers_->at(next_++); }
  S uniform() { throw std::invalid_argument("GivenDraw: a uniform number has no Gaussian law"); }

 private:
  const std::vector<S>* numbers_;
  std::size_t next_;
};

/// Whether all noise of a model is made of normal numbers: what a Kalman filter asks of it.
template <Observable M>
bool has_normal_noise(const M& model) {
  StillDraw<double> draw;
  const auto before = model.template initial<double>(draw);
  const auto x = model.template next<double>(1, before, draw);
  model.template observe<double>(1, x, blank_row(model), draw);
  return draw.uniforms == 0;
}

/// A Kalman filter of a nonlinear model: the law of the state is kept Gaussian, by the tangents of the model's
/// functions (extended, `Tangent`) or by sigma points (unscented, `Unscented`) of state and noise together.
///
///   x = m + L a,  a ~ N(0, I);   x' = next(x, u),  y = observe(x', v),   u, v the normal numbers that the model draws
///   predict   (m, L) = transform of next over (a, u)
///   update    ((m, c), (X; Y)) = transform of (x', y) over (a, v);   S = Y Y',  K = X Y' S^-1
///             m <- m + K (y - c),  L <- X - K Y;   log evidence = log N(y; c, S), row after row
///
/// No proposals, no sampling: the same numbers for every seed. Exact for linear Gaussian models. weighted() gives
/// points with exactly the law's mean and covariance, N or a few more; the circular deviation of an angle is that of
/// the points.
///
/// shape   D states; N points; missing entries are left out, differences of angles wrapped
/// error   the constructor: std::invalid_argument if the model draws uniform numbers. An observation of density zero,
///         or a law that is not finite, is reported as a collapse, see OnCollapse: keep goes on with the prediction,
///         reset with the prior and the observation
/// cost    predict: D + (numbers drawn) evaluations of the model (unscented: twice as many, and one); O(D^2 N) for the
///         points; memory about 16 D N bytes
/// source  docs/filters.md (F40) to (F44); Särkkä 2013, sec. 5.2, 5.5
template <Observable M, class Transform>
class KalmanFilter final : public Filter {
 public:
  KalmanFilter(M model, std::size_t points, OnCollapse on_collapse)
      : model_(std::move(model)), on_collapse_(on_collapse) {
    if (!has_normal_noise(model_)) throw std::invalid_argument("KalmanFilter: the model's noise is not Gaussian");
    for (const Quantity& state : model_.states()) angle_.push_back(state.angle);
    columns_ = model_.columns();
    standard_ = standard_normal_points(angle_.size(), points);
    const auto count = static_cast<std::size_t>(standard_.cols());
    points_.emplace(angle_.size(), count);
    weights_.assign(count, 1.0);
    law_ = prior();
    show();
  }

  StepReport predict(Step t) override {
    law_ = predicted(t);
    return told({});
  }

  StepReport update(Step t, Rows<double> rows) override {
    const Gaussian before = law_ = predicted(t);
    StepReport report;
    report.log_evidence = conditioned(t, rows);
    if (!std::isfinite(report.log_evidence)) {
      report.log_evidence = -kInfinity;
      report.collapsed = true;
      law_ = before;
      if (on_collapse_ == OnCollapse::kReset) {
        law_ = prior();
        if (!std::isfinite(conditioned(t, rows))) law_ = prior();
      }
    }
    return told(report);
  }

  void select(Step, StepReport&) override {}

  WeightedSet weighted() const override { return {&*points_, weights_, static_cast<double>(weights_.size())}; }

  void keep(Archive& archive) override { archive(law_); }

  const Gaussian& law() const { return law_; }

 private:
  StepReport told(StepReport report) {
    show();
    report.ess = static_cast<double>(weights_.size());
    return report;
  }

  /// m + L a in the number type of a.
  template <class S>
  StateOf<M, S> state_at(const std::vector<S>& a) const {
    auto x = blank_state<S>(model_);
    for (Eigen::Index i = 0; i < law_.mean.size(); ++i) {
      S sum(law_.mean(i));
      for (Eigen::Index j = 0; j < law_.root.cols(); ++j)
        sum = sum + S(law_.root(i, j)) * a[static_cast<std::size_t>(j)];
      x[static_cast<std::size_t>(i)] = sum;
    }
    return x;
  }

  /// The mean as a state.
  StateOf<M, double> centre() const {
    return state_at<double>(std::vector<double>(static_cast<std::size_t>(law_.root.cols()), 0.0));
  }

  Gaussian squared(Gaussian law) const {
    law.root = triangular(law.root);
    for (std::size_t d = 0; d < angle_.size(); ++d) {
      double& mean = law.mean(static_cast<Eigen::Index>(d));
      if (angle_[d]) mean = numbers::wrap(mean);
    }
    return law;
  }

  Gaussian prior() const {
    StillDraw<double> counted;
    model_.template initial<double>(counted);
    const auto start = [&]<class S>(const std::vector<S>& z) {
      GivenDraw<S> draw(z, 0);
      const auto x = model_.template initial<S>(draw);
      return std::vector<S>(x.begin(), x.end());
    };
    return squared(Transform::image(start, counted.normals, angle_));
  }

  Gaussian predicted(Step t) const {
    StillDraw<double> counted;
    model_.template next<double>(t, centre(), counted);
    const auto moved = [&]<class S>(const std::vector<S>& z) {
      GivenDraw<S> draw(z, angle_.size());
      const auto x = model_.template next<S>(t, state_at(z), draw);
      return std::vector<S>(x.begin(), x.end());
    };
    return squared(Transform::image(moved, angle_.size() + counted.normals, angle_));
  }

  /// Conditions the law on the rows, one after the other; returns the log density of what they have seen, not finite if
  /// that is zero.
  double conditioned(Step t, Rows<double> rows) {
    double sum = 0;
    for (const Row<double>& row : rows) sum += conditioned_on(t, row);
    return law_.mean.allFinite() && law_.root.allFinite() ? sum : -kInfinity;
  }

  double conditioned_on(Step t, const Row<double>& row) {
    std::vector<std::size_t> seen;
    std::vector<bool> angle = angle_;
    for (std::size_t j = 0; j < columns_.size(); ++j)
      if (!columns_[j].input && row.seen(j)) {
        seen.push_back(j);
        angle.push_back(columns_[j].angle);
      }
    if (seen.empty()) return 0;
    StillDraw<double> counted;
    model_.template observe<double>(t, centre(), row, counted);
    const auto both = [&]<class S>(const std::vector<S>& z) {
      GivenDraw<S> draw(z, angle_.size());
      const auto x = state_at(z);
      const Row<S> y = model_.template observe<S>(t, x, row.template as<S>(), draw);
      std::vector<S> all(x.begin(), x.end());
      for (const std::size_t j : seen) all.push_back(y[j]);
      return all;
    };
    const Gaussian joint = Transform::image(both, angle_.size() + counted.normals, angle);
    const auto m = static_cast<Eigen::Index>(seen.size());
    Eigen::VectorXd residual(m);
    for (Eigen::Index j = 0; j < m; ++j) {
      const std::size_t column = seen[static_cast<std::size_t>(j)];
      const double difference = row[column] - joint.mean(law_.mean.size() + j);
      residual(j) = columns_[column].angle ? numbers::wrap(difference) : difference;
    }
    return conditioned_on(joint, residual);
  }

  /// The Gaussian conditional of a joint law of state and observation, given the observation's residual.
  double conditioned_on(const Gaussian& joint, const Eigen::VectorXd& residual) {
    const Eigen::Index m = residual.size();
    const Eigen::MatrixXd X = joint.root.topRows(law_.mean.size());
    const Eigen::MatrixXd Y = joint.root.bottomRows(m);
    const Eigen::MatrixXd root = triangular(Y);
    const auto lower = root.triangularView<Eigen::Lower>();
    const Eigen::VectorXd standard = lower.solve(residual);
    // K = X Y' S^-1 with S = root root'
    const Eigen::MatrixXd K = lower.transpose().solve(lower.solve(Y * X.transpose())).transpose();
    law_ = squared({joint.mean.head(law_.mean.size()) + K * residual, X - K * Y});
    return -0.5 * (standard.squaredNorm() + static_cast<double>(m) * std::log(2 * kPi)) -
           root.diagonal().array().abs().log().sum();
  }

  /// Writes the law's points.
  void show() {
    const Eigen::MatrixXd at = (law_.root * standard_).colwise() + law_.mean;
    for (std::size_t d = 0; d < angle_.size(); ++d)
      for (std::size_t i = 0; i < points_->size(); ++i) {
        const double value = at(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(i));
        points_->component(d)[i] = angle_[d] ? numbers::wrap(value) : value;
      }
  }

  M model_;
  OnCollapse on_collapse_;
  std::vector<bool> angle_;
  std::vector<Column> columns_;
  Gaussian law_;
  Eigen::MatrixXd standard_;  // (D, N) of a standard normal law
  std::optional<Particles<double>> points_;
  std::vector<double> weights_;
};

/// The extended Kalman filter.
template <Observable M>
std::unique_ptr<Filter> make_ekf(M model, std::size_t points, OnCollapse on_collapse = OnCollapse::kStop) {
  return std::make_unique<KalmanFilter<M, Tangent>>(std::move(model), points, on_collapse);
}

/// The unscented Kalman filter.
template <Observable M>
std::unique_ptr<Filter> make_ukf(M model, std::size_t points, OnCollapse on_collapse = OnCollapse::kStop) {
  return std::make_unique<KalmanFilter<M, Unscented>>(std::move(model), points, on_collapse);
}

}  // namespace mote
