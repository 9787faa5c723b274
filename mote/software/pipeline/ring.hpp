#pragma once
/// What the workers of a pipeline hand to each other without locks: a bounded queue, and seats.

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace mote {

/// A bounded queue for any number of threads at both ends: first in, first out.
///
/// shape   holds `capacity` numbers or a few more
/// cost    one compare-and-swap a call
/// source  Vyukov 2010, "Bounded MPMC queue"
class Ring {
 public:
  explicit Ring(std::size_t capacity)
      : mask_(std::bit_ceil(capacity) - 1), cells_(std::make_unique<Cell[]>(mask_ + 1)) {
    for (std::size_t k = 0; k <= mask_; ++k) cells_[k].turn.store(k, std::memory_order_relaxed);
  }

  /// False if it is full.
  bool push(std::uint32_t value) {
    std::size_t at = tail_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[at & mask_];
      const std::size_t turn = cell.turn.load(std::memory_order_acquire);
      if (turn == at) {
        if (!tail_.compare_exchange_weak(at, at + 1, std::memory_order_relaxed)) continue;
        cell.value = value;
        cell.turn.store(at + 1, std::memory_order_release);
        return true;
      }
      if (turn < at) return false;
      at = tail_.load(std::memory_order_relaxed);
    }
  }
  /// Nothing if it is empty.
  std::optional<std::uint32_t> pop() {
    std::size_t at = head_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[at & mask_];
      const std::size_t turn = cell.turn.load(std::memory_order_acquire);
      if (turn == at + 1) {
        if (!head_.compare_exchange_weak(at, at + 1, std::memory_order_relaxed)) continue;
        const std::uint32_t value = cell.value;
        cell.turn.store(at + mask_ + 1, std::memory_order_release);
        return value;
      }
      if (turn < at + 1) return std::nullopt;
      at = head_.load(std::memory_order_relaxed);
    }
  }
  /// Numbers in it, about.
  std::size_t size() const {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    return tail > head ? tail - head : 0;
  }

 private:
  struct Cell {
    std::atomic<std::size_t> turn{0};
    std::uint32_t value = 0;
  };
  std::size_t mask_;
  std::unique_ptr<Cell[]> cells_;
  alignas(128) std::atomic<std::size_t> tail_{0};
  alignas(128) std::atomic<std::size_t> head_{0};
};

/// Up to 64 seats, each for one at a time.
class Seats {
 public:
  static constexpr std::size_t kMost = 64;

  explicit Seats(std::size_t count) : free_(count == kMost ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1) {}

  /// The lowest seat that is free, if one is.
  std::optional<std::size_t> take() {
    std::uint64_t free = free_.load(std::memory_order_relaxed);
    while (free != 0)
      if (free_.compare_exchange_weak(free, free & (free - 1), std::memory_order_acquire, std::memory_order_relaxed))
        return static_cast<std::size_t>(std::countr_zero(free));
    return std::nullopt;
  }
  /// A certain seat, if it is free.
  bool take(std::size_t seat) {
    const std::uint64_t bit = std::uint64_t{1} << seat;
    return (free_.fetch_and(~bit, std::memory_order_acquire) & bit) != 0;
  }
  void leave(std::size_t seat) { free_.fetch_or(std::uint64_t{1} << seat, std::memory_order_release); }

 private:
  std::atomic<std::uint64_t> free_;
};

}  // namespace mote
