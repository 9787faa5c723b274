#pragma once
/// Made video with exact truth, for the tests: a textured target on a textured scene.

#include <cmath>
#include <optional>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "mote/vision/pose.hpp"

namespace mote::vision::testing {

/// Smooth noise with structures of about `grain` pixels, CV_8UC3.
inline cv::Mat texture(cv::Size size, double grain, unsigned seed) {
  cv::RNG random(seed);
  cv::Mat coarse(std::max(2, static_cast<int>(size.height / grain)), std::max(2, static_cast<int>(size.width / grain)),
                 CV_8UC3);
  random.fill(coarse, cv::RNG::UNIFORM, 20, 236);
  cv::Mat fine;
  cv::resize(coarse, fine, size, 0, 0, cv::INTER_CUBIC);
  return fine;
}

/// A scene and a target that can be put into it at any pose.
struct Stage {
  cv::Mat scene = texture({320, 240}, 12, 11);
  cv::Mat target = texture({96, 96}, 14, 23);
  Size first{48, 40};

  /// The frame with the target at a pose; `gain` and `offset` change the light on everything.
  cv::Mat frame(const Pose& pose, double gain = 1, double offset = 0) const {
    const Affine map = affine_of(pose, first);
    // template pixel (i + 1/2)/96 - 1/2 goes to the place of affine_of, pixel centres at whole numbers
    const double step = 1.0 / target.cols;
    const double x0 = map.x + (0.5 * step - 0.5) * (map.xu + map.xv) - 0.5;
    const double y0 = map.y + (0.5 * step - 0.5) * (map.yu + map.yv) - 0.5;
    const cv::Matx23d to(map.xu * step, map.xv * step, x0, map.yu * step, map.yv * step, y0);
    cv::Mat out = scene.clone();
    cv::warpAffine(target, out, to, out.size(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
    cv::Mat lit;
    out.convertTo(lit, CV_8U, gain, offset);
    return lit;
  }
};

inline Pose pose_at(double x, double y, double log_size = 0, double angle = 0) {
  Pose pose{};
  pose[kX] = x;
  pose[kY] = y;
  pose[kLogW] = pose[kLogH] = log_size;
  pose[kAngle] = angle;
  return pose;
}

}  // namespace mote::vision::testing
