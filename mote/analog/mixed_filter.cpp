#include "mote/analog/mixed_filter.hpp"

#include <algorithm>

#include "mote/analog/mixed_model.hpp"
#include "mote/analog/purposes.hpp"
#include "mote/base/refusal.hpp"
#include "mote/base/scan.hpp"
#include "mote/filter/imh.hpp"
#include "mote/filter/sisr.hpp"

namespace mote::analog {
namespace {

/// A filter whose estimates are an analog multiplier's: w_i (1 + e_i) in place of w_i.
class Multiplied final : public Filter {
 public:
  Multiplied(std::unique_ptr<Filter> filter, const Design& design) : filter_(std::move(filter)), design_(design) {}

  StepReport predict(Step t) override { return filter_->predict(t); }
  StepReport update(Step t, Rows<double> rows) override { return filter_->update(t, rows); }
  void select(Step t, StepReport& report) override { filter_->select(t, report); }
  void keep(Archive& archive) override { filter_->keep(archive); }

  WeightedSet weighted() const override {
    const WeightedSet set = filter_->weighted();
    while (gains_.size() < set.size()) add_gains();
    weights_.resize(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) weights_[i] = set.weights[i] * gains_[i];
    return {set.particles, weights_, ordered_sum(set.size(), [&](std::size_t i) { return weights_[i]; })};
  }

 private:
  /// The gains of one more block of particles.
  void add_gains() const {
    const std::size_t first = gains_.size();
    Draws{design_.seed, 0}.for_each(kMultiplierErrors, first, first + kBlock, [&](std::size_t, auto& draw) {
      gains_.push_back(std::max(0.0, 1 + design_.cells.multiplier_gain * draw.normal()));
    });
  }

  std::unique_ptr<Filter> filter_;
  Design design_;
  mutable std::vector<double> gains_, weights_;
};

/// A chain filter whose estimates are from what its chains chose, which counts alike: no weight is needed but to
/// accept.
class ChainStates final : public Filter {
 public:
  ChainStates(const MixedModel& model, const Plan& plan)
      : filter_(model, plan.particles, plan.seed, plan.chain, plan.on_collapse), weights_(plan.particles, 1.0) {}

  StepReport predict(Step t) override { return filter_.predict(t); }
  StepReport update(Step t, Rows<double> rows) override {
    StepReport report = filter_.update(t, rows);
    filter_.select(t, report);
    return report;
  }
  void select(Step, StepReport&) override {}  // chosen with the update
  WeightedSet weighted() const override { return {&filter_.kept(), weights_, static_cast<double>(weights_.size())}; }
  void keep(Archive& archive) override { filter_.keep(archive); }

 private:
  MetropolisFilter<MixedModel, double, Prior, MixtureWeight> filter_;
  std::vector<double> weights_;
};

void require(bool holds, const std::string& where, const std::string& what, const std::string& expected,
             const std::string& got, const std::string& next) {
  if (!holds) throw Refusal(ExitCode::kWrongUse, {where, what, expected, got, next});
}

void check_plan(const Plan& plan, Method method, const std::string& where) {
  const bool imh = plan.filter == FilterKind::kImh;
  const std::string filter = "--filter " + std::string(name_of(plan.filter));
  require(method != Method::kAllButRandom || imh, where, "--method 3", "--filter imh, which compares logarithms",
          filter, "Pass --filter imh.");
  require(imh || plan.filter == FilterKind::kSisr || plan.filter == FilterKind::kAuxiliary, where, "--filter",
          "sisr, imh or auxiliary, which mixed mode has", filter, "Pass --filter sisr.");
  require(plan.engine == Engine::kFastest || plan.engine == Engine::kReference, where, "--engine",
          "reference, the only one that has analog parts", std::string(name_of(plan.engine)), "Leave --engine out.");
  require(plan.precision == Precision::kDouble, where, "--precision", "double around analog parts", "float",
          "Leave --precision out.");
  require(plan.proposal == Prior::kName, where, "--proposal", "prior, the only one in mixed mode", plan.proposal,
          "Leave --proposal out.");
}

/// Whether every Gaussian behind an arctangent, one at least, can be made wider by a known number.
bool can_inflate(const Placement& placement) {
  std::size_t wider = 0;
  for (graph::Id id = 0; id < placement.behind_arctan.size(); ++id) {
    if (!placement.behind_arctan[id]) continue;
    if (!inverse_sigma(placement, id)) return false;
    ++wider;
  }
  return wider > 0;
}

void check_placement(const Placement& placement, const Design& design, const std::string& where) {
  require(!design.arctan || placement.arctans > 0, where, "--analog arctan", "a model whose likelihood has an atan",
          "one without", "Leave arctan out of --analog.");
  require(!design.gaussian || placement.gaussians > 0, where, "--analog gaussian",
          "a model whose likelihood has squares (a normal error) or exp(-x^2)", "one without",
          "Leave gaussian out of --analog.");
  require(placement.arctans + placement.gaussians > 0, where, "--analog",
          "a model with atan, squares or exp(-x^2) in its likelihood", "one without", "Pass another model.");
  const bool calibrated = std::find(placement.against_arctan.begin(), placement.against_arctan.end(), true) !=
                          placement.against_arctan.end();
  require(design.calibration == Calibration::kNone || (design.arctan && calibrated), where, "--calibrate",
          "a model that subtracts an analog atan from a measurement", "none such", "Pass --calibrate none.");
  require(design.calibration != Calibration::kInflate || can_inflate(placement), where, "--calibrate inflate",
          "a Gaussian of constant sigma behind the analog atan", "another law of errors", "Pass --calibrate transfer.");
}

Wanted wanted(const Design& design) {
  return {design.arctan.has_value(), design.gaussian.has_value() || design.method == Method::kAllButRandom};
}

std::unique_ptr<Filter> filter_of(const MixedModel& model, const Plan& plan, Method method) {
  if (plan.filter == FilterKind::kSisr)
    return make_sisr(model, plan.particles, plan.seed, plan.selection, plan.on_collapse);
  if (plan.filter == FilterKind::kAuxiliary)
    return make_auxiliary(model, plan.particles, plan.seed, plan.chain, plan.on_collapse);
  if (method == Method::kAllButRandom) return std::make_unique<ChainStates>(model, plan);
  return make_imh(model, plan.particles, plan.seed, plan.chain, plan.on_collapse);
}

}  // namespace

std::unique_ptr<Filter> make_mixed_filter(const graph::Recorded& recorded, const Plan& plan, const Design& design,
                                          const std::string& where) {
  check_plan(plan, design.method, where);
  const Placement placement = placed(recorded, design.method, wanted(design), design.cells);
  check_placement(placement, design, where);
  std::unique_ptr<Filter> filter = filter_of(MixedModel(placement, design, plan.seed), plan, design.method);
  if (design.method == Method::kWeights) return filter;
  return std::make_unique<Multiplied>(std::move(filter), design);
}

}  // namespace mote::analog
