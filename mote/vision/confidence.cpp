#include "mote/vision/confidence.hpp"

#include <algorithm>
#include <cmath>

#include "mote/base/numbers.hpp"

namespace mote::vision {

double Confidence::score(double response, double log_density) const {
  return 0.5 * std::clamp(response / usual_, 0.0, 1.0) + 0.5 * std::min(1.0, std::exp(log_density + 0.5));
}

double Confidence::weight(double score) const {
  const double share = std::clamp((score - options_.hidden) / (options_.full - options_.hidden), 0.0, 1.0);
  return share * share;
}

Sighting Confidence::note(double response, double log_density) {
  const double now = score(response, log_density);
  ++since_sure_;
  if (!(now >= options_.hidden)) {
    ++hidden_;
    return Sighting::kHidden;
  }
  hidden_ = 0;
  if (now < options_.learn) return Sighting::kUnsure;
  since_sure_ = 0;
  ++sure_;
  const double rate = std::max(options_.usual_rate, 0.5 / (1.0 + sure_));
  usual_ += weight(now) * rate * (response - usual_);
  return Sighting::kSure;
}

void Confidence::note_search(bool found) {
  gone_ = found ? 0 : gone_ + 1;
  ++since_sure_;
  if (!found) return;
  hidden_ = 0;
  since_sure_ = std::min(since_sure_, options_.doubt - 1);
}

bool Confidence::is_near(double distance) const {
  constexpr double kSpeed = 0.1;  // sides a frame
  return distance < 1 + kSpeed * gone_;
}

double Confidence::needed(double distance) const {
  constexpr int kAnywhere = 25;  // frames after which the target may be anywhere
  constexpr double kLeniency = 0.002;
  if (is_near(distance)) return options_.near * usual_;
  if (gone_ < kAnywhere) return kInfinity;
  return (options_.far - kLeniency * std::min(gone_, 75)) * usual_;
}

bool Confidence::is_found(double response, double log_density, double distance) const {
  const double close = since_sure_ < options_.doubt ? options_.hidden : options_.learn;
  return response >= needed(distance) &&
         score(response, log_density) >= (is_near(distance) ? close : options_.far_score);
}

}  // namespace mote::vision
