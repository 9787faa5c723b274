#pragma once
/// Draws for a stretch of particles that begins inside a block.

#include <optional>

#include "mote/base/draws.hpp"
#include "mote/filter/still.hpp"
#include "mote/model/model.hpp"

namespace mote {

/// Where the draws of particles are, from one on: for who takes those of many at once.
struct DrawPlace {
  Draws draws;
  Purpose purpose;
  std::size_t first;  ///< the particle whose draws come next
};

/// A place in the draws of one purpose and step: those of a particle, then of the next, across blocks.
///
/// A block's generators serve its particles in order, so a stretch that begins inside a block passes over the words of
/// those before. A cursor that goes on from where it is passes over what lies between alone.
///
/// cost    a new block: its keying; a particle passed over: its words, about 1 ns each
template <class R>
class DrawCursor {
 public:
  /// Goes to particle i, where each particle takes `words` numbers.
  void go(const Draws& draws, Purpose purpose, std::size_t i, std::size_t words) {
    const std::size_t at = i % kBlock;
    if (!block_ || draws.seed != draws_.seed || draws.step != draws_.step || draws.stream != draws_.stream ||
        purpose != purpose_ || i / kBlock != number_ || at < at_) {
      draws_ = draws;
      purpose_ = purpose;
      enter(i / kBlock);
    }
    for (; at_ < at; ++at_) {
      auto draw = block_->particle(at_);
      for (std::size_t k = 0; k < words; ++k) draw.uniform();
    }
  }
  /// The draws of the particle here; the cursor moves on to the next.
  Draw<R> next() {
    if (at_ == kBlock) enter(number_ + 1);
    return block_->particle(at_++);
  }
  /// Leaves the draws from here on to the caller; the cursor has none until it goes somewhere.
  DrawPlace hand_over() {
    block_.reset();
    return {draws_, purpose_, number_ * kBlock + at_};
  }

 private:
  void enter(std::size_t number) {
    number_ = number;
    at_ = 0;
    block_.emplace(draws_.block<R>(purpose_, number));
  }

  Draws draws_;
  Purpose purpose_ = Purpose::kTest;
  std::size_t number_ = 0, at_ = 0;
  std::optional<BlockDraws<R>> block_;
};

/// Numbers that a proposal draws for a particle: by the laws of models, the same whatever its state.
template <class R, Model M, class G>
std::size_t words_of(const M& model, const G& proposal, Step t, const StateOf<M, R>& before, Rows<R> y) {
  StillDraw<R> draw;
  proposal.template propose<R>(model, t, before, y, draw);
  return draw.taken();
}

}  // namespace mote
