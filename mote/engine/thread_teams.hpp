#pragma once
/// Teams of threads, to try in one process what teams of processes do.

#include <algorithm>
#include <barrier>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "mote/engine/team.hpp"

namespace mote {

/// R ranks that are threads.
///
/// cost    two barriers an operation; for tests
class ThreadTeams {
 public:
  explicit ThreadTeams(std::size_t ranks)
      : boards_(ranks), boxes_(ranks * ranks), barrier_(static_cast<std::ptrdiff_t>(ranks)) {}

  /// Calls work(team) on every rank, side by side; returns when all are done.
  template <class Work>
  void run(const Work& work) {
    std::vector<std::jthread> threads;
    for (std::size_t r = 0; r < boards_.size(); ++r)
      threads.emplace_back([this, r, &work] {
        Member member(*this, r);
        work(member);
      });
  }

 private:
  /// What a rank shows to the others.
  struct Board {
    std::span<double> numbers;
    std::span<ExactSum> sums;
    std::uint32_t number = 0;
    std::span<const ParcelOut> parcels;
    std::span<const std::byte> column;
  };

  /// Messages from one rank to another.
  struct Box {
    std::mutex mutex;
    std::condition_variable filled;
    std::deque<std::vector<std::byte>> messages;
  };

  class Member final : public Team {
   public:
    Member(ThreadTeams& teams, std::size_t rank) : teams_(&teams), rank_(rank) {}
    std::size_t rank() const override { return rank_; }
    std::size_t ranks() const override { return teams_->boards_.size(); }

    void largest(std::span<double> numbers) override {
      mine().numbers = numbers;
      std::vector<double> all(numbers.begin(), numbers.end());
      after_all([&] {
        for (const Board& other : teams_->boards_)
          for (std::size_t k = 0; k < all.size(); ++k) all[k] = std::max(all[k], other.numbers[k]);
      });
      std::copy(all.begin(), all.end(), numbers.begin());
    }
    void add(std::span<ExactSum> sums) override {
      mine().sums = sums;
      std::vector<ExactSum> all(sums.size());
      after_all([&] {
        for (const Board& other : teams_->boards_)
          for (std::size_t k = 0; k < all.size(); ++k) all[k] += other.sums[k];
      });
      std::copy(all.begin(), all.end(), sums.begin());
    }
    ExactSum before(const ExactSum& sum) override {
      ExactSum copy = sum;
      mine().sums = {&copy, 1};
      ExactSum all;
      after_all([&] {
        for (std::size_t r = 0; r < rank_; ++r) all += teams_->boards_[r].sums[0];
      });
      return all;
    }
    std::vector<std::uint32_t> gather(std::uint32_t number) override {
      mine().number = number;
      std::vector<std::uint32_t> all;
      after_all([&] {
        for (const Board& other : teams_->boards_) all.push_back(other.number);
      });
      return all;
    }
    void exchange(std::span<const ParcelOut> out, std::span<const ParcelIn> in) override {
      mine().parcels = out;
      after_all([&] {
        std::vector<std::size_t> taken(ranks());
        for (const ParcelIn& parcel : in) {
          const std::span<const ParcelOut> sent = teams_->boards_[parcel.rank].parcels;
          std::size_t& next = taken[parcel.rank];
          while (sent[next].rank != rank_) ++next;
          std::copy_n(sent[next++].bytes.begin(), parcel.bytes.size(), parcel.bytes.begin());
        }
      });
    }
    void complete(std::span<std::byte> column, std::span<const std::size_t> begins) override {
      mine().column = column;
      const std::size_t size = begins.back() == 0 ? 0 : column.size() / begins.back();
      after_all([&] {
        for (std::size_t r = 0; r < ranks(); ++r)
          if (r != rank_)
            std::copy_n(teams_->boards_[r].column.begin() + static_cast<std::ptrdiff_t>(begins[r] * size),
                        (begins[r + 1] - begins[r]) * size,
                        column.begin() + static_cast<std::ptrdiff_t>(begins[r] * size));
      });
    }

    void send(std::size_t to, std::span<const std::byte> bytes) override {
      Box& box = teams_->boxes_[rank_ * ranks() + to];
      const std::lock_guard lock(box.mutex);
      box.messages.emplace_back(bytes.begin(), bytes.end());
      box.filled.notify_one();
    }
    void expect(std::size_t from, std::span<std::byte> bytes) override { expected_.push_back({from, bytes}); }
    void await() override {
      const ParcelIn parcel = expected_.front();
      expected_.pop_front();
      Box& box = teams_->boxes_[parcel.rank * ranks() + rank_];
      std::unique_lock lock(box.mutex);
      box.filled.wait(lock, [&] { return !box.messages.empty(); });
      std::copy(box.messages.front().begin(), box.messages.front().end(), parcel.bytes.begin());
      box.messages.pop_front();
    }
    void share(std::span<std::byte> bytes) override {
      const ParcelOut shown{0, bytes};
      mine().parcels = {&shown, 1};
      after_all([&] {
        const std::span<const std::byte> from = teams_->boards_[0].parcels[0].bytes;
        if (rank_ != 0) std::copy(from.begin(), from.end(), bytes.begin());
      });
    }

   private:
    Board& mine() { return teams_->boards_[rank_]; }
    /// Reads the boards when every rank has written its own, and goes on when every rank has read.
    template <class Read>
    void after_all(const Read& read) {
      teams_->barrier_.arrive_and_wait();
      read();
      teams_->barrier_.arrive_and_wait();
    }

    ThreadTeams* teams_;
    std::size_t rank_;
    std::deque<ParcelIn> expected_;
  };

  std::vector<Board> boards_;
  std::vector<Box> boxes_;  // from rank r to rank s: r R + s
  std::barrier<> barrier_;
};

}  // namespace mote
