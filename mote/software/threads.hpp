#pragma once
/// Threads that share a step's blocks, and stay ready between steps.

#include <algorithm>
#include <cstddef>
#include <memory>

namespace mote {

/// Processors that the calling thread may run on.
std::size_t cores();

/// K threads, the caller among them, and no more of them than there are cores. Blocks of work are cut into shares, one
/// a thread; who is done takes over what others have not begun. What a block computes never depends on who does it.
///
/// cost    between steps a thread stays awake for 100 us, then it sleeps; a small step after a pause wakes nobody. A
///         thread that comes late, or never, delays nobody: the others have done its share by then. Only what it has
///         begun is waited for
/// source  docs/decisions/0005-threads.md
class Crew {
 public:
  /// error   none: where the system grants fewer threads, there are fewer
  explicit Crew(std::size_t threads, std::size_t cores = mote::cores());
  ~Crew();
  Crew(Crew&&) noexcept;
  Crew& operator=(Crew&&) noexcept;
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Shares that `blocks` blocks of work are cut into: fewer than K when a share would not pay for its start.
  std::size_t shares(std::size_t blocks) const;
  /// Shares that `pieces` pieces are cut into, each as much work as `blocks_each` blocks.
  std::size_t shares(std::size_t pieces, std::size_t blocks_each) const {
    return std::clamp<std::size_t>(shares(pieces * blocks_each), 1, std::max<std::size_t>(pieces, 1));
  }

  /// Calls work(desk, first, last) for ranges that make up [0, blocks), side by side; returns when all are done. Calls
  /// with the same desk, below shares(blocks), come one after the other.
  ///
  /// error   what a call throws, after the others are done: of several the lowest desk's
  /// cost    one barrier; none for a single share, which runs in the caller; no allocation after the first call
  template <class Work>
  void run(std::size_t blocks, const Work& work) {
    run(blocks, 1, work);
  }
  /// The same for pieces that are as much work as `blocks_each` blocks each.
  template <class Work>
  void run(std::size_t pieces, std::size_t blocks_each, const Work& work) {
    const std::size_t all = shares(pieces, blocks_each);
    if (all == 1) return work(std::size_t{0}, std::size_t{0}, pieces);
    run_shares(
        {pieces, blocks_each, all, &work, [](const void* what, std::size_t desk, std::size_t first, std::size_t last) {
           (*static_cast<const Work*>(what))(desk, first, last);
         }});
  }

 private:
  struct Task {
    std::size_t pieces = 0, blocks_each = 1, shares = 0;
    const void* work = nullptr;
    void (*call)(const void* work, std::size_t desk, std::size_t first, std::size_t last) = nullptr;
  };
  class Workers;
  void run_shares(const Task& task);

  std::size_t threads_;
  std::unique_ptr<Workers> workers_;
};

}  // namespace mote
