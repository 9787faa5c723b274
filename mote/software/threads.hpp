#pragma once
/// Threads that share a step's blocks.

#include <cstddef>
#include <memory>

namespace mote {

/// K workers (oneTBB). Work is cut into at most K contiguous shares; what a share computes never depends on the cut.
class Crew {
 public:
  explicit Crew(std::size_t threads);
  ~Crew();
  Crew(Crew&&) noexcept;
  Crew& operator=(Crew&&) noexcept;
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  std::size_t threads() const { return threads_; }

  /// Shares that `blocks` blocks of work are cut into: fewer than K when a share would not pay for its start.
  std::size_t shares(std::size_t blocks) const;

  /// Calls work(share, first, last) for the shares of [0, blocks), side by side; returns when all are done.
  ///
  /// cost    one barrier; none for a single share, which runs in the caller; no allocation of its own
  template <class Work>
  void run(std::size_t blocks, const Work& work) {
    if (shares(blocks) == 1) return work(std::size_t{0}, std::size_t{0}, blocks);
    run_shares(blocks, &work, [](const void* what, std::size_t share, std::size_t first, std::size_t last) {
      (*static_cast<const Work*>(what))(share, first, last);
    });
  }

 private:
  struct Arena;
  void run_shares(std::size_t blocks, const void* work,
                  void (*call)(const void*, std::size_t, std::size_t, std::size_t));

  std::size_t threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace mote
