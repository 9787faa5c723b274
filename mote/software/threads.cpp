#include "mote/software/threads.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include <immintrin.h>
#include <sched.h>

namespace mote {
namespace {

constexpr std::size_t kLeastShare = 16;   // blocks: 20 us of work or more, several times what waking a thread costs
constexpr std::size_t kLeastPiece = 4;    // blocks taken at a time: what the others may wait for in the end
constexpr std::size_t kWorthWaking = 32;  // blocks a thread: below, what a step after a pause gains is not sure
constexpr std::size_t kApart = 128;       // bytes: two lines, because processors fetch them in pairs
constexpr std::chrono::microseconds kAwake{100};

using Clock = std::chrono::steady_clock;

/// Waits until `word` is no longer `old`, awake at first, then asleep; what it is now. Whoever else wants the core gets
/// it.
std::uint32_t changed(const std::atomic<std::uint32_t>& word, std::uint32_t old) {
  const auto until = Clock::now() + kAwake;
  do {
    for (int k = 0; k < 32; ++k) {
      const std::uint32_t now = word.load(std::memory_order_acquire);
      if (now != old) return now;
      _mm_pause();
    }
    std::this_thread::yield();
  } while (Clock::now() < until);
  word.wait(old, std::memory_order_acquire);
  return word.load(std::memory_order_acquire);
}

struct Piece {
  std::size_t first = 0, last = 0;
  std::size_t size() const { return last - first; }
  bool empty() const { return first == last; }
};

/// The blocks of one share that nobody has taken yet. Its owner takes from the front, most of them at first: to begin
/// elsewhere than where one has left off costs a fraction of a block. Helpers take from the back.
class alignas(kApart) Pile {
 public:
  void lay(std::size_t first, std::size_t last, std::size_t least) {
    least_ = least;
    left_.store(packed({first, last}), std::memory_order_relaxed);
  }
  Piece front() {
    return take([this](const Piece& left) { return Piece{left.first, left.first + part(left, 3 * left.size() / 4)}; });
  }
  Piece back() {
    return take([this](const Piece& left) { return Piece{left.last - part(left, left.size() / 2), left.last}; });
  }

 private:
  static std::uint64_t packed(const Piece& p) { return std::uint64_t{p.first} << 32U | p.last; }
  std::size_t part(const Piece& left, std::size_t wanted) const {
    return std::min(left.size(), std::max(least_, wanted));
  }

  template <class Choose>
  Piece take(const Choose& choose) {
    std::uint64_t before = left_.load(std::memory_order_relaxed);
    for (;;) {
      const Piece left{before >> 32U, before & 0xFFFFFFFFU};
      const Piece chosen = choose(left);
      const Piece rest = chosen.first == left.first ? Piece{chosen.last, left.last} : Piece{left.first, chosen.first};
      if (chosen.empty() || left_.compare_exchange_weak(before, packed(rest), std::memory_order_relaxed)) return chosen;
    }
  }

  std::size_t least_ = 1;
  std::atomic<std::uint64_t> left_{0};
};

}  // namespace

std::size_t cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? static_cast<std::size_t>(CPU_COUNT(&set)) : 1;
}

class Crew::Workers {
 public:
  Workers(std::size_t threads, std::size_t piles) : piles_(piles), seats_(threads) {
    for (std::size_t k = 1; k < threads; ++k) {
      try {
        seats_[k].thread = std::jthread([this, k] { attend(k); });
      } catch (const std::exception&) {
        break;
      }
    }
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() {
    for (Seat& seat : seats_) {
      seat.word.store(kDismissed);
      seat.word.notify_one();
    }
  }

  void run(const Task& task) {
    if (pays(task))
      share_out(task);
    else
      task.call(task.work, 0, 0, task.pieces);
    rests_since_ = Clock::now();
  }

 private:
  /// A worker's word: what it is at in the lowest two bits, how often it has been called above. The count tells a
  /// worker that wakes late that it has missed a call, so that it is awake for the next.
  enum Word : std::uint32_t { kIdle, kCalled, kWorking, kDismissed, kStates, kAt = kStates - 1 };

  struct alignas(kApart) Seat {
    std::atomic<std::uint32_t> word{kIdle};
    std::exception_ptr failure;
    std::jthread thread;
  };

  std::size_t called(const Task& task) const { return std::min(task.shares, seats_.size()); }
  /// After a pause the workers sleep, and one that is woken may be queued behind its caller.
  bool pays(const Task& task) const {
    return task.pieces * task.blocks_each >= kWorthWaking * called(task) || Clock::now() - rests_since_ < kAwake;
  }

  void share_out(const Task& task) {
    task_ = task;
    for (std::size_t k = 0; k < task.shares; ++k)
      piles_[k].lay(task.pieces * k / task.shares, task.pieces * (k + 1) / task.shares,
                    std::max<std::size_t>(kLeastPiece / task.blocks_each, 1));
    for (std::size_t k = 1; k < called(task); ++k) call(seats_[k]);
    work(0);
    for (std::size_t k = 1; k < called(task); ++k) finish(seats_[k]);
    rethrow_failure();
  }

  static void call(Seat& seat) {
    seat.word.store(seat.word.load(std::memory_order_relaxed) + kStates + kCalled);
    seat.word.notify_one();
  }
  /// Takes back a call that has not been heard, or waits until its work is done.
  static void finish(Seat& seat) {
    std::uint32_t word = seat.word.load(std::memory_order_acquire);
    if ((word & kAt) == kCalled && seat.word.compare_exchange_strong(word, word - kCalled)) return;
    if ((word & kAt) == kWorking) changed(seat.word, word);
  }

  void rethrow_failure() {
    std::exception_ptr lowest;
    for (Seat& seat : seats_) {
      const std::exception_ptr failure = std::exchange(seat.failure, nullptr);
      if (!lowest) lowest = failure;
    }
    if (lowest) std::rethrow_exception(lowest);
  }

  void attend(std::size_t k) {
    Seat& seat = seats_[k];
    std::uint32_t word = kIdle;
    while ((word & kAt) != kDismissed) {
      word = changed(seat.word, word);
      while ((word & kAt) == kCalled)
        if (seat.word.compare_exchange_strong(word, word - kCalled + kWorking)) word = at_work(seat, k, word);
    }
  }
  std::uint32_t at_work(Seat& seat, std::size_t k, std::uint32_t word) {
    work(k);
    const std::uint32_t idle = word - kCalled;
    seat.word.store(idle);
    seat.word.notify_one();
    return idle;
  }

  /// The own pile, then those of others.
  void work(std::size_t desk) {
    try {
      for (Piece piece = piles_[desk].front(); !piece.empty(); piece = piles_[desk].front()) call_task(desk, piece);
      for (std::size_t k = 1; k < task_.shares; ++k) {
        Pile& other = piles_[(desk + k) % task_.shares];
        for (Piece piece = other.back(); !piece.empty(); piece = other.back()) call_task(desk, piece);
      }
    } catch (...) {
      seats_[desk].failure = std::current_exception();
    }
  }
  void call_task(std::size_t desk, const Piece& piece) const { task_.call(task_.work, desk, piece.first, piece.last); }

  Clock::time_point rests_since_ = Clock::now();
  Task task_;
  std::vector<Pile> piles_;
  std::vector<Seat> seats_;  // the first is the caller's
};

Crew::Crew(std::size_t threads, std::size_t cores) : threads_(std::max<std::size_t>(threads, 1)) {
  if (threads_ > 1) workers_ = std::make_unique<Workers>(std::min(threads_, cores), threads_);
}
Crew::~Crew() = default;
Crew::Crew(Crew&&) noexcept = default;
Crew& Crew::operator=(Crew&&) noexcept = default;

std::size_t Crew::shares(std::size_t blocks) const {
  return std::clamp<std::size_t>(blocks / kLeastShare, 1, threads_);
}

void Crew::run_shares(const Task& task) { workers_->run(task); }

}  // namespace mote
