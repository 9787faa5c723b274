#pragma once
/// Items of the papers: a figure, table or claim as data – what was printed, how to regenerate it, when it holds.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mote/app/reproduce/resampling.hpp"
#include "mote/engine/cast.hpp"

namespace mote::reproduce {

/// What an item's runs filter: a simulated recording ([simulate]) or files ([data]).
struct Source {
  std::string where;  ///< file:line
  std::string model;
  std::vector<std::string> settings;  ///< name=value
  int steps = 0;                      ///< of a simulation
  std::uint64_t seed = 1;
  int columns = 1;                            ///< doa: directions a frame
  std::string observations = {}, truth = {};  ///< files; observations is empty for a simulation, truth may be

  bool simulated() const { return observations.empty(); }
};

/// What an item's runs track: a clip among the data that others made ([clip]), or one that is drawn ([drawn]).
struct Clip {
  std::string where;
  std::string video, truth, init = {};    ///< under MOTE_DATA; empty for a drawn clip. The first box as for --init
  int frames = 0;                         ///< that are tracked
  std::uint64_t seed = 1;                 ///< of a drawn clip
  std::vector<std::string> options = {};  ///< of every run

  bool drawn() const { return video.empty(); }
};

/// What an item on analog circuits asks ([analog]): a command of `mote analog`, and options of every run.
struct AnalogSource {
  std::string where;
  std::string command;
  std::vector<std::string> options;
};

/// One filter run of an item: options as on the command line of `mote run`; of an item on a clip, of `mote track`; of a
/// circuit, of `mote rtl`; of one on analog circuits, of its command.
struct Run {
  std::string where;
  std::string name;
  std::vector<std::string> options;
  std::vector<std::string> settings;  ///< settings of the filter's model where they differ from the recording's
  std::string series = {};            ///< of runs that differ in a number: the name of the table they stand in
  int number = 0;                     ///< of such a run: its particles on a clip, else the value of `sweep`
  std::string sweep = {};             ///< the option that the series sweeps
  bool circuit = false;               ///< the golden model of a circuit filters
  bool analog = false;                ///< analog parts filter: options as of `mote analog run`
};

/// What is computed and compared with the paper. With one run the quantity itself; with two, the first run's over the
/// second's, but for kMeanDifference, which needs two, kNormalisedError, and kRecovered, which needs three.
/// kParticlesEnough takes series of runs.
struct Comparison {
  enum class Kind {
    kMeanDifference,   ///< RMS over time of the difference of two runs' mean estimates, each averaged over repeats
    kMeanSpread,       ///< Monte-Carlo deviation of the mean estimate: RMS over time, over repeats on one recording
    kRmse,             ///< RMS over time of mean - truth, on a new recording each repeat
    kNormalisedError,  ///< RMS over time and repeats of (mean - truth) / the last run's posterior sd; 1 = calibrated
    kFinalBias,        ///< mean - truth at the last step
    kReferenceError,   ///< mean square over time of mean - posterior mean, on a new recording each repeat
    kRecovered,        ///< of that error, what the second run wins back of what the first loses against the third
    kEvidenceSpread,   ///< standard deviation of the log evidence over repeats on one recording
    kSummary,          ///< a figure of the run's summary
    kResampleError,    ///< on given weights: mean square error of the resampled mean, in multinomial variances
    kResampleTime,     ///< on given weights: nanoseconds per draw
    kResampleCost,     ///< the product of both: what halves when a scheme needs half the draws or half the time
    kTrack,            ///< on a clip: a figure of the track's summary
    kParticlesEnough,  ///< on a clip: the least number of particles whose centre error is near that of the most
    kCluster,          ///< on a simulated cluster: time of all steps, or speed-up, of a cast
    kCircuit,          ///< a figure of a circuit that is simulated with the item's recording, and synthesised
    kDesign,           ///< a value of the convex programs, or of the exact schedule
    kAnalog,           ///< a value of a command on analog circuits, or on the power that components take
  };
  /// What a mean difference is measured in.
  enum class Unit { kStandardError, kPosteriorSd, kAbsolute };

  std::string where;
  std::string name;
  Kind kind = Kind::kRmse;
  std::vector<std::string> runs;
  std::string state;                 ///< a state, "position" for x and y together, "bearing" for their direction
  std::string key;                   ///< of the summary; of a design and of analog circuits a path in their JSON
  double slack = 0;                  ///< of kParticlesEnough: share that the centre error may be above that of the most
  double ess = 0;                    ///< level of the weights
  Cast cast = {};                    ///< of kCluster: proposers and weighers of the setting that is asked for
  double mhz = 0;                    ///< of kCircuit: the clock of its milliseconds; 0: the one that was found
  Unit unit = Unit::kStandardError;  ///< of a mean difference
  bool median = false;               ///< over the repeats, instead of the mean
  int repeats = 20;
  std::optional<double> at_least, at_most;                  ///< holds inside these
  std::optional<double> within;                             ///< holds when |ours / paper - 1| is at most this
  std::variant<std::monostate, double, std::string> paper;  ///< what the paper prints
  std::string note;
};

/// One figure of an item.
struct Figure {
  std::string where;
  std::string title;
  std::string state = {};              ///< drawn over time with the truth; empty: the track in the plane
  bool error = false;                  ///< draw |mean - truth| instead
  std::vector<std::string> runs = {};  ///< drawn; empty: all
  double ess = 0;                      ///< of an item on weights: error against time at this level
  std::vector<int> frames = {};  ///< of an item on a clip: these frames of a run; empty: centre error over particles
  std::string against =
      {};            ///< draw the error to the posterior mean against this: a key of kAgainst; `runs` may be series
  int repeats = 20;  ///< of such a figure; of a design's the most blocks that are drawn
  std::string quantity = {};  ///< of an item on clusters: one of the first two kClusterKeys, over the ranks; of one of
                              ///< designs: one of kDesignFigures; of one on analog circuits: the title of a
                              ///< chart in the command's report
};

/// One item.
struct Item {
  std::string file, paper, name, title, source, printed, note;
  Source recording;                                 ///< of an item without weights
  std::optional<WeightSource> weights;              ///< resamplers on given weights, instead of filters on a recording
  std::optional<Clip> clip;                         ///< or the tracker on a clip
  std::optional<std::vector<std::string>> cluster;  ///< or steps on simulated clusters: options of every run
  std::optional<std::vector<std::string>> design;   ///< or designs: options of every run
  std::optional<AnalogSource> analog;               ///< or analog circuits
  std::vector<Run> runs;
  std::vector<Figure> figures;
  std::vector<Comparison> comparisons;
};

/// The figures of a summary that a comparison may ask for.
inline constexpr std::array<std::string_view, 7> kSummaryKeys{
    "log_evidence",         "mean_ess",          "acceptance",    "collapses",
    "ns_per_particle_step", "messages_per_step", "bytes_per_step"};

/// What an error may be drawn against: what the groups of a run send, or the number that its series sweeps.
inline constexpr std::array<std::string_view, 3> kAgainst{"bytes_per_step", "messages_per_step", "number"};

/// The figures of a cast on a simulated cluster: seconds of all steps, and the first setting's over them, which are
/// drawn; both over what the latency laws say; and the speed-up over the most that the stages' times allow.
inline constexpr std::array<std::string_view, 5> kClusterKeys{"seconds", "speedup", "seconds_over_law",
                                                              "speedup_over_law", "speedup_over_most"};

/// What the time of a design is drawn over: pairs of proposer and weigher, or weighers beside one proposer.
inline constexpr std::array<std::string_view, 2> kDesignFigures{"pairs", "weighers"};

/// The figures of a circuit: of a run of the recording, of its area, and the cycles of a step over the latency law's.
inline constexpr std::array<std::string_view, 14> kCircuitKeys{
    "cycles", "golden_cycles", "mismatches", "stages",       "lut",      "ff",          "dsp",
    "bram18", "fmax_mhz",      "sta_ns",     "milliseconds", "power_mw", "uj_per_step", "step_cycles_over_law"};

/// The figures of a track that a comparison may ask for; those of time are a particle's stages in microseconds, and how
/// much longer than the others its weight takes.
inline constexpr std::array<std::string_view, 10> kTrackKeys{
    "overlap", "centre_error_px", "success", "lost_frames", "frames_per_second",
    "tp_us",   "tw_us",           "td_us",   "tw_over_tp",  "tw_over_td"};

/// Reads an item. `paper` is the name of its paper's folder.
///
/// error   Refusal (kBadData) naming file:line: broken TOML, unknown keys and kinds, runs that are not there or there
///         twice, a comparison that nothing can fail
Item read_item(const std::string& path, const std::string& paper);

/// Whether repeats of a comparison differ.
inline bool has_chance(const Comparison& comparison) { return comparison.kind < Comparison::Kind::kCluster; }

/// What a comparison computes, in a sentence's words.
std::string meaning_of(const Comparison& comparison);

/// When it holds: "at most 3", "0.9 to 1.1", "within 10 % of the paper".
std::string condition_of(const Comparison& comparison);

/// Settings with some changed: a changed one replaces its namesake.
std::vector<std::string> merged(std::vector<std::string> settings, const std::vector<std::string>& changes);

/// A name for files: "imh-hw-fig-5".
std::string slug(const std::string& text);

}  // namespace mote::reproduce
