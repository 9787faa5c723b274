#include "mote/vision/patch.hpp"

#include "mote/vision/place.hpp"
#include "mote/vision/synthetic.hpp"

namespace mote::vision {
namespace {

/// A window whose value at a place of the frame is a x + b y + c: bilinear sampling is exact there.
Window slope_window(double a, double b, double c) {
  Window window{cv::Mat(128, 128, CV_32F), 10, 20, 1.5, 2};
  for (int row = 0; row < 128; ++row)
    for (int column = 0; column < 128; ++column) {
      const double x = (column + 0.5) / window.sx + window.x0;
      const double y = (row + 0.5) / window.sy + window.y0;
      window.image.at<float>(row, column) = static_cast<float>(a * x + b * y + c);
    }
  return window;
}

TEST(Patch, SamplesPlacesOfTheFrame) {
  const Window window = slope_window(2, -3, 5);
  Pose pose = testing::pose_at(50, 50, 0.1, 0.3);
  pose[kSkew] = 0.2;
  const Affine map = affine_of(pose, {20, 14});
  std::vector<float> z(kPixels);
  sample_patch(window, map, z);
  for (std::size_t row : {0U, 7U, 31U})
    for (std::size_t column : {0U, 18U, 31U}) {
      const double u = (static_cast<double>(column) + 0.5) / kSide - 0.5;
      const double v = (static_cast<double>(row) + 0.5) / kSide - 0.5;
      const double x = map.x + u * map.xu + v * map.xv;
      const double y = map.y + u * map.yu + v * map.yv;
      EXPECT_NEAR(static_cast<double>(z[row * kSide + column]), 2 * x - 3 * y + 5, 1e-3);
    }
}

TEST(Patch, GoesOnBeyondTheWindow) {
  const Window window = slope_window(1, 0, 0);
  std::vector<float> z(kPixels);
  sample_patch(window, affine_of(testing::pose_at(1e6, -1e6), {20, 14}), z);
  EXPECT_NEAR(static_cast<double>(z[0]), (127.5) / 1.5 + 10, 1e-3);
}

TEST(Patch, NormalisingTakesLightOut) {
  std::vector<float> dark(kPixels);
  cv::RNG random(3);
  for (float& value : dark) value = random.uniform(0.0F, 100.0F);
  std::vector<float> bright = dark;
  for (float& value : bright) value = 2.5F * value + 30;
  normalise_patch(dark);
  normalise_patch(bright);
  for (std::size_t j = 0; j < kPixels; ++j) EXPECT_NEAR(dark[j], bright[j], 1e-4F);
}

TEST(Patch, AFlatPatchStaysFinite) {
  std::vector<float> flat(kPixels, 77.0F);
  normalise_patch(flat);
  for (const float value : flat) EXPECT_EQ(value, 0);
}

TEST(Pyramid, WindowsKeepPlacesAtEveryResolution) {
  cv::Mat slope(200, 200, CV_32F);
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 200; ++column) slope.at<float>(row, column) = static_cast<float>(column + 0.5);
  const Pyramid pyramid(slope);
  for (const double w : {20.0, 40.0, 70.0, 150.0}) {
    const Window window = pyramid.cut(100.3, 100.7, w, w, {16, 16});
    for (const int k : {4, 8, 12})
      EXPECT_NEAR(static_cast<double>(window.image.at<float>(8, k)), window.x0 + (k + 0.5) / window.sx, 0.1) << w;
  }
}

}  // namespace
}  // namespace mote::vision
