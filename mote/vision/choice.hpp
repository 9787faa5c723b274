#pragma once
/// The choice of a target among detections: not the best of one frame, which may be a false alarm, but one that stays.

#include <optional>
#include <span>
#include <vector>

#include "mote/vision/detector.hpp"

namespace mote::vision {

/// Watches detections over frames until one has been seen in `kPersistence` frames on end.
///
///   of those that have, the largest  mean score * sqrt(area):  what is sure and large is easiest to follow
class Choice {
 public:
  static constexpr int kPersistence = 3;  ///< frames

  /// Notes the detections of the next frame; a detection is the one of the frame before that it overlaps most, by at
  /// least 0.4.
  ///
  /// shape   found: best first, as Detector::detect() gives them
  /// returns the chosen box as it lies in this frame; nothing as long as no detection has lasted
  std::optional<Box> note(std::span<const Detection> found);
  /// Whether a detection is being watched, so that the next frame should be searched, too.
  bool watching() const { return !watched_.empty(); }

 private:
  struct Watched {
    Box box;
    double scores = 0;  // sum
    int frames = 0;
  };
  std::vector<Watched> watched_;
};

}  // namespace mote::vision
