#pragma once
/// A window: a rectangle of the frame, resampled to a fixed size.

#include <vector>

#include <opencv2/core.hpp>

#include "mote/vision/pose.hpp"

namespace mote::vision {

/// A resampled part of a frame and the map between the two.
///
///   window coordinate = (frame coordinate - origin) * scale
struct Window {
  cv::Mat image;
  double x0 = 0, y0 = 0;  ///< frame coordinates of the window's corner, px
  double sx = 1, sy = 1;  ///< window pixels per frame pixel

  double to_x(double x) const { return (x - x0) * sx; }
  double to_y(double y) const { return (y - y0) * sy; }
};

/// An image at full, half, quarter ... resolution, so that a window that shrinks it shows no aliases.
class Pyramid {
 public:
  /// image: any depth and channels, kept as it is; levels are made when a window first asks for them.
  explicit Pyramid(cv::Mat image) : levels_{std::move(image)} {}

  int width() const { return levels_.front().cols; }
  int height() const { return levels_.front().rows; }
  /// Cuts w x h frame pixels around (x, y) and resamples them to `size`, to fractions of a pixel; where the frame ends,
  /// its last pixels go on.
  ///
  /// cost    O(pixels of the window), and of the halvings when they are made
  Window cut(double x, double y, double w, double h, cv::Size size) const;

 private:
  const cv::Mat& level(std::size_t k) const;
  mutable std::vector<cv::Mat> levels_;
};

}  // namespace mote::vision
