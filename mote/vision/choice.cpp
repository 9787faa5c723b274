#include "mote/vision/choice.hpp"

#include <algorithm>
#include <cmath>

namespace mote::vision {

std::optional<Box> Choice::note(std::span<const Detection> found) {
  constexpr double kSame = 0.4;
  std::vector<Watched> now;
  for (const Detection& d : found) {
    const auto like = std::max_element(watched_.begin(), watched_.end(), [&](const Watched& a, const Watched& b) {
      return overlap(a.box, d.box) < overlap(b.box, d.box);
    });
    const bool seen = like != watched_.end() && overlap(like->box, d.box) >= kSame;
    now.push_back(seen ? Watched{d.box, like->scores + d.score, like->frames + 1} : Watched{d.box, d.score, 1});
  }
  watched_ = std::move(now);
  const auto merit = [](const Watched& w) {
    return w.frames < kPersistence ? 0 : w.scores / w.frames * std::sqrt(w.box.area());
  };
  const auto best = std::max_element(watched_.begin(), watched_.end(),
                                     [&](const Watched& a, const Watched& b) { return merit(a) < merit(b); });
  if (best == watched_.end() || merit(*best) <= 0) return std::nullopt;
  const Box chosen = best->box;
  watched_.clear();
  return chosen;
}

}  // namespace mote::vision
