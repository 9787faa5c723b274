#pragma once
/// Threads that share a step's blocks, and stay ready between steps.

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

  /// Calls work(desk, first, last) for ranges that make up [0, blocks), side by side; returns when all are done. Calls
  /// with the same desk, below shares(blocks), come one after the other.
  ///
  /// error   what a call throws, after the others are done: of several the lowest desk's
  /// cost    one barrier; none for a single share, which runs in the caller; no allocation after the first call
  template <class Work>
  void run(std::size_t blocks, const Work& work) {
    if (shares(blocks) == 1) return work(std::size_t{0}, std::size_t{0}, blocks);
    run_shares(
        {blocks, shares(blocks), &work, [](const void* what, std::size_t desk, std::size_t first, std::size_t last) {
           (*static_cast<const Work*>(what))(desk, first, last);
         }});
  }

 private:
  struct Task {
    std::size_t blocks = 0, shares = 0;
    const void* work = nullptr;
    void (*call)(const void* work, std::size_t desk, std::size_t first, std::size_t last) = nullptr;
  };
  class Workers;
  void run_shares(const Task& task);

  std::size_t threads_;
  std::unique_ptr<Workers> workers_;
};

}  // namespace mote
