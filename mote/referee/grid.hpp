#pragma once
/// The point-mass filter of the growth model: its exact posterior on a grid, the referee where no formula exists.

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "mote/engine/recording.hpp"
#include "mote/model/ungm.hpp"

namespace mote::referee {

/// Posterior means by step, the evidence of the whole recording, and what the grid could not hold.
struct GridResult {
  std::vector<double> means;
  double log_evidence = 0;
  double outside = 0;  ///< largest probability, over the steps, that left the grid or came within 2 of its edge
};

/// Ungm<1> on equidistant points, by the trapezoidal rule.
///
///   p(x_t | y_{1:t-1}) = sum_j h N(x_t; f(x_j, t), q) p(x_j | y_{1:t-1})
///
/// The narrowest thing the rule must resolve is the drift's slope of 25 at zero: a source there sees a transition of
/// standard deviation sqrt(q) / 25 = 0.12. The rule's error for a Gaussian of standard deviation s falls like exp(-2
/// pi^2 s^2 / h^2): with h = 0.1 it is 1e-13, with h = 0.2 it would be 5e-4. The transition is cut off 7 standard
/// deviations from its mean (1e-12 of its mass) and kept in float (6e-8).
///
/// cost    14 points sqrt(q) / h products a step; one transition matrix per step index, kept and shared by all
///         recordings: 1.8 MB each at the defaults, 256 MB in all, then they are made afresh; not thread-safe
class Grid {
 public:
  explicit Grid(const Ungm<1>& model, double edge = 50, std::size_t points = 1001)
      : model_(model), edge_(edge), step_(2 * edge / static_cast<double>(points - 1)), points_(points) {}

  GridResult filter(const Recording& recording) {
    GridResult result;
    std::vector<double> density(points_);
    for (std::size_t i = 0; i < points_; ++i) density[i] = std::exp(normal_log_density(at(i), model_.p.p0));
    Step t = 0;
    for (const ObservedStep& step : recording.steps) {
      while (t < step.t) {
        density = predicted(density, ++t);
        result.outside = std::max(result.outside, 1 - mass(density, 0));
      }
      for (const Row<double>& row : step.rows) result.log_evidence += update(density, t, row);
      result.outside = std::max(result.outside, mass(density, 0) - mass(density, 2));
      result.means.push_back(mean(density));
    }
    return result;
  }

 private:
  /// The transition from every point: `width` densities from point first[j] on.
  struct Transition {
    std::size_t width;
    std::vector<std::size_t> first;
    std::vector<float> density;
  };

  static constexpr std::size_t kMostKept = std::size_t{64} << 20U;  // densities: 256 MB

  double at(std::size_t i) const { return -edge_ + step_ * static_cast<double>(i); }

  const Transition& transition(Step t) {
    const auto found = transitions_.find(t);
    if (found != transitions_.end()) return found->second;
    const double reach = 7 * std::sqrt(model_.p.q);
    Transition made{std::min(points_, static_cast<std::size_t>(2 * reach / step_) + 2), {}, {}};
    for (std::size_t j = 0; j < points_; ++j) {
      const double centre = model_.drift(t, at(j));
      const double lowest = std::floor((centre - reach + edge_) / step_);
      const auto most = static_cast<double>(points_ - made.width);
      made.first.push_back(static_cast<std::size_t>(std::clamp(lowest, 0.0, most)));
      for (std::size_t i = 0; i < made.width; ++i)
        made.density.push_back(
            static_cast<float>(step_ * std::exp(normal_log_density(at(made.first[j] + i) - centre, model_.p.q))));
    }
    if (kept_ + made.density.size() > kMostKept) transitions_.clear(), kept_ = 0;
    kept_ += made.density.size();
    return transitions_.emplace(t, std::move(made)).first->second;
  }

  std::vector<double> predicted(const std::vector<double>& density, Step t) {
    const Transition& move = transition(t);
    std::vector<double> next(points_, 0.0);
    for (std::size_t j = 0; j < points_; ++j) {
      const double mass = density[j];
      if (mass < 1e-100) continue;
      const float* from = move.density.data() + j * move.width;
      double* to = next.data() + move.first[j];
      for (std::size_t i = 0; i < move.width; ++i) to[i] += mass * static_cast<double>(from[i]);
    }
    return next;
  }

  /// Multiplies by the likelihood of a row and normalises; returns the log of the normaliser.
  double update(std::vector<double>& density, Step t, const Row<double>& row) const {
    std::vector<double> logs(points_);
    for (std::size_t i = 0; i < points_; ++i) logs[i] = model_.log_likelihood<double>(t, {at(i)}, row);
    const double largest = *std::max_element(logs.begin(), logs.end());
    double mass = 0;
    for (std::size_t i = 0; i < points_; ++i) mass += step_ * (density[i] *= std::exp(logs[i] - largest));
    for (double& d : density) d /= mass;
    return largest + std::log(mass);
  }

  /// The probability of the points that are more than `margin` away from the edges.
  double mass(const std::vector<double>& density, double margin) const {
    const auto skipped = static_cast<std::size_t>(margin / step_);
    double sum = 0;
    for (std::size_t i = skipped; i + skipped < points_; ++i) sum += step_ * density[i];
    return sum;
  }

  double mean(const std::vector<double>& density) const {
    double sum = 0;
    double mass = 0;
    for (std::size_t i = 0; i < points_; ++i) {
      sum += at(i) * density[i];
      mass += density[i];
    }
    return sum / mass;
  }

  Ungm<1> model_;
  double edge_, step_;
  std::size_t points_;
  std::size_t kept_ = 0;  // densities in transitions_
  std::map<Step, Transition> transitions_;
};

}  // namespace mote::referee
