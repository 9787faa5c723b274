#include "mote/app/track/score.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote {

TrackScore score_track(std::span<const vision::Box> boxes, std::span<const vision::Box> truth) {
  TrackScore score;
  for (std::size_t k = 1; k < std::min(boxes.size(), truth.size()); ++k) {
    if (std::isnan(truth[k].x + truth[k].y + truth[k].w + truth[k].h) || std::isnan(boxes[k].x)) continue;
    const double common = vision::overlap(boxes[k], truth[k]);
    score.overlap += common;
    score.centre_error_px += vision::centre_distance(boxes[k], truth[k]);
    score.success += common > 0.5;
    ++score.frames;
  }
  const double n = score.frames == 0 ? kNaN : static_cast<double>(score.frames);
  score.overlap /= n;
  score.centre_error_px /= n;
  score.success /= n;
  return score;
}

}  // namespace mote
