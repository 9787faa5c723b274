#pragma once
/// Detectors: where targets of a kind are, by histograms of oriented gradients and a support-vector machine.

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/objdetect.hpp>

#include "mote/vision/pose.hpp"

namespace mote::vision {

struct Detection {
  Box box;
  double score;  ///< distance from the machine's plane
};

/// Finds targets of one kind in a frame.
///
/// source  Dalal & Triggs 2005
class Detector {
 public:
  /// OpenCV's detector of standing people; its boxes have a rim, which is cut off (0.56 of the width and 0.8 of the
  /// height are left).
  static Detector people();
  /// A detector of 64 x 64 patches, trained by `mote train`.
  ///
  /// error   Refusal (kBadData) when the file is no detector
  static Detector from_file(const std::string& path);
  /// A detector of 64 x 64 patches with the weights of its features and the offset behind them.
  explicit Detector(const std::vector<float>& weights);

  /// Targets, best first; of those that overlap by more than 0.3 the best.
  ///
  /// cost    some 50 ms for 352 x 288
  std::vector<Detection> detect(const cv::Mat& frame) const;

 private:
  Detector() = default;

  cv::HOGDescriptor hog_;
  double keep_w_ = 1, keep_h_ = 1;  // of the descriptor's window
  double threshold_ = 0;
  double least_height_ = 0;  // of frames, px: standing people may be smaller than the descriptor's window
};

/// The descriptor of square patches, 64 x 64 in blocks of 16 and cells of 8.
cv::HOGDescriptor patch_descriptor();

}  // namespace mote::vision
