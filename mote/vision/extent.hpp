#pragma once
/// How large: a correlation filter over a ladder of sizes.

#include <vector>

#include "mote/vision/place.hpp"

namespace mote::vision {

struct ExtentOptions {
  int steps = 17;       ///< sizes on the ladder, odd
  double ratio = 1.03;  ///< of neighbouring sizes
  double bump = 1.03;   ///< sd of the wanted response, steps
  double area = 1024;   ///< of a rung's image, its own pixels
  double regularisation = 1e-2;
};

/// Scores of sizes around a box.
struct ExtentResponse {
  std::vector<float> values;  ///< refined ladder
  double log_step = 1;        ///< logarithm of the ratio of neighbouring values
  double middle = 0;          ///< place of the box's own size

  /// Linear value at a size that is e^log_ratio times the box's; the ends go on.
  double at(double log_ratio) const;
};

/// Learns how the target looks against the same place at other sizes and says how large it is.
///
/// source  Danelljan et al. 2014, sec. 3.2
class ExtentFilter {
 public:
  ExtentFilter(const Box& first, const ExtentOptions& options);
  void learn(const View& view, const Box& box, double rate);
  ExtentResponse respond(const View& view, const Box& box) const;

 private:
  cv::Mat ladder(const View& view, const Box& box) const;

  ExtentOptions options_;
  cv::Size size_;
  cv::Mat wanted_, numerators_, denominator_;
};

}  // namespace mote::vision
