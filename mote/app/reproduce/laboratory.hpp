#pragma once
/// The laboratory: makes an item's recording, runs its filters, computes what is compared.

#include <functional>
#include <map>
#include <memory>
#include <tuple>

#include "mote/analog/method.hpp"
#include "mote/app/catalogue/scene.hpp"
#include "mote/app/commands/job.hpp"
#include "mote/app/reproduce/analogs.hpp"
#include "mote/app/reproduce/cinema.hpp"
#include "mote/app/reproduce/circuits.hpp"
#include "mote/app/reproduce/clusters.hpp"
#include "mote/app/reproduce/designs.hpp"
#include "mote/app/reproduce/item.hpp"
#include "mote/app/reproduce/statistics.hpp"

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

/// What a resampler did on the weights of one level, as the comparisons' repeats saw it.
struct Tradeoff {
  std::string run;
  double ess;
  double error, ns;  ///< mean error, median time
};

/// The error of a run to the posterior mean, over the repeats of a figure, and what its groups sent.
struct ErrorRow {
  std::string run, series;
  int number = 0;                       ///< of its series
  double error = 0;                     ///< median
  compare::Interval interval = {0, 0};  ///< of 95 %
  double messages = 0, bytes = 0;       ///< a step, means
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

/// One item at work. Repeat r adds r to the filter's seed and, where a kind asks for new recordings and the item
/// simulates, to the recording's; a mean difference gives its two runs different filter seeds, the others the same. On
/// weights, repeat r has its own weights, the same for all runs, which take turns.
class Laboratory {
 public:
  /// Makes every model and plan of the item.
  ///
  /// error   Refusal (kBadData) naming file:line for models, settings, options and states that do not exist
  explicit Laboratory(Item item);

  const Item& item() const { return item_; }
  /// Why the item cannot be regenerated, in a sentence: its clip, SimGrid, ngspice or a tool for circuits is missing;
  /// empty if nothing is.
  std::string missing() const;
  /// Filter runs that regenerate() takes, those it has made before included.
  std::size_t work() const;
  /// `ran` is called after every filter run.
  Outcome regenerate(const std::function<void()>& ran);

 private:
  struct Bench {
    Job job;
    Plan plan;
    std::shared_ptr<CircuitBench> circuit = nullptr;  ///< filters instead of the plan
    std::optional<Arguments> analog;                  ///< of a run by analog parts
    std::optional<analog::Design> design;             ///< its parts, simulated on first use
  };
  using Level = std::pair<double, std::uint64_t>;  // of ESS, repeat

  Bench bench_for(const Run& run) const;
  RunRecord mixed_record(Bench& bench, const Plan& plan) const;
  std::unique_ptr<CatalogueModel> model_with(const std::vector<std::string>& settings, const std::string& where) const;
  void check_figures() const;
  void check_comparisons() const;
  std::optional<std::size_t> place_of(const std::string& state) const;
  const Scene& scene(std::uint64_t offset);
  const RunRecord& record(const std::string& run, std::uint64_t recording_offset, std::uint64_t seed_offset);
  const std::vector<Resampled>& resamplings(double ess, std::uint64_t repeat);
  double resample_figure(const Comparison& comparison, std::uint64_t repeat, std::size_t side);
  std::vector<Tradeoff> tradeoffs() const;
  void run_filters(Outcome& outcome);
  void show_clips(Outcome& outcome);
  Samples samples_of(const Comparison& comparison);
  std::vector<double> sample(const Comparison& comparison, std::uint64_t repeat, std::size_t side);
  std::vector<double> mean_estimates(const RunRecord& record, std::size_t state);
  std::vector<std::size_t> places_of(const std::string& state) const;
  const std::vector<std::vector<double>>& posterior_means(std::uint64_t offset);
  double reference_error(const RunRecord& record, std::uint64_t offset, const std::string& state);
  std::vector<const Run*> drawn_in(const Figure& figure) const;
  std::vector<ErrorRow> errors_of(const Figure& figure);
  Result judged(const Comparison& comparison);
  std::string missing_tool(const Comparison& comparison) const;

  Item item_;
  std::vector<std::string> header_;
  std::unique_ptr<CatalogueModel> source_;
  std::vector<Quantity> states_;
  std::map<std::string, Bench> benches_;
  std::map<std::uint64_t, Scene> scenes_;
  std::map<std::tuple<std::string, std::uint64_t, std::uint64_t>, RunRecord> records_;
  std::map<Level, std::vector<Resampled>> resamplings_;  // by run
  std::unique_ptr<referee::Solver> solver_;
  std::map<std::uint64_t, std::vector<std::vector<double>>> posterior_means_;  // by recording, (T, D)
  std::unique_ptr<Cinema> cinema_;                                             // of an item on a clip
  std::unique_ptr<Clusters> clusters_;                                         // of an item on simulated clusters
  std::unique_ptr<Designs> designs_;                                           // of an item of designs
  std::unique_ptr<Analogs> analogs_;                                           // of an item on analog circuits
  std::function<void()> ran_;
};

}  // namespace mote::reproduce
