#pragma once
/// The cinema: runs the tracker on an item's clip, by the program mote-track, and keeps what its summaries say.

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mote/app/reproduce/item.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/report/page.hpp"

namespace mote::reproduce {

/// One track, as its summary has it.
struct TrackRow {
  std::string run, series;
  int particles = 0;
  std::uint64_t repeat = 0;
  std::map<std::string, double, std::less<>> figures;  ///< by kTrackKeys
};

/// The tracks of one item. Repeat r adds r to the filter's seed and, where the clip is drawn, to the clip's.
class Cinema {
 public:
  /// error   Refusal (kBadData) naming file:line for options that `mote track` does not have
  explicit Cinema(const Item& item);

  /// Where the clip should be and is not; empty if it is there, or is drawn.
  std::string missing() const;
  /// Tracks that the comparisons and figures take.
  std::size_t work() const;
  /// What a comparison takes from a repeat of one of its runs, or series; `ran` is called after every track.
  ///
  /// error   Refusal: the tracker refused, collapsed or was interrupted (its own words and code)
  std::vector<double> sample(const Comparison& comparison, std::uint64_t repeat, std::size_t side,
                             const std::function<void()>& ran);
  /// Numbers of particles of a series, rising.
  std::vector<double> particles_of(const std::string& series) const;
  /// The frames that a figure shows, with the track of repeat 0 drawn in.
  report::Picture picture(const Figure& figure, const std::function<void()>& ran);
  /// All tracks so far.
  std::vector<TrackRow> rows() const;

 private:
  struct Bench {
    Run run;
    std::uint64_t seed;
    int particles;
  };
  struct Reel {
    std::string video, truth, init;
  };

  const Bench& bench_of(const std::string& run) const;
  const Reel& reel(std::uint64_t repeat);
  const TrackRow& track(const std::string& run, std::uint64_t repeat, const std::function<void()>& ran);
  std::vector<std::string> runs_of(const Comparison& comparison, std::size_t side) const;
  std::vector<std::string> words(const Bench& bench, std::uint64_t repeat);
  void run_words(const std::vector<std::string>& words) const;

  std::string paper_, name_;
  Clip clip_;
  std::vector<Figure> figures_;
  std::vector<Comparison> comparisons_;
  std::vector<Bench> benches_;
  std::string data_;
  std::optional<ScratchFolder> scratch_;  // from the first track on
  std::map<std::uint64_t, Reel> reels_;
  std::map<std::pair<std::string, std::uint64_t>, TrackRow> rows_;
};

/// The folder with other people's data: MOTE_DATA, or shared/data beside the checkout that the item's file is in.
std::string data_folder(const std::string& item_file);

}  // namespace mote::reproduce
