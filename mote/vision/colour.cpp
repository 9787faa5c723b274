#include "mote/vision/colour.hpp"

#include <cmath>

namespace mote::vision {
namespace {

std::size_t bin_of(const cv::Vec3b& pixel) {
  return static_cast<std::size_t>((pixel[0] >> 4U) << 8U | (pixel[1] >> 4U) << 4U | (pixel[2] >> 4U));
}

template <std::size_t N>
void mix(std::array<float, N>& into, const std::array<float, N>& counts, float sum, float rate) {
  for (std::size_t k = 0; k < N; ++k) into[k] = (1 - rate) * into[k] + rate * counts[k] / std::max(sum, 1.0F);
}

}  // namespace

void ColourModel::learn(const cv::Mat& window, double w, double h, double rate) {
  std::array<float, kBins> inside{};
  std::array<float, kBins> outside{};
  float sum_inside = 0;
  float sum_outside = 0;
  for (int y = 0; y < window.rows; ++y)
    for (int x = 0; x < window.cols; ++x) {
      const double u = std::abs(x + 0.5 - window.cols / 2.0) / (w / 2);
      const double v = std::abs(y + 0.5 - window.rows / 2.0) / (h / 2);
      const std::size_t bin = bin_of(window.at<cv::Vec3b>(y, x));
      // the rim of the box is neither
      if (u < 0.8 && v < 0.8) ++inside[bin], ++sum_inside;
      if (u > 1.1 || v > 1.1) ++outside[bin], ++sum_outside;
    }
  const auto a = static_cast<float>(empty_ ? 1 : rate);
  mix(target_, inside, sum_inside, a);
  mix(around_, outside, sum_outside, a);
  empty_ = false;
}

double ColourModel::likeness(const cv::Mat& window, double w, double h) const {
  std::array<float, kBins> inside{};
  float sum = 0;
  for (int y = 0; y < window.rows; ++y)
    for (int x = 0; x < window.cols; ++x) {
      const double u = std::abs(x + 0.5 - window.cols / 2.0) / (w / 2);
      const double v = std::abs(y + 0.5 - window.rows / 2.0) / (h / 2);
      if (u < 0.8 && v < 0.8) ++inside[bin_of(window.at<cv::Vec3b>(y, x))], ++sum;
    }
  double likeness = 0;
  for (std::size_t k = 0; k < kBins; ++k) likeness += std::sqrt(inside[k] / std::max(sum, 1.0F) * target_[k]);
  return likeness;
}

cv::Mat ColourModel::chances(const cv::Mat& window) const {
  cv::Mat out(window.size(), CV_32F);
  constexpr float kUnseen = 1e-4F;  // a colour that was never seen is as likely the one as the other
  for (int y = 0; y < window.rows; ++y)
    for (int x = 0; x < window.cols; ++x) {
      const std::size_t bin = bin_of(window.at<cv::Vec3b>(y, x));
      out.at<float>(y, x) = (target_[bin] + kUnseen) / (target_[bin] + around_[bin] + 2 * kUnseen);
    }
  return out;
}

}  // namespace mote::vision
