#pragma once
/// The stages of a step, apart from who runs them: propose, weigh, and let the chains take what is weighed.

#include <cstdint>
#include <functional>
#include <vector>

#include "mote/filter/chain.hpp"

namespace mote {

/// Pieces of memory, in an order of their own.
using Memory = std::vector<std::span<std::byte>>;

/// What a step does to its particles, as stages over stretches of them.
///
/// A stretch is proposed, then weighed, then taken; those of one line are taken in its order. Otherwise they may be
/// worked on in any order, side by side, however they are cut: none of it changes a bit.
struct Stages {
  Stretch all;                              ///< the particles
  std::vector<std::vector<Stretch>> lines;  ///< the same, in the order in which each taker wants them
  /// Proposers have numbers; one of them proposes one stretch at a time.
  std::function<void(std::size_t proposer, std::size_t line, Stretch stretch)> propose;
  std::function<void(Stretch stretch)> weigh;  ///< empty: nothing is weighed
  std::function<void(Stretch stretch)> take;   ///< empty: nobody takes
  /// What is known of a stretch, and what a line's takers have come to: to be handed on where workers share no memory.
  std::function<Memory(Stretch stretch)> memory = {};
  std::function<Memory(std::size_t line)> outcome = {};
};

/// Runs stages.
class StageRunner {
 public:
  virtual ~StageRunner() = default;
  /// Returns when all is done.
  ///
  /// error   what a stage throws
  virtual void run(const Stages& stages) = 0;
  /// Proposers that it may have.
  virtual std::size_t proposers() const = 0;
  /// Lines that it can have taken side by side.
  virtual std::size_t lines() const = 0;
  /// A number that follows from what all stages have found, wherever that lies: the same for all who run the stages.
  virtual std::uint64_t agreed(const std::function<std::uint64_t()>& find) { return find(); }

 protected:
  StageRunner() = default;
  StageRunner(const StageRunner&) = default;
  StageRunner(StageRunner&&) = default;
  StageRunner& operator=(const StageRunner&) = default;
  StageRunner& operator=(StageRunner&&) = default;
};

/// Runs each stage over everything before the next: slow and obvious.
class StageByStage final : public StageRunner {
 public:
  void run(const Stages& stages) override {
    stages.propose(0, 0, stages.all);
    if (stages.weigh) stages.weigh(stages.all);
    if (!stages.take) return;
    for (const auto& line : stages.lines)
      for (const Stretch& stretch : line) stages.take(stretch);
  }
  std::size_t proposers() const override { return 1; }
  std::size_t lines() const override { return 1; }
};

/// The one that filters use if they are told of no other.
inline StageRunner& stage_by_stage() {
  static StageByStage runner;
  return runner;
}

/// Adds a stretch of a column to the pieces.
template <class T>
void add_column(Memory& memory, std::span<T> column, Stretch stretch) {
  memory.push_back(std::as_writable_bytes(column.subspan(stretch.first, stretch.size())));
}
/// Adds a stretch of particles.
template <class R>
void add_columns(Memory& memory, Particles<R>& x, Stretch stretch) {
  for (std::size_t d = 0; d < x.dimensions(); ++d) add_column(memory, x.component(d), stretch);
}

/// Which chains of a layout are in each of at most `lines` lines.
inline Cut chains_by_line(const ChainLayout& layout, std::size_t lines) {
  return {layout.chains, std::min(lines, layout.chains)};
}

/// The proposals of a layout in `lines` lines of whole chains, each burnt in first.
inline std::vector<std::vector<Stretch>> lines_of(const ChainLayout& layout, std::size_t lines) {
  std::vector<std::vector<Stretch>> all(std::min(lines, layout.chains));
  const Cut chains = chains_by_line(layout, lines);
  const Cut drawn(layout.draws, layout.chains);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::size_t first = chains.begin(k);
    const std::size_t last = chains.begin(k + 1);
    if (layout.burn_in > 0)
      all[k].push_back({layout.draws + first * layout.burn_in, layout.draws + last * layout.burn_in});
    all[k].push_back({drawn.begin(first), drawn.begin(last)});
  }
  return all;
}

}  // namespace mote
