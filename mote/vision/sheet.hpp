#pragma once
/// A sheet: some frames of a video side by side in one picture.

#include <map>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace mote::vision {

/// Collects the frames of given numbers and lays them out in rows of three, in the order of their numbers.
class Sheet {
 public:
  /// numbers: from 1 on, any order; those that never come are left out.
  explicit Sheet(const std::vector<std::size_t>& numbers);

  bool wants(std::size_t number) const { return frames_.contains(number); }
  /// Keeps a frame that is wanted; all have one size and type.
  void add(std::size_t number, const cv::Mat& frame);
  /// The bytes of a picture; `ending` is .png or .jpg. Empty without a frame.
  std::string picture(const std::string& ending) const;

 private:
  std::map<std::size_t, cv::Mat> frames_;
};

}  // namespace mote::vision
