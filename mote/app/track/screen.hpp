#pragma once
/// The live window of `mote track --show`.

#include <string>

#include <opencv2/core.hpp>

namespace mote {

/// A window that shows frames.
///
/// error   Refusal (kOutsideTool) without a display
class Screen {
 public:
  explicit Screen(const std::string& where);
  void show(const cv::Mat& frame) const;
};

}  // namespace mote
