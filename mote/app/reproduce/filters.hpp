#pragma once
/// Filters: what an item's comparisons and figures take from its runs on recordings.

#include <functional>

#include "mote/app/compare/statistics.hpp"
#include "mote/app/reproduce/runs.hpp"
#include "mote/app/reproduce/statistics.hpp"

namespace mote::reproduce {

/// The error of a run to the posterior mean, over the repeats of a figure, and what its groups sent.
struct ErrorRow {
  std::string run, series;
  int number = 0;                       ///< of its series
  double error = 0;                     ///< median
  compare::Interval interval = {0, 0};  ///< of 95 %
  double messages = 0, bytes = 0;       ///< a step, means
};

/// The filters of one item. Repeat r adds r to the filter's seed and, where a kind asks for new recordings and the item
/// simulates, to the recording's; a mean difference gives its two runs different filter seeds, the others the same.
class Filters {
 public:
  /// error   Refusal (kBadData) naming file:line for models, settings, options and states that do not exist
  explicit Filters(const Item& item);

  Runs& runs() { return runs_; }
  std::string missing() const { return runs_.missing(); }
  /// Why a comparison's tool is not there, in a sentence; empty if it is. The golden model of a circuit goes on without
  /// the tools that simulate and synthesise.
  std::string missing_tool(const Comparison& comparison);
  /// What tools have to find for comparisons of circuits (CircuitBench::errands()).
  std::vector<std::function<void()>> errands();
  /// Filter runs that comparisons and figures take, those made before included.
  std::size_t work() const;
  /// What a comparison takes from a repeat of one of its runs; `ran` is called after every filter run.
  std::vector<double> sample(const Comparison& comparison, std::uint64_t repeat, std::size_t side,
                             const std::function<void()>& ran);
  /// The posterior deviations of a mean difference's second run, by repeat and step.
  std::vector<std::vector<double>> posterior_sds(const Comparison& comparison);
  /// What a figure draws against something.
  std::vector<ErrorRow> errors_of(const Figure& figure, const std::function<void()>& ran);

 private:
  void check_figures() const;
  void check_comparisons();
  double truth_figure(const Comparison& comparison, const RunRecord& run, const Truth& truth) const;
  double normalised_error(const Comparison& comparison, const RunRecord& run, std::uint64_t repeat);
  double error(const EstimateRow& row, const Truth& truth, std::size_t state) const;
  std::vector<double> mean_estimates(const RunRecord& record, std::size_t state);
  const std::vector<std::vector<double>>& posterior_means(std::uint64_t offset);
  double reference_error(const RunRecord& record, std::uint64_t offset, const std::string& state);
  std::vector<const Run*> drawn_in(const Figure& figure) const;

  Runs runs_;
  std::unique_ptr<referee::Solver> solver_;
  std::map<std::uint64_t, std::vector<std::vector<double>>> posterior_means_;  // by recording, (T, D)
};

}  // namespace mote::reproduce
