#include "mote/vision/model.hpp"

#include "mote/vision/synthetic.hpp"
#include "mote/vision/tracker.hpp"

namespace mote::vision {
namespace {

using testing::pose_at;
using testing::Stage;

/// What a frame with the target at `pose` says, after the target was learnt from the same frame.
struct Scene {
  Stage stage;
  View view;
  PlaceFilter place;
  ExtentFilter extent;
  std::optional<Appearance> appearance;
  Sight sight;

  explicit Scene(const Pose& pose)
      : view(view_of(stage.frame(pose))), place(box_of(pose, stage.first), {}), extent(box_of(pose, stage.first), {}) {
    const Box box = box_of(pose, stage.first);
    place.learn(view, box, 1);
    extent.learn(view, box, 1);
    sight.first = stage.first;
    sight.window = view.grey.cut(box.centre_x(), box.centre_y(), 4 * box.w, 4 * box.h, {128, 128});
    std::vector<float> patch(kPixels);
    sample_patch(sight.window, affine_of(pose, stage.first), patch);
    normalise_patch(patch);
    appearance.emplace(patch, AppearanceOptions{});
    sight.appearance = &*appearance;
    sight.place = place.respond(view, box);
    sight.extent = extent.respond(view, box);
    sight.width = sight.height = 1000;
    sight.start = {pose};
  }
};

class Fits : public ::testing::TestWithParam<Fit> {};

TEST_P(Fits, TheTruePoseBeatsOnesBesideIt) {
  const Pose truth = pose_at(150, 110);
  Scene scene(truth);
  scene.sight.likelihood = likelihood_of(GetParam());
  const double best = log_fit(scene.sight, truth);
  for (const auto& [component, by] : std::vector<std::pair<Component, double>>{{kX, 3},
                                                                               {kX, -3},
                                                                               {kY, 3},
                                                                               {kY, -3},
                                                                               {kLogW, 0.1},
                                                                               {kLogW, -0.1},
                                                                               {kLogH, 0.1},
                                                                               {kLogH, -0.1},
                                                                               {kAngle, 0.15},
                                                                               {kAngle, -0.15},
                                                                               {kSkew, 0.2}}) {
    double last = best;
    for (const int times : {1, 2}) {  // and the further, the worse
      Pose beside = truth;
      beside[component] += times * by;
      const double fit = log_fit(scene.sight, beside);
      EXPECT_LT(fit, last) << component << " by " << times * by;
      last = fit;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Fits, ::testing::Values(Fit::kFused, Fit::kMixture, Fit::kDistance));

TEST(VisualModel, NoPoseFitsOutsideTheFrame) {
  Scene scene(pose_at(150, 110));
  EXPECT_EQ(log_fit(scene.sight, pose_at(-1, 110)), -kInfinity);
  EXPECT_EQ(log_fit(scene.sight, pose_at(150, 1001)), -kInfinity);
  EXPECT_EQ(log_fit(scene.sight, pose_at(kNaN, 110)), -kInfinity);
}

TEST(VisualModel, MovesByDriftVelocityAndNoise) {
  Scene scene(pose_at(150, 110));
  scene.sight.motion = {
      .place = 0.1, .speed = 0.05, .damping = 0.5, .size = 0.02, .aspect = 0.01, .angle = 0.1, .skew = 0.2};
  scene.sight.drift_x = 3;
  Pose before = pose_at(150, 110);
  before[kVx] = 2;
  const double side = std::sqrt(48.0 * 40);
  const Pose after = moved(scene.sight, before, {1, -1, 1, 0, 1, 2, 1, -1});
  EXPECT_NEAR(after[kX], 150 + 2 + 3 + 0.1 * side, 1e-12);
  EXPECT_NEAR(after[kY], 110 - 0.1 * side, 1e-12);
  EXPECT_NEAR(after[kVx], 1 + 0.05 * side, 1e-12);
  EXPECT_NEAR(after[kLogW], 0.02 + 0.02, 1e-12);
  EXPECT_NEAR(after[kLogH], 0.02 - 0.02, 1e-12);
  EXPECT_NEAR(after[kAngle], 0.1, 1e-12);
  EXPECT_NEAR(after[kSkew], -0.2, 1e-12);
}

TEST(VisualModel, ThreadsDoNotChangeTheWeights) {
  Scene scene(pose_at(150, 110));
  const auto sight = std::make_shared<Sight>(scene.sight);
  const std::vector<Row<double>> rows{Row<double>::of({1.0})};
  std::vector<std::vector<double>> weights;
  for (const std::size_t threads : {1U, 2U, 3U}) {
    const VisualModel model{sight, std::make_shared<Crew>(threads), std::make_shared<StageTimes>()};
    Particles<double> x(kComponents, 333);
    for (std::size_t i = 0; i < x.size(); ++i) x.write(i, pose_at(140 + 0.06 * static_cast<double>(i), 110));
    weights.emplace_back(x.size(), 0.0);
    model.weigh_all<double>(1, rows, x, 0, weights.back());
  }
  EXPECT_EQ(weights[0], weights[1]);
  EXPECT_EQ(weights[0], weights[2]);
  EXPECT_EQ(weights[0][7], log_fit(*sight, pose_at(140 + 0.06 * 7, 110)));
}

}  // namespace
}  // namespace mote::vision
