#pragma once
/// The tracker: a filter of the library on the visual model, frame by frame, and what it learns from each frame.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mote/engine/plan.hpp"
#include "mote/filter/filter.hpp"
#include "mote/vision/confidence.hpp"
#include "mote/vision/model.hpp"

namespace mote::vision {

/// Which components of the state move.
enum class States {
  kLocation,  ///< the centre
  kVelocity,  ///< and its velocity
  kScale,     ///< and one scale
  kAffine,    ///< centre, two scales, rotation, skew
};

/// How the centre moves from frame to frame, before the noise.
enum class MotionKind {
  kWalk,      ///< it stays
  kSecond,    ///< it keeps its velocity, which walks at random
  kAdaptive,  ///< it goes where the place filter responds most (the adaptive velocity of Zhou et al.)
};

struct LearningRates {
  double place = 0.015, extent = 0.01;  ///< of the filters, a frame
};

struct TrackerOptions {
  Plan plan{};
  States states = States::kAffine;
  MotionKind motion = MotionKind::kAdaptive;
  bool adapt = true;  ///< particles: half when sure, twice after a doubt
  Motion noise{};
  Likelihood likelihood{};
  AppearanceOptions appearance{};
  PlaceOptions place{};
  ExtentOptions extent{};
  LearningRates rates{};
  ConfidenceOptions confidence{};
};

/// What a frame told. A lost target keeps its last pose.
struct Track {
  Pose pose{};
  Box box{};
  double score = 1;  ///< in [0, 1]; 0 when lost
  bool lost = false;
  std::size_t particles = 0;
  StepReport report{};
  std::vector<cv::Point2f> cloud{};  ///< centres of the particles, unweighted
};

/// Follows one target.
///
///   Tracker tracker(options, first_frame, box);   for each frame after it: Track now = tracker.step(frame);
///
/// error   Refusal (kWrongUse) when the plan's filter cannot run the model
class Tracker {
 public:
  Tracker(const TrackerOptions& options, const cv::Mat& frame, const Box& box);

  /// Tracks into the next frame. `candidates` are places to look at first when the target is lost (detections).
  Track step(const cv::Mat& frame, std::span<const Box> candidates = {});
  bool lost() const { return confidence_->lost(); }
  /// Frames since the target was lost.
  int gone() const { return confidence_->gone(); }
  /// What a particle has cost so far, stage by stage.
  const StageTimes& times() const { return *model_.times; }

 private:
  void cut(const View& view, const Pose& around);
  void look(const View& view, const Pose& around);
  void restart(std::vector<Pose> start, std::size_t particles);
  bool search(const View& view, std::span<const Box> candidates);
  /// A place that shows the lost target again.
  struct Find {
    Pose pose;
    double score;
    bool near;  // where the target may have got to
  };
  double distance_to(double x, double y) const;
  std::vector<Peak> peaks(const View& view, std::span<const Box> candidates);
  std::optional<Find> examined(const View& view, const Peak& peak);
  std::optional<Find> found(const View& view, std::span<const Box> candidates);
  void follow(const View& view, Track& track);
  void learn(const View& view, const Pose& pose, double weight);
  bool adapt(Sighting sighting);
  std::size_t after_doubt() const { return (options_.adapt ? 2 : 1) * options_.plan.particles; }
  Pose estimate() const;
  std::vector<float> patch_at(const Pose& pose) const;

  TrackerOptions options_;
  Size first_;
  std::shared_ptr<Sight> sight_ = std::make_shared<Sight>();
  VisualModel model_;
  PlaceFilter place_;
  ExtentFilter extent_;
  std::optional<Appearance> appearance_;
  std::optional<Confidence> confidence_;
  std::unique_ptr<Filter> filter_;
  std::size_t particles_ = 0;
  int sure_ = 0;      // frames on end
  int searched_ = 0;  // windows, since the start
  Pose pose_;
  Step t_ = 0;
};

}  // namespace mote::vision
