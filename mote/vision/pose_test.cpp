#include "mote/vision/pose.hpp"

#include "mote/base/numbers.hpp"

namespace mote::vision {
namespace {

TEST(Pose, OverlapOfBoxes) {
  EXPECT_DOUBLE_EQ(overlap({0, 0, 10, 10}, {0, 0, 10, 10}), 1);
  EXPECT_DOUBLE_EQ(overlap({0, 0, 10, 10}, {5, 0, 10, 10}), 50.0 / 150);
  EXPECT_EQ(overlap({0, 0, 10, 10}, {10, 0, 10, 10}), 0);
  EXPECT_EQ(overlap({0, 0, 10, 10}, {kNaN, 0, 10, 10}), 0);
}

TEST(Pose, BoxThereAndBack) {
  const Size first{30, 20};
  const Box box{7, 9, 60, 10};
  const Box back = box_of(pose_of(box, first), first);
  EXPECT_NEAR(back.x, box.x, 1e-12);
  EXPECT_NEAR(back.y, box.y, 1e-12);
  EXPECT_NEAR(back.w, box.w, 1e-12);
  EXPECT_NEAR(back.h, box.h, 1e-12);
}

TEST(Pose, AffineTurnsClockwiseOnTheScreen) {
  Pose pose{};
  pose[kAngle] = kPi / 2;
  const Affine map = affine_of(pose, {30, 20});
  EXPECT_NEAR(map.xu, 0, 1e-12);
  EXPECT_NEAR(map.yu, 30, 1e-12);
  EXPECT_NEAR(map.xv, -20, 1e-12);
  EXPECT_NEAR(map.yv, 0, 1e-12);
}

TEST(Pose, SkewMovesTheLowerEdgeSideways) {
  Pose pose{};
  pose[kSkew] = 0.1;
  const Affine map = affine_of(pose, {30, 20});
  EXPECT_NEAR(map.xv, 2, 1e-12);
  EXPECT_NEAR(map.yv, 20, 1e-12);
}

TEST(Pose, NumbersThatAreNoPose) {
  Pose pose{};
  EXPECT_TRUE(is_sane(pose));
  pose[kVx] = kNaN;
  EXPECT_FALSE(is_sane(pose));
  pose[kVx] = 0;
  pose[kLogW] = 7;
  EXPECT_FALSE(is_sane(pose));
}

}  // namespace
}  // namespace mote::vision
