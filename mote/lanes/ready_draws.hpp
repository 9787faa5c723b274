#pragma once
/// Draws made ahead of the loop over particles, and which ones a model takes.

#include <algorithm>
#include <vector>

#include "mote/lanes/draws.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

/// Which draws a model takes for a particle, in order: the same for every particle of a step.
struct DrawPattern {
  std::vector<bool> normal;  ///< normal or uniform

  friend bool operator==(const DrawPattern&, const DrawPattern&) = default;
};

/// A draw that notes what is asked of it.
template <class V>
class PatternDraw {
 public:
  V normal() { return note(true); }
  V uniform() { return note(false); }
  const DrawPattern& pattern() const { return pattern_; }

 private:
  V note(bool normal) {
    pattern_.normal.push_back(normal);
    return V(0.5);
  }
  DrawPattern pattern_;
};

/// Draws made ahead: what a model receives in the loop over particles, in vectors of any width.
///
/// The numbers are made by a loop of their own: it holds the generators and the table, the model's loop its constants,
/// and neither runs out of registers. The model's loop has no rare branch then, behind which g++ would compute at every
/// turn what depends on the time alone.
template <class V>
class ReadyDraw {
 public:
  using Number = typename V::Number;
  /// `numbers` holds draw k of the particle at offset j of a block at numbers[k kBlock + j].
  MOTE_INLINE ReadyDraw(const Number* numbers, std::size_t j) : next_(numbers + j) {}

  MOTE_INLINE V normal() { return take(); }
  MOTE_INLINE V uniform() { return take(); }

 private:
  MOTE_INLINE V take() {
    const V number = V::load(next_);
    next_ += kBlock;
    return number;
  }
  const Number* next_;
};

/// Draws of one kind for the next `count` particles, `draws` for each.
template <class R, class OneDraw>
MOTE_INLINE void make_alike(std::size_t draws, std::size_t count, R* numbers, const OneDraw& one) {
  for (std::size_t j = 0; j < count; j += kWidth<R>)
    for (std::size_t k = 0; k < draws; ++k) one().store(numbers + k * kBlock + j);
}

/// Normal numbers for the next `count` particles, none of them far in the tail; false if one was, and then nothing has
/// been drawn: a loop without a rare branch is the faster one, and few blocks meet a tail.
template <class R>
[[gnu::flatten, gnu::noinline]] bool make_near_normals(VectorDraw<R>& source, std::size_t draws, std::size_t count,
                                                       R* numbers) {
  VectorDraw<R> draw = source;
  Vector<R> least(VectorDraw<R>::kTail);
  if (draws == 1)
    make_alike(1, count, numbers, [&] { return draw.near_normal(least); });
  else
    make_alike(draws, count, numbers, [&] { return draw.near_normal(least); });
  if ((least < Vector<R>(VectorDraw<R>::kTail)).any()) return false;
  source = draw;
  return true;
}

/// Makes the draws of the next `count` particles, as ReadyDraw reads them from offset 0 on.
template <class R>
[[gnu::flatten, gnu::noinline]] void make_ready(VectorDraw<R>& source, const DrawPattern& pattern, std::size_t count,
                                                R* numbers) {
  const std::size_t draws = pattern.normal.size();
  const bool all_normal = std::find(pattern.normal.begin(), pattern.normal.end(), false) == pattern.normal.end();
  if constexpr (VectorDraw<R>::kHasNear)
    if (all_normal && make_near_normals(source, draws, count, numbers)) return;
  VectorDraw<R> draw = source;
  if (all_normal) {
    make_alike(draws, count, numbers, [&] { return draw.normal(); });
  } else {
    for (std::size_t j = 0; j < count; j += kWidth<R>)
      for (std::size_t k = 0; k < draws; ++k)
        (pattern.normal[k] ? draw.normal() : draw.uniform()).store(numbers + k * kBlock + j);
  }
  source = draw;
}

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
