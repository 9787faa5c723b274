#include "mote/vision/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/scan.hpp"
#include "mote/software/reference.hpp"

namespace mote::vision {
namespace {

/// The noise with the components that do not move held still.
Motion noise_of(const TrackerOptions& options) {
  Motion noise = options.noise;
  if (options.states != States::kAffine) noise.aspect = noise.angle = noise.skew = 0;
  if (options.states < States::kScale) noise.size = 0;
  const bool moves =
      options.motion == MotionKind::kSecond || options.states == States::kVelocity || options.states == States::kScale;
  if (!moves) noise.speed = 0;
  return noise;
}

/// n poses of the weighted particles, systematically from the middle of each n-th of the weight.
std::vector<Pose> survivors(const WeightedSet& set, std::size_t n) {
  const WeightScan scan(set.weights);
  WeightScan::Walk walk(scan);
  std::vector<Pose> poses(n);
  set.visit([&](const auto& particles) {
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = walk.find((static_cast<double>(k) + 0.5) * scan.total() / static_cast<double>(n));
      for (std::size_t d = 0; d < kComponents; ++d) poses[k][d] = static_cast<double>(particles.component(d)[i]);
    }
  });
  return poses;
}

std::vector<cv::Point2f> centres_of(const WeightedSet& set) {
  std::vector<cv::Point2f> centres;
  for (const Pose& pose : survivors(set, std::min<std::size_t>(set.size(), 200)))
    centres.emplace_back(static_cast<float>(pose[kX]), static_cast<float>(pose[kY]));
  return centres;
}

}  // namespace

Tracker::Tracker(const TrackerOptions& options, const cv::Mat& frame, const Box& box)
    : options_(options),
      first_{box.w, box.h},
      model_{sight_, std::make_shared<Crew>(options.plan.threads), std::make_shared<StageTimes>()},
      place_(box, options.place),
      extent_(box, options.extent),
      pose_(pose_of(box, first_)) {
  const View view = view_of(frame);
  sight_->first = first_;
  sight_->motion = noise_of(options);
  sight_->likelihood = options.likelihood;
  sight_->width = frame.cols;
  sight_->height = frame.rows;
  place_.learn(view, box, 1);
  extent_.learn(view, box, 1);
  look(view, pose_);
  appearance_.emplace(patch_at(pose_), options.appearance);
  sight_->appearance = &*appearance_;
  confidence_.emplace(options.confidence, peak_of(sight_->place).value);
  restart({pose_}, options.plan.particles);
}

void Tracker::look(const View& view, const Pose& around) {
  constexpr int kReach = 4;  // sides of the target that particles may see
  constexpr int kPixelsSeen = kReach * static_cast<int>(kSide);
  const Box box = box_of(around, first_);
  sight_->window =
      view.grey.cut(box.centre_x(), box.centre_y(), kReach * box.w, kReach * box.h, {kPixelsSeen, kPixelsSeen});
  sight_->place = place_.respond(view, box);
  sight_->extent = extent_.respond(view, box);
  sight_->log_size = 0.5 * (around[kLogW] + around[kLogH]);
}

std::vector<float> Tracker::patch_at(const Pose& pose) const {
  std::vector<float> patch(kPixels);
  sample_patch(sight_->window, affine_of(pose, first_), patch);
  normalise_patch(patch);
  return patch;
}

Pose Tracker::estimate() const {
  Pose pose{};
  for (std::size_t d = 0; d < kComponents; ++d) pose[d] = filter_->moments(d, false).mean;
  return pose;
}

void Tracker::restart(std::vector<Pose> start, std::size_t particles) {
  sight_->start = std::move(start);
  Plan plan = options_.plan;
  plan.particles = particles;
  if (plan.chain.draws != 0) plan.chain.draws = std::max(plan.chain.draws, particles);
  plan.seed = mixed(plan.seed + static_cast<std::uint64_t>(t_));  // a filter that starts anew draws anew
  filter_ = make_reference_filter(model_, plan, "mote track");
  particles_ = particles;
}

/// The best response of the place filter: around where the target was lost, at the candidates, and in windows all over
/// the frame, in turns where there are many.
Peak Tracker::best_place(const View& view, std::span<const Box> candidates) {
  constexpr int kMostWindows = 48;  // a frame: some 50 ms
  const Box box = box_of(pose_, first_);
  Peak best{0, 0, -kInfinity};
  const auto at = [&](double x, double y) {
    const Peak peak = peak_of(place_.respond(view, {x - box.w / 2, y - box.h / 2, box.w, box.h}));
    if (peak.value > best.value) best = peak;
  };
  at(pose_[kX], pose_[kY]);
  for (const Box& candidate : candidates) at(candidate.centre_x(), candidate.centre_y());
  // windows overlap by half: their rims are faded out
  const auto windows = [](double frame, double window) {
    return std::max(1, static_cast<int>(2 * frame / window) + 1);
  };
  const int nx = windows(sight_->width, place_.reach_x() * box.w);
  const int ny = windows(sight_->height, place_.reach_y() * box.h);
  for (int k = 0; k < std::min(nx * ny, kMostWindows); ++k, ++searched_) {
    const int window = searched_ % (nx * ny);
    const int row = window / nx;
    at((window % nx + 0.5) * sight_->width / nx, (row + 0.5) * sight_->height / ny);
  }
  return best;
}

bool Tracker::search(const View& view, std::span<const Box> candidates) {
  const Peak best = best_place(view, candidates);
  Pose pose = pose_;
  pose[kX] = best.x;
  pose[kY] = best.y;
  look(view, pose);
  const double distance = std::hypot(best.x - pose_[kX], best.y - pose_[kY]) / std::sqrt(box_of(pose_, first_).area());
  if (!confidence_->is_found(best.value, appearance_->mean_log_density(patch_at(pose)), distance)) return false;
  pose_ = pose;
  restart({pose}, after_doubt());
  return true;
}

Track Tracker::step(const cv::Mat& frame, std::span<const Box> candidates) {
  const View view = view_of(frame);
  ++t_;
  Track track;
  track.pose = pose_;
  if (confidence_->lost()) confidence_->note_search(search(view, candidates));
  if (!confidence_->lost()) follow(view, track);
  track.lost = confidence_->lost();
  if (track.lost) track.score = 0;
  track.particles = particles_;
  track.box = box_of(track.pose, first_);
  pose_ = track.pose;
  return track;
}

void Tracker::follow(const View& view, Track& track) {
  Pose around = pose_;
  around[kX] += pose_[kVx];
  around[kY] += pose_[kVy];
  look(view, around);
  const Peak peak = peak_of(sight_->place);
  const bool adaptive = options_.motion == MotionKind::kAdaptive;
  sight_->drift_x = adaptive ? peak.x - around[kX] : 0;
  sight_->drift_y = adaptive ? peak.y - around[kY] : 0;
  const std::vector<Row<double>> rows{Row<double>::of({static_cast<double>(t_)})};
  StageTimes& times = *model_.times;
  {
    const Stopwatch watch(times.propose);
    const double weighed = times.weigh;
    track.report = filter_->update(t_, rows);
    times.propose -= times.weigh - weighed;
  }
  const Pose estimated = estimate();
  track.cloud = centres_of(filter_->weighted());
  const double density =
      track.report.collapsed || !is_sane(estimated) ? -kInfinity : appearance_->mean_log_density(patch_at(estimated));
  const double response = sight_->place.at(estimated[kX], estimated[kY]);
  track.score = confidence_->score(response, density);
  const Sighting sighting = confidence_->note(response, density);
  if (sighting == Sighting::kHidden) return restart({pose_}, after_doubt());  // the pose stays
  track.pose = estimated;
  if (sighting == Sighting::kSure) learn(view, estimated, confidence_->weight(track.score));
  if (adapt(sighting)) return;
  const Stopwatch watch(times.select);
  filter_->select(t_, track.report);
}

/// Few particles when sure, as many as asked for else; true if a new filter took over.
bool Tracker::adapt(Sighting sighting) {
  constexpr int kLongSure = 10;  // frames
  sure_ = sighting == Sighting::kSure ? sure_ + 1 : 0;
  if (!options_.adapt) return false;
  const std::size_t least = std::max(options_.plan.groups.groups, options_.plan.chain.chains);
  const std::size_t wanted =
      sure_ >= kLongSure ? std::max(options_.plan.particles / 2, least) : options_.plan.particles;
  if (wanted == particles_) return false;
  restart(survivors(filter_->weighted(), wanted), wanted);
  return true;
}

void Tracker::learn(const View& view, const Pose& pose, double weight) {
  const Box box = box_of(pose, first_);
  place_.learn(view, box, weight * options_.rates.place);
  extent_.learn(view, box, weight * options_.rates.extent);
  appearance_->learn(patch_at(pose), weight);
}

}  // namespace mote::vision
