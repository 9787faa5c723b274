#pragma once
/// The report of a track.

#include <string>
#include <vector>

#include "mote/app/track/score.hpp"
#include "mote/base/numbers.hpp"
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
  std::vector<double> frame_seconds;  ///< of each frame's tracking, detection included, without reading and writing
  std::size_t targets = 0;
  std::vector<std::string> notes;
};

std::vector<vision::Box> boxes_of(const TrackRecord& record);

/// How long frames took: milliseconds that half of them, 99 in 100 and all of them stayed within.
struct FrameTimes {
  double p50 = kNaN, p99 = kNaN, max = kNaN;
};
FrameTimes frame_times_ms(const TrackRecord& record);

/// Frames per second of tracking.
double frame_rate(const TrackRecord& record);

/// A particle's stage times, microseconds: proposal, weight, selection (resampling, or its share of the chain). Times
/// pass for all threads at once: with K of them T_w is about a K-th of what one core takes.
struct ParticleTimes {
  double tp = 0, tw = 0, td = 0;
};
ParticleTimes particle_times_us(const TrackRecord& record);

/// Stretches without the target: "frame 12 to 30 (19 frames)", "frame 40".
std::vector<std::string> losses(const TrackRecord& record);

/// The track as a page: score, place and size over the frames, centre error and overlap where there is a truth.
report::Page track_page(const TrackRecord& record);

}  // namespace mote
