#pragma once
/// Training a detector: a linear support-vector machine on gradient histograms of patches.

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace mote::vision {

/// Patches with and without a target, and the machine that tells them apart.
///
/// source  Dalal & Triggs 2005, sec. 4 (hard negatives)
class Training {
 public:
  /// Adds the 64 x 64 patches of a picture, row by row; patches of one grey level (the unused end) are left out.
  ///
  /// error   Refusal (kBadData) when it is no picture or its sides are no multiples of 64
  void add_mosaic(const std::string& path, bool target);
  /// Adds what a detector takes for targets in a scene without any, at most 20; returns how many. The scene may have
  /// any size and 1, 3 or 4 channels of 8 bits: it is scanned at every scale down from its own, and a small one down
  /// from one where its shorter side is two patches long, enlarged 8 times at most.
  std::size_t add_hard_negatives(const cv::Mat& scene, const std::vector<float>& weights);
  /// Weights of the features, then the offset: what Detector takes.
  ///
  /// error   Refusal (kBadData) when there are only targets or none
  std::vector<float> train() const;

  std::size_t positives() const { return positives_; }
  std::size_t negatives() const { return labels_.size() - positives_; }

 private:
  void add(const cv::Mat& patch, bool target);

  cv::Mat features_;  // a row a patch
  std::vector<int> labels_;
  std::size_t positives_ = 0;
};

}  // namespace mote::vision
