#pragma once
/// Items of the papers: a figure or a table, as data – what was printed, how to regenerate it, when it holds.

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mote::reproduce {

/// A simulated recording that an item's runs share.
struct Simulated {
  std::string model;
  int steps = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> settings;  ///< name=value
  int columns = 1;                    ///< doa: directions a frame
};

/// One filter run of an item: options as on the command line of `mote run`.
struct Run {
  std::string name;
  std::vector<std::string> options;
  std::vector<std::string> settings;  ///< settings of the filter's model where they differ from the simulation's
};

/// What is computed and compared with the paper.
struct Comparison {
  enum class Kind {
    kMeanDifference,   ///< RMS difference over time of two runs' means, in Monte-Carlo deviations of one run
    kRmse,             ///< RMSE to the truth, mean over repeats
    kRmseRatio,        ///< RMSE of the first run over that of the second
    kNormalisedError,  ///< RMS of (mean - truth) / sd; 1 = a calibrated filter
    kEvidenceSpread,   ///< standard deviation over repeats of the log evidence on one recording
  };
  std::string name;
  Kind kind = Kind::kRmse;
  std::vector<std::string> runs;  ///< one, or two to compare
  std::string state;              ///< a state, or "position" for x and y together
  int repeats = 20;
  std::optional<double> at_least, at_most;
  std::variant<std::monostate, double, std::string> paper;  ///< what the paper prints
  std::string note;
};

/// The figure of an item.
struct Figure {
  std::string title;
  std::string state;   ///< drawn over time with the truth; empty: the track in the plane
  bool error = false;  ///< draw |mean - truth| instead
};

/// One item.
struct Item {
  std::string file, paper, name, title, printed, note;
  Simulated simulated;
  std::vector<Run> runs;
  std::vector<Figure> figures;
  std::vector<Comparison> comparisons;
};

/// Reads an item.
///
/// error   Refusal (kBadData) naming file:line for broken TOML, unknown keys, unknown kinds and runs that are not there
Item read_item(const std::string& path, const std::string& paper);

/// The words for a kind, as in the file.
std::string word_for(Comparison::Kind kind);

}  // namespace mote::reproduce
