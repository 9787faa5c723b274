#include "mote/vision/tracker.hpp"

#include "mote/vision/synthetic.hpp"

namespace mote::vision {
namespace {

using testing::pose_at;
using testing::Stage;

TrackerOptions options_with(FilterKind filter, std::uint64_t seed = 1) {
  TrackerOptions options;
  options.plan.filter = filter;
  options.plan.particles = 300;
  options.plan.seed = seed;
  options.plan.on_collapse = OnCollapse::kKeep;
  if (filter == FilterKind::kDistributed)
    options.plan.groups = {.groups = 4, .exchange = Exchange::kSwap, .exchange_count = 4};
  return options;
}

/// The pose in frame k of a test's video.
using Path = Pose (*)(int);

Pose across(int k) { return pose_at(80 + 2.0 * k, 90 + 12 * std::sin(0.2 * k)); }
Pose growing(int k) { return pose_at(150 + 0.5 * k, 110, 0.008 * k); }
Pose turning(int k) { return pose_at(150 + 0.5 * k, 110, 0, 0.006 * k); }

/// Mean overlap over `frames` frames.
double mean_overlap(const TrackerOptions& options, Path path, int frames, double gain_step = 0) {
  const Stage stage;
  Tracker tracker(options, stage.frame(path(0)), box_of(path(0), stage.first));
  double sum = 0;
  for (int k = 1; k <= frames; ++k) {
    const Track track = tracker.step(stage.frame(path(k), 1 - gain_step * k));
    EXPECT_FALSE(track.lost) << k;
    sum += overlap(track.box, box_of(path(k), stage.first));
  }
  return sum / frames;
}

class Filters : public ::testing::TestWithParam<FilterKind> {};

TEST_P(Filters, FollowAMovingTarget) { EXPECT_GT(mean_overlap(options_with(GetParam()), across, 50), 0.85); }

INSTANTIATE_TEST_SUITE_P(All, Filters,
                         ::testing::Values(FilterKind::kSisr, FilterKind::kImh, FilterKind::kAuxiliary,
                                           FilterKind::kDistributed));

TEST(Tracker, FollowsAGrowingTarget) { EXPECT_GT(mean_overlap(options_with(FilterKind::kSisr), growing, 50), 0.8); }

TEST(Tracker, AStateWithoutScaleDoesNotGrow) {
  TrackerOptions options = options_with(FilterKind::kSisr);
  options.states = States::kLocation;
  EXPECT_LT(mean_overlap(options, growing, 50), 0.75);
}

TEST(Tracker, FollowsAFadingLight) {
  EXPECT_GT(mean_overlap(options_with(FilterKind::kSisr), across, 50, 0.012), 0.85);
}

TEST(Tracker, TurnsWithTheTarget) {
  const Stage stage;
  Tracker tracker(options_with(FilterKind::kSisr), stage.frame(turning(0)), box_of(turning(0), stage.first));
  Track track;
  for (int k = 1; k <= 30; ++k) track = tracker.step(stage.frame(turning(k)));
  EXPECT_NEAR(track.pose[kAngle], 0.18, 0.06);
}

/// A frame whose right part is covered by a wall, up to `x`.
cv::Mat walled(cv::Mat frame, int x) {
  static const cv::Mat wall = testing::texture({320, 240}, 5, 99);
  if (x > 0) wall(cv::Rect(x, 0, 320 - x, 240)).copyTo(frame(cv::Rect(x, 0, 320 - x, 240)));
  return frame;
}

TEST(Tracker, ReportsLossBehindAWallAndRecovery) {
  const Stage stage;
  const auto path = [](int k) { return pose_at(120 + 2.0 * (k < 25 ? k : k < 45 ? 25 : 70 - k), 110); };
  Tracker tracker(options_with(FilterKind::kSisr), stage.frame(path(0)), box_of(path(0), stage.first));
  int lost = 0;
  int lost_early = 0;
  Track track;
  for (int k = 1; k <= 60; ++k) {
    // the wall comes down over the still target at frame 26 and goes up at frame 44
    track = tracker.step(walled(stage.frame(path(k)), k > 25 && k < 45 ? 100 : 0));
    lost_early += k <= 25 && track.lost;
    lost += track.lost;
  }
  EXPECT_EQ(lost_early, 0);
  EXPECT_GE(lost, 10);
  EXPECT_LE(lost, 20);
  EXPECT_FALSE(track.lost);
  EXPECT_GT(overlap(track.box, box_of(path(60), stage.first)), 0.7);
}

TEST(Tracker, ATargetThatLeavesIsLostAndNothingBreaks) {
  const Stage stage;
  Tracker tracker(options_with(FilterKind::kSisr), stage.frame(across(0)), box_of(across(0), stage.first));
  Track track;
  for (int k = 1; k <= 170; ++k) track = tracker.step(stage.frame(across(k)));
  EXPECT_TRUE(track.lost);
  EXPECT_TRUE(is_sane(track.pose));
}

/// A frame with a target at each of the places.
cv::Mat with_targets(const Stage& stage, const std::vector<cv::Point>& centres) {
  cv::Mat frame = stage.scene.clone();
  for (const cv::Point& c : centres) {
    const cv::Rect place(c.x - 24, c.y - 20, 48, 40);
    stage.frame(pose_at(c.x, c.y))(place).copyTo(frame(place));
  }
  return frame;
}

TEST(Tracker, FarAwayOneThatLooksTheSameIsTakenOfTwoNone) {
  const Stage stage;
  const cv::Point start(45, 45);
  const cv::Point far(275, 195);
  const cv::Point twin(275, 60);
  for (const bool two : {false, true}) {
    Tracker tracker(options_with(FilterKind::kSisr), with_targets(stage, {start}), {21, 25, 48, 40});
    for (int k = 0; k < 10; ++k) tracker.step(with_targets(stage, {start}));
    for (int k = 0; k < 32; ++k) tracker.step(with_targets(stage, {}));
    EXPECT_TRUE(tracker.lost());
    Track track;
    for (int k = 0; k < 5; ++k)
      track = tracker.step(with_targets(stage, two ? std::vector{far, twin} : std::vector{far}));
    EXPECT_EQ(track.lost, two);
    EXPECT_EQ(overlap(track.box, Box{251, 175, 48, 40}) > 0.7, !two);
  }
}

TEST(Tracker, OneSeedIsOneTrackOnAnyNumberOfThreads) {
  const Stage stage;
  std::vector<Box> last;
  for (const std::size_t threads : {1U, 2U}) {
    TrackerOptions options = options_with(FilterKind::kSisr, 5);
    options.plan.threads = threads;
    Tracker tracker(options, stage.frame(across(0)), box_of(across(0), stage.first));
    Track track;
    for (int k = 1; k <= 15; ++k) track = tracker.step(stage.frame(across(k)));
    last.push_back(track.box);
  }
  EXPECT_EQ(last[0].x, last[1].x);
  EXPECT_EQ(last[0].w, last[1].w);
}

TEST(Tracker, FewParticlesWhenSureManyAfterADoubt) {
  const Stage stage;
  Tracker tracker(options_with(FilterKind::kSisr), stage.frame(across(0)), box_of(across(0), stage.first));
  std::size_t sure = 0;
  for (int k = 1; k <= 20; ++k) sure = tracker.step(stage.frame(across(k))).particles;
  EXPECT_EQ(sure, 150U);
  EXPECT_EQ(tracker.step(walled(stage.frame(across(21)), 1)).particles, 600U);
}

TEST(Tracker, GreyAndAlphaFrames) {
  const Stage stage;
  for (const int code : {cv::COLOR_BGR2GRAY, cv::COLOR_BGR2BGRA}) {
    const auto frame = [&](int k) {
      cv::Mat out;
      cv::cvtColor(stage.frame(across(k)), out, code);
      return out;
    };
    Tracker tracker(options_with(FilterKind::kSisr), frame(0), box_of(across(0), stage.first));
    Track track;
    for (int k = 1; k <= 10; ++k) track = tracker.step(frame(k));
    EXPECT_GT(overlap(track.box, box_of(across(10), stage.first)), 0.8);
  }
}

}  // namespace
}  // namespace mote::vision
