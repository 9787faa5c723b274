#pragma once
/// Scores of a track against the truth.

#include <span>

#include "mote/vision/pose.hpp"

namespace mote {

/// Means over the frames that have a true box, the first left out: it was given.
struct TrackScore {
  std::size_t frames = 0;
  double overlap = 0;  ///< intersection over union
  double centre_error_px = 0;
  double success = 0;  ///< share of frames with an overlap above 0.5
};

/// source  Wu, Lim & Yang 2013, sec. 3
TrackScore score_track(std::span<const vision::Box> boxes, std::span<const vision::Box> truth);

}  // namespace mote
