#include "mote/vision/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

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

/// The pixels that particles may see.
void Tracker::cut(const View& view, const Pose& around) {
  constexpr int kReach = 4;  // sides of the target that particles may see
  constexpr int kPixelsSeen = kReach * static_cast<int>(kSide);
  const Box box = box_of(around, first_);
  sight_->window =
      view.grey.cut(box.centre_x(), box.centre_y(), kReach * box.w, kReach * box.h, {kPixelsSeen, kPixelsSeen});
}

void Tracker::look(const View& view, const Pose& around) {
  const Box box = box_of(around, first_);
  cut(view, around);
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

/// From where the target was lost, in geometric means of its sides.
double Tracker::distance_to(double x, double y) const {
  return std::hypot(x - pose_[kX], y - pose_[kY]) / std::sqrt(box_of(pose_, first_).area());
}

/// The highest responses of the place filter: around where the target was lost, at the candidates, and in windows all
/// over the frame, in turns where there are many; only as far as the target may be by now.
std::vector<Peak> Tracker::peaks(const View& view, std::span<const Box> candidates) {
  constexpr int kMostWindows = 48;  // a frame: some 50 ms
  constexpr double kWindow = 1.5;   // sides from a window's centre to what it shows
  const Box box = box_of(pose_, first_);
  std::vector<Peak> all;
  const auto at = [&](double x, double y) {
    if (std::isinf(confidence_->needed(distance_to(x, y) - kWindow))) return;
    all.push_back(peak_of(place_.respond(view, {x - box.w / 2, y - box.h / 2, box.w, box.h})));
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
  return all;
}

/// A second look at a peak, from its own place: whether it is the target.
std::optional<Tracker::Find> Tracker::examined(const View& view, const Peak& peak) {
  constexpr double kFaded = 0.7;  // of the response, as far as a peak may lie from its window's centre
  constexpr double kSameColours = 0.7;
  if (peak.value < kFaded * confidence_->needed(distance_to(peak.x, peak.y))) return std::nullopt;
  Pose pose = pose_;
  pose[kX] = peak.x;
  pose[kY] = peak.y;
  const Peak centred = peak_of(place_.respond(view, box_of(pose, first_)));
  pose[kX] = centred.x;
  pose[kY] = centred.y;
  cut(view, pose);
  const double density = appearance_->mean_log_density(patch_at(pose));
  const double distance = distance_to(centred.x, centred.y);
  if (!confidence_->is_found(centred.value, density, distance)) return std::nullopt;
  const bool near = confidence_->is_near(distance);
  if (!near && place_.likeness(view, box_of(pose, first_)) < kSameColours) return std::nullopt;
  return Find{pose, confidence_->score(centred.value, density), near};
}

/// The best find, near ones first. Far away there may be others who look like the target: of two nearly as good none.
std::optional<Tracker::Find> Tracker::found(const View& view, std::span<const Box> candidates) {
  constexpr double kRival = 0.85;
  const double apart = 0.5 * std::sqrt(box_of(pose_, first_).area());
  std::vector<Find> finds;
  for (const Peak& peak : peaks(view, candidates))
    if (const auto find = examined(view, peak)) finds.push_back(*find);
  const auto worse = [](const Find& a, const Find& b) { return std::tie(a.near, a.score) < std::tie(b.near, b.score); };
  const auto best = std::max_element(finds.begin(), finds.end(), worse);
  if (best == finds.end() || best->near) return best == finds.end() ? std::nullopt : std::optional(*best);
  const bool rivalled = std::any_of(finds.begin(), finds.end(), [&](const Find& other) {
    return other.score > kRival * best->score &&
           std::hypot(other.pose[kX] - best->pose[kX], other.pose[kY] - best->pose[kY]) > apart;
  });
  return rivalled ? std::nullopt : std::optional(*best);
}

bool Tracker::search(const View& view, std::span<const Box> candidates) {
  const auto find = found(view, candidates);
  if (!find) return false;
  pose_ = find->pose;
  restart({pose_}, after_doubt());
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
