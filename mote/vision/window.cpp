#include "mote/vision/window.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace mote::vision {

const cv::Mat& Pyramid::level(std::size_t k) const {
  while (levels_.size() <= k) {
    cv::Mat half;
    cv::pyrDown(levels_.back(), half);
    levels_.push_back(half);
  }
  return levels_[k];
}

Window Pyramid::cut(double x, double y, double w, double h, cv::Size size) const {
  constexpr double kMostLevels = 5;
  const double shrinks = std::max(std::min(w / size.width, h / size.height), 1.0);
  const auto k = static_cast<std::size_t>(std::min(std::floor(std::log2(shrinks)), kMostLevels));
  Window window{{}, x - w / 2, y - h / 2, size.width / w, size.height / h};
  // pixel i of the window lies at (i + 1/2)/scale + origin; pixel j of level k at 2^k j + 1/2
  const double part = 1.0 / static_cast<double>(std::size_t{1} << k);
  const cv::Matx23d map(part / window.sx, 0, part * (window.x0 + 0.5 / window.sx - 0.5),  //
                        0, part / window.sy, part * (window.y0 + 0.5 / window.sy - 0.5));
  cv::warpAffine(level(k), window.image, map, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return window;
}

}  // namespace mote::vision
