#pragma once
/// The live window of `mote track --show`.

#include <string>

#include <opencv2/core.hpp>

#include "mote/vision/pose.hpp"

namespace mote {

/// A window that shows frames.
///
/// error   Refusal (kOutsideTool) without a display, or with one that opens no window
class Screen {
 public:
  explicit Screen(std::string where);
  void show(const cv::Mat& frame) const;
  /// Lets the user draw the target's box with the mouse; Enter or the space bar takes it.
  ///
  /// error   Refusal (kWrongUse) when it is called off (c), or smaller than 4 x 4 pixels
  vision::Box choose(const cv::Mat& frame) const;

 private:
  std::string where_;
};

}  // namespace mote
