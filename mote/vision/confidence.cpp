#include "mote/vision/confidence.hpp"

#include <algorithm>
#include <cmath>

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
  if (!(now >= options_.hidden)) {
    ++hidden_;
    return Sighting::kHidden;
  }
  hidden_ = 0;
  if (now < options_.learn) return Sighting::kUnsure;
  ++sure_;
  const double rate = std::max(options_.usual_rate, 0.5 / (1.0 + sure_));
  usual_ += weight(now) * rate * (response - usual_);
  return Sighting::kSure;
}

void Confidence::note_search(bool found) {
  gone_ = found ? 0 : gone_ + 1;
  if (found) hidden_ = 0;
}

bool Confidence::is_found(double response, double log_density, double distance) const {
  constexpr double kSpread = 0.05;  // sides a frame that "near" grows by
  constexpr double kLeniency = 0.002;
  const bool near = distance < 1 + kSpread * gone_;
  const double needed = near ? options_.near : options_.far - kLeniency * std::min(gone_, 75);
  return response >= needed * usual_ && score(response, log_density) >= options_.hidden;
}

}  // namespace mote::vision
