#pragma once
/// The laboratory: makes an item's recording, runs its filters, computes what is compared.

#include <functional>
#include <map>
#include <memory>

#include "mote/app/reproduce/analogs.hpp"
#include "mote/app/reproduce/cinema.hpp"
#include "mote/app/reproduce/clusters.hpp"
#include "mote/app/reproduce/designs.hpp"
#include "mote/app/reproduce/filters.hpp"
#include "mote/app/reproduce/weights.hpp"

namespace mote::reproduce {

/// A comparison with its result.
struct Result {
  Comparison asked;
  double ours = 0;                            ///< NaN where a filter collapsed or the number does not exist
  std::optional<double> standard_error;       ///< of `ours`, over the repeats
  std::optional<compare::Interval> interval;  ///< of 95 %, likewise, of what is formed of medians
  std::optional<double> ratio;                ///< ours / paper, where the paper prints a number
  bool holds = false;
};

/// The runs of one item on its own recording, and the results of its comparisons.
struct Outcome {
  std::vector<Quantity> states;
  std::vector<Step> times;
  Truth truth;
  std::vector<std::pair<std::string, RunRecord>> records;  ///< by run, those that did not collapse
  std::vector<std::string> collapses;                      ///< what the others said
  std::vector<std::string> left_out;                       ///< comparisons of circuits whose tool is not there
  std::vector<Tradeoff> tradeoffs;                         ///< of an item on weights, instead of records
  std::vector<TrackRow> tracks;                            ///< of an item on a clip, likewise
  std::vector<report::Picture> pictures;                   ///< of an item on a clip
  std::map<std::string, std::vector<ErrorRow>> errors;     ///< by title of a figure that draws them against something
  std::vector<std::pair<std::string, simulated::Sweep>> sweeps;  ///< of an item on clusters, by run
  std::map<std::string, std::vector<DesignCurve>> curves;        ///< of an item of designs, by title of a figure
  std::map<std::string, report::Chart> drawn;                    ///< of an item on analog circuits, likewise
  std::vector<Result> results;
};

/// One item at work.
class Laboratory {
 public:
  /// Makes what the item's runs are.
  ///
  /// error   Refusal (kBadData) naming file:line for models, settings, options and states that do not exist
  explicit Laboratory(Item item);

  const Item& item() const { return item_; }
  /// Why the item cannot be regenerated, in a sentence: its clip, SimGrid, ngspice or a tool for circuits is missing;
  /// empty if nothing is.
  std::string missing() const;
  /// What outside tools have to find for regenerate(): pieces that may be done before it, side by side.
  std::vector<std::function<void()>> errands();
  /// Filter runs that regenerate() takes, those it has made before included.
  std::size_t work() const;
  /// `ran` is called after every filter run.
  Outcome regenerate(const std::function<void()>& ran);

 private:
  std::vector<double> sample(const Comparison& comparison, std::uint64_t repeat, std::size_t side);
  Samples samples_of(const Comparison& comparison);
  Result judged(const Comparison& comparison);
  void run_filters(Outcome& outcome);
  void show_clips(Outcome& outcome);

  Item item_;
  std::unique_ptr<Filters> filters_;  // one of these, by the item's kind
  std::unique_ptr<Weights> weights_;
  std::unique_ptr<Cinema> cinema_;
  std::unique_ptr<Clusters> clusters_;
  std::unique_ptr<Designs> designs_;
  std::unique_ptr<Analogs> analogs_;
  std::function<void()> ran_;
};

}  // namespace mote::reproduce
