#include "mote/vision/correlation.hpp"

#include "mote/vision/extent.hpp"
#include "mote/vision/place.hpp"
#include "mote/vision/synthetic.hpp"

namespace mote::vision {
namespace {

using testing::pose_at;

TEST(CorrelationFilter, RespondsToWhatItLearntAsWanted) {
  cv::RNG random(1);
  Planes planes;
  for (int k = 0; k < 3; ++k) {
    cv::Mat plane(20, 24, CV_32F);
    random.fill(plane, cv::RNG::NORMAL, 0, 1);
    planes.push_back(plane);
  }
  const cv::Mat wanted = gaussian_bump({24, 20}, 2, 2);
  CorrelationFilter filter(wanted, 1e-6);
  filter.learn(planes, 1);
  EXPECT_LT(cv::norm(filter.respond(planes, 1), wanted, cv::NORM_INF), 1e-3);
}

TEST(CorrelationFilter, FollowsAShift) {
  cv::RNG random(1);
  cv::Mat plane(20, 24, CV_32F);
  random.fill(plane, cv::RNG::NORMAL, 0, 1);
  CorrelationFilter filter(gaussian_bump({24, 20}, 2, 2), 1e-6);
  filter.learn({plane}, 1);
  cv::Mat shifted(plane.size(), CV_32F);
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 24; ++column)
      shifted.at<float>(row, column) = plane.at<float>((row + 20 - 3) % 20, (column + 24 - 5) % 24);
  cv::Point peak;
  cv::minMaxLoc(filter.respond({shifted}, 2), nullptr, nullptr, nullptr, &peak);
  EXPECT_EQ(peak, cv::Point(2 * (12 + 5), 2 * (10 + 3)));
}

TEST(PlaceFilter, FindsTheTargetToAPixel) {
  const testing::Stage stage;
  const Pose start = pose_at(150, 110);
  PlaceFilter filter(box_of(start, stage.first), {});
  filter.learn(view_of(stage.frame(start)), box_of(start, stage.first), 1);
  for (const double dx : {-14.0, -3.3, 0.0, 7.6, 15.0}) {
    const ResponseMap map =
        filter.respond(view_of(stage.frame(pose_at(150 + dx, 110 - dx / 2))), box_of(start, stage.first));
    const Peak peak = peak_of(map);
    EXPECT_NEAR(peak.x, 150 + dx, 1) << dx;
    EXPECT_NEAR(peak.y, 110 - dx / 2, 1) << dx;
    EXPECT_NEAR(map.at(peak.x, peak.y), peak.value, 1e-6);
  }
}

TEST(ExtentFilter, FindsTheSize) {
  const testing::Stage stage;
  const Pose start = pose_at(150, 110);
  const Box box = box_of(start, stage.first);
  ExtentFilter filter(box, {});
  filter.learn(view_of(stage.frame(start)), box, 1);
  for (const double log_size : {-0.1, 0.0, 0.1}) {
    const ExtentResponse response = filter.respond(view_of(stage.frame(pose_at(150, 110, log_size))), box);
    double best = -1;
    for (double at = -0.2; at <= 0.2; at += 0.005)
      if (best < -0.5 || response.at(at) > response.at(best)) best = at;
    EXPECT_NEAR(best, log_size, 0.03);
  }
}

TEST(GradientHistograms, KnowDirectionFromOrientation) {
  cv::Mat rising(32, 32, CV_32F);
  for (int row = 0; row < 32; ++row)
    for (int column = 0; column < 32; ++column) rising.at<float>(row, column) = static_cast<float>(column);
  const Planes up = gradient_histograms(rising);
  const Planes down = gradient_histograms(-rising);
  EXPECT_GT(up[0].at<float>(4, 4), 0.3F);  // along x
  EXPECT_EQ(up[9].at<float>(4, 4), 0.0F);  // against x
  EXPECT_EQ(down[0].at<float>(4, 4), 0.0F);
  EXPECT_FLOAT_EQ(down[9].at<float>(4, 4), up[0].at<float>(4, 4));
  EXPECT_FLOAT_EQ(down[18].at<float>(4, 4), up[18].at<float>(4, 4));  // the orientation is the same
}

}  // namespace
}  // namespace mote::vision
