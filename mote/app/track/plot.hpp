#pragma once
/// The report of a track.

#include <string>
#include <vector>

#include "mote/app/track/score.hpp"
#include "mote/report/page.hpp"
#include "mote/vision/tracker.hpp"

namespace mote {

/// Everything that a track through a video left.
struct TrackRecord {
  std::string video, command;
  Plan plan;
  std::vector<vision::Track> tracks;  ///< one a frame
  std::vector<vision::Box> truth;     ///< empty = none
  vision::StageTimes times;
  double seconds = 0;  ///< of tracking, without reading and writing
  std::size_t targets = 0;
  std::vector<std::string> notes;
};

std::vector<vision::Box> boxes_of(const TrackRecord& record);

/// Times of stretches without the target: "frame 12 to 30 (19 frames)".
std::vector<std::string> losses(const TrackRecord& record);

/// The track as a page: score, place and size over the frames, centre error and overlap where there is a truth.
report::Page track_page(const TrackRecord& record);

}  // namespace mote
