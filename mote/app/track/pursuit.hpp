#pragma once
/// A pursuit: targets tracked through a video one after the other, chosen by a box or by a detector.

#include <optional>

#include "mote/app/track/plot.hpp"
#include "mote/vision/choice.hpp"

namespace mote {

class Pursuit {
 public:
  /// `where` opens refusals; a first box, a detector, or both.
  Pursuit(std::string where, vision::TrackerOptions options, std::optional<vision::Box> init,
          std::optional<vision::Detector> detector);

  /// Tracks into the next frame.
  ///
  /// error   Refusal: the first box is outside the frame (kWrongUse); all weights zero and the plan stops (kCollapsed)
  const vision::Track& step(const cv::Mat& frame);
  TrackRecord& record() { return record_; }
  /// Sides of the present target's first box.
  const vision::Size& first() const { return first_; }
  /// The record with the times of the last tracker.
  TrackRecord finished();

 private:
  void check_box(const cv::Mat& frame) const;
  vision::Track begin(const cv::Mat& frame);
  vision::Track take(const cv::Mat& frame, const vision::Box& box);
  vision::Track next(const cv::Mat& frame);
  std::vector<vision::Detection> detections(const cv::Mat& frame, std::size_t frames_without) const;
  void add_times();

  std::string where_;
  vision::TrackerOptions options_;
  std::optional<vision::Box> init_;
  std::optional<vision::Detector> detector_;
  vision::Choice choice_;
  std::optional<vision::Tracker> tracker_;
  vision::Size first_{};
  TrackRecord record_;
};

}  // namespace mote
