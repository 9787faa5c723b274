#include "mote/vision/gradients.hpp"

#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

/// Brightness that rises along a direction.
cv::Mat ramp(double angle) {
  cv::Mat image(32, 40, CV_32F);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<float>(y, x) = static_cast<float>(3 * (x * std::cos(angle) + y * std::sin(angle)));
  return image;
}

/// The channel in [first, last) that is largest in a cell.
std::size_t largest(const Planes& planes, std::size_t first, std::size_t last, int row, int column) {
  std::size_t best = first;
  for (std::size_t k = first; k < last; ++k)
    if (planes[k].at<float>(row, column) > planes[best].at<float>(row, column)) best = k;
  return best;
}

TEST(Gradients, ACellForEveryFourPixelsAndAllChannels) {
  const Planes planes = gradient_histograms(ramp(0));
  ASSERT_EQ(planes.size(), kGradientChannels);
  EXPECT_EQ(planes.front().size(), cv::Size(10, 8));
}

TEST(Gradients, EveryDirectionHasItsChannel) {
  for (std::size_t k = 0; k < 18; ++k) {
    const Planes planes = gradient_histograms(ramp(kPi * static_cast<double>(k) / 9));
    for (const int column : {0, 4, 9}) {
      EXPECT_EQ(largest(planes, 0, 18, 3, column), k);
      EXPECT_EQ(largest(planes, 18, 27, 3, column), 18 + k % 9);
    }
  }
}

TEST(Gradients, ContrastLeavesNoTraceAndAFlatImageHasNone) {
  const Planes planes = gradient_histograms(ramp(0.5));
  const Planes twice = gradient_histograms(2 * ramp(0.5) + 30);
  const Planes flat = gradient_histograms(cv::Mat(32, 40, CV_32F, cv::Scalar(80)));
  for (std::size_t k = 0; k < kGradientChannels; ++k) {
    EXPECT_NEAR(planes[k].at<float>(4, 5), twice[k].at<float>(4, 5), 1e-4) << k;
    EXPECT_EQ(flat[k].at<float>(4, 5), 0) << k;
  }
}

}  // namespace
}  // namespace mote::vision
