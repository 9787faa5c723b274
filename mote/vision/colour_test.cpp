#include "mote/vision/colour.hpp"

#include <cmath>

namespace mote::vision {
namespace {

/// A window whose middle 20 x 40 pixels have one colour and whose rim has another.
cv::Mat window(const cv::Scalar& middle, const cv::Scalar& rim) {
  cv::Mat out(80, 60, CV_8UC3, rim);
  out(cv::Rect(20, 20, 20, 40)) = middle;
  return out;
}

TEST(Colour, ChancesTellTheTargetFromItsSurroundings) {
  ColourModel model;
  model.learn(window({200, 30, 30}, {30, 200, 30}), 20, 40, 1);
  const cv::Mat chances = model.chances(window({200, 30, 30}, {30, 200, 30}));
  EXPECT_GT(chances.at<float>(40, 30), 0.99F);
  EXPECT_LT(chances.at<float>(5, 5), 0.01F);
}

TEST(Colour, LikenessIsOneForTheSameAndNoneForOthers) {
  ColourModel model;
  model.learn(window({200, 30, 30}, {30, 200, 30}), 20, 40, 1);
  EXPECT_NEAR(model.likeness(window({200, 30, 30}, {30, 30, 30}), 20, 40), 1, 1e-6);
  EXPECT_NEAR(model.likeness(window({30, 30, 200}, {30, 200, 30}), 20, 40), 0, 1e-6);
  cv::Mat half = window({200, 30, 30}, {30, 200, 30});
  half(cv::Rect(20, 20, 20, 20)) = cv::Scalar(30, 30, 200);
  EXPECT_NEAR(model.likeness(half, 20, 40), std::sqrt(0.5), 1e-6);
}

}  // namespace
}  // namespace mote::vision
