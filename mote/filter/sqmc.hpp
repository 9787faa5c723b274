#pragma once
/// Sequential quasi-Monte Carlo (SQMC): the bootstrap filter with evenly spread points for random numbers.

#include <algorithm>
#include <memory>

#include "mote/base/scan.hpp"
#include "mote/filter/hilbert.hpp"
#include "mote/filter/settle.hpp"
#include "mote/filter/sobol.hpp"
#include "mote/filter/still.hpp"

namespace mote {

/// SQMC: N evenly spread points a step; the first coordinate of each chooses a parent, the others move it.
///
///   points ((n + u) / N, u^n), n = 0..N-1:  u uniform in (0, 1),  u^n scrambled Sobol' points
///   parents in the order of Hilbert's curve (of value in one dimension);  a^n = the first whose cumulative weight
///   passes (n + u) / N;   x^n ~ g(. | x^{a^n}_{t-1}, y) by the coordinates of u^n
///   w^n = p(y | x^n) p(x^n | x^{a^n}) / (N g(x^n | x^{a^n}, y));   evidence = sum w^n
///
/// Parents are chosen when particles move, in predict(), too, from the weights of the step before.
///
/// shape   N particles; R is the number type of states and likelihoods, weights are double
/// error   std::invalid_argument when a step draws more numbers than Sobol knows dimensions; a collapsed step is
///         reported, see OnCollapse
/// cost    O(N log N) a step; memory about (2 D + 5) 8 N bytes
/// source  docs/filters.md (F36) to (F39); Gerber & Chopin 2015, algorithm 3
template <Model M, class R = double, class G = Prior>
class QuasiFilter final : public Filter {
 public:
  QuasiFilter(M model, std::size_t particles, std::uint64_t seed, OnCollapse on_collapse)
      : model_(std::move(model)),
        proposal_(make_proposal<G>(model_)),
        states_(model_.states()),
        seed_(seed),
        on_collapse_(on_collapse),
        sobol_(point_dimensions(model_)),
        cloud_(states_.size(), particles),
        before_(states_.size(), particles),
        ordered_weights_(particles),
        total_(static_cast<double>(particles)) {
    const ScrambledPoints points(sobol_, particles, draws(0));
    for (std::size_t i = 0; i < particles; ++i) {
      PointDraw<R> draw(points, i);
      cloud_.x.write(i, model_.template initial<R>(draw));
    }
  }

  StepReport predict(Step t) override {
    move_by_points(Prior{}, t, {});
    return told(settled(normalise(cloud_), false));
  }

  StepReport update(Step t, Rows<double> rows) override {
    const auto y = rows_as<R>(rows);
    move_by_points(proposal_, t, y);
    weigh<M, R>(model_, t, y, cloud_.x, cloud_.log_weights);
    return told(settle<M, R>(model_, t, y, cloud_, draws(t), on_collapse_));
  }

  void select(Step, StepReport& report) override { report.selected = true; }

  WeightedSet weighted() const override { return {&cloud_.x, cloud_.weights, total_}; }

  void keep(Archive& archive) override {
    archive(cloud_.x, total_);
    archive.fill(std::span(cloud_.weights));  // parents of the next step are chosen by them
  }

 private:
  Draws draws(Step t) const { return {seed_, static_cast<std::uint32_t>(t)}; }

  StepReport told(const Settled& step) {
    total_ = step.total;
    return step.report;
  }

  /// New particles with the log weights of (F4) but for the likelihood, from parents with chances in proportion to
  /// cloud_.weights.
  template <class Proposal>
  void move_by_points(const Proposal& proposal, Step t, Rows<R> y) {
    cover(proposal, t, y);
    place_particles(weighted(), states_, placed_);
    for (std::size_t n = 0; n < placed_.size(); ++n) ordered_weights_[n] = cloud_.weights[placed_[n].index];
    std::swap(cloud_.x, before_);
    cloud_.spread();
    const ScrambledPoints points(sobol_, cloud_.size(), draws(t));
    const WeightScan scan(ordered_weights_);
    WeightScan::Walk walk(scan);
    const double interval = scan.total() / static_cast<double>(cloud_.size());
    const double offset = draws(t).uniform(Purpose::kSelect);
    auto parent = blank_state<R>(model_);
    for (std::size_t n = 0; n < cloud_.size(); ++n) {
      before_.read(placed_[walk.find((static_cast<double>(n) + offset) * interval)].index, parent);
      PointDraw<R> draw(points, n);
      const auto x = proposal.template propose<R>(model_, t, parent, y, draw);
      cloud_.log_weights[n] += log_importance<R>(model_, proposal, t, x, parent, y);
      cloud_.x.write(n, x);
    }
  }

  /// Makes the points as many-dimensional as the step wants: proposals may draw more numbers than the model.
  template <class Proposal>
  void cover(const Proposal& proposal, Step t, Rows<R> y) {
    auto x = blank_state<R>(model_);
    cloud_.x.read(0, x);
    StillDraw<R> draw;
    proposal.template propose<R>(model_, t, x, y, draw);
    if (draw.taken() > sobol_.dimensions()) sobol_ = Sobol(draw.taken());
  }

  M model_;
  G proposal_;
  std::vector<Quantity> states_;
  std::uint64_t seed_;
  OnCollapse on_collapse_;
  Sobol sobol_;
  Cloud<R> cloud_;
  Particles<R> before_;
  std::vector<Placed> placed_;  // the particles along the curve
  std::vector<double> ordered_weights_;
  double total_;
};

/// The SQMC filter.
template <class R = double, class G = Prior, Model M>
std::unique_ptr<Filter> make_sqmc(M model, std::size_t particles, std::uint64_t seed,
                                  OnCollapse on_collapse = OnCollapse::kStop) {
  return std::make_unique<QuasiFilter<M, R, G>>(std::move(model), particles, seed, on_collapse);
}

}  // namespace mote
