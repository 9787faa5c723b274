#include "mote/vision/sheet.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace mote::vision {
namespace {

cv::Mat plain(int level) { return {cv::Size(40, 30), CV_8UC3, cv::Scalar::all(level)}; }

cv::Mat decoded(const std::string& bytes) {
  return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
}

TEST(Sheet, LaysItsFramesOutInRowsOfThree) {
  Sheet sheet({20, 1, 4, 8});
  EXPECT_TRUE(sheet.wants(8));
  EXPECT_FALSE(sheet.wants(2));
  for (const int number : {1, 4, 8, 20}) sheet.add(static_cast<std::size_t>(number), plain(10 * number));
  const cv::Mat picture = decoded(sheet.picture(".png"));
  ASSERT_EQ(picture.size(), cv::Size(3 * 40 + 8, 2 * 30 + 4));
  EXPECT_EQ(picture.at<cv::Vec3b>(15, 20)[0], 10);
  EXPECT_EQ(picture.at<cv::Vec3b>(15, 64)[0], 40);
  EXPECT_EQ(picture.at<cv::Vec3b>(15, 108)[0], 80);
  EXPECT_EQ(picture.at<cv::Vec3b>(49, 20)[0], 200);
  EXPECT_EQ(picture.at<cv::Vec3b>(49, 64)[0], 255);
}

TEST(Sheet, LeavesOutWhatNeverCame) {
  Sheet sheet({1, 2, 300});
  EXPECT_EQ(sheet.picture(".jpg"), "");
  sheet.add(2, plain(50));
  EXPECT_EQ(decoded(sheet.picture(".jpg")).size(), cv::Size(40, 30));
}

}  // namespace
}  // namespace mote::vision
