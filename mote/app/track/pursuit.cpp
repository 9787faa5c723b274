#include "mote/app/track/pursuit.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "mote/base/refusal.hpp"

namespace mote {

using namespace vision;

namespace {

constexpr int kGiveUp = 75;  // frames without a target before another is taken
constexpr int kEvery = 5;    // frames from detection to detection

/// What a frame says before there is a target.
Track no_target() {
  Track none;
  none.lost = true;
  none.score = 0;
  none.box = {kNaN, kNaN, kNaN, kNaN};
  none.pose.fill(kNaN);
  return none;
}

}  // namespace

Pursuit::Pursuit(std::string where, TrackerOptions options, std::optional<Box> init, std::optional<Detector> detector)
    : where_(std::move(where)), options_(std::move(options)), init_(init), detector_(std::move(detector)) {
  record_.plan = options_.plan;
}

const Track& Pursuit::step(const cv::Mat& frame) {
  const auto start = std::chrono::steady_clock::now();
  record_.tracks.push_back(tracker_ ? next(frame) : begin(frame));
  record_.frame_seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  if (record_.tracks.back().report.collapsed && options_.plan.on_collapse == OnCollapse::kStop)
    throw Refusal(ExitCode::kCollapsed,
                  fmt::format("{}: frame {}: all particles have weight zero. Pass --on-collapse keep.", where_,
                              record_.tracks.size()));
  return record_.tracks.back();
}

TrackRecord Pursuit::finished() {
  if (tracker_) add_times();
  return std::move(record_);
}

void Pursuit::check_box(const cv::Mat& frame) const {
  const double w = std::min(init_->x + init_->w, static_cast<double>(frame.cols)) - std::max(init_->x, 0.0);
  const double h = std::min(init_->y + init_->h, static_cast<double>(frame.rows)) - std::max(init_->y, 0.0);
  if (w >= 0.5 * init_->w && h >= 0.5 * init_->h) return;
  throw Refusal(
      ExitCode::kWrongUse,
      {where_, "--init", fmt::format("a box at least half inside the frame of {} x {} pixels", frame.cols, frame.rows),
       fmt::format("{},{},{},{}", init_->x, init_->y, init_->w, init_->h),
       "Give the corner, counted from 0, and the sides."});
}

Track Pursuit::begin(const cv::Mat& frame) {
  if (record_.tracks.empty() && init_) {
    check_box(frame);
    return take(frame, *init_);
  }
  const auto chosen = choice_.note(detections(frame, record_.tracks.size()));
  return chosen ? take(frame, *chosen) : no_target();
}

/// What the detector finds; it looks now and then, and in every frame while a find is watched.
std::vector<Detection> Pursuit::detections(const cv::Mat& frame, std::size_t frames_without) const {
  if (!detector_ || (frames_without % kEvery != 0 && !choice_.watching())) return {};
  return detector_->detect(frame);
}

Track Pursuit::take(const cv::Mat& frame, const Box& box) {
  if (tracker_) add_times();
  first_ = {box.w, box.h};
  tracker_.emplace(options_, frame, box);
  if (++record_.targets > 1)
    record_.notes.push_back(fmt::format("From frame {} on another target is tracked.", record_.tracks.size() + 1));
  Track track;
  track.box = box;
  track.pose = pose_of(box, first_);
  track.particles = options_.plan.particles;
  return track;
}

Track Pursuit::next(const cv::Mat& frame) {
  if (!tracker_->lost()) return tracker_->step(frame);
  const std::vector<Detection> found = detections(frame, static_cast<std::size_t>(tracker_->gone()));
  std::vector<Box> candidates;
  for (const Detection& detection : found) candidates.push_back(detection.box);
  Track track = tracker_->step(frame, candidates);
  if (!track.lost) choice_ = {};
  if (!track.lost || tracker_->gone() <= kGiveUp) return track;
  const auto chosen = choice_.note(found);
  return chosen ? take(frame, *chosen) : track;
}

void Pursuit::add_times() {
  const StageTimes& times = tracker_->times();
  record_.times.propose += times.propose;
  record_.times.weigh += times.weigh;
  record_.times.select += times.select;
  record_.times.particles += times.particles;
}

}  // namespace mote
