#pragma once
/// CountingTeam: a team that counts what its ranks send.

#include <bit>

#include "mote/engine/team.hpp"
#include "mote/filter/traffic.hpp"

namespace mote {

/// A team's operations, and what one rank of R sends in them:
///
///   largest, add      log2 R messages of all numbers: recursive doubling
///   before            one to each rank at a doubled distance
///   gather, complete  log2 R messages; what each rank has goes once to each other
///   share             what rank 0 has goes once to each other, counted as its own
///   exchange, send    as they are
///
/// log2 R is rounded up.
class CountingTeam final : public Team {
 public:
  explicit CountingTeam(Team& team) : team_(&team), rounds_(static_cast<double>(std::bit_width(team.ranks() - 1))) {}

  /// What this rank has sent.
  const Traffic& traffic() const { return traffic_; }

  std::size_t rank() const override { return team_->rank(); }
  std::size_t ranks() const override { return team_->ranks(); }
  void largest(std::span<double> numbers) override {
    count(rounds_, rounds_ * bytes_of(numbers));
    team_->largest(numbers);
  }
  void add(std::span<ExactSum> sums) override {
    count(rounds_, rounds_ * bytes_of(sums));
    team_->add(sums);
  }
  ExactSum before(const ExactSum& mine) override {
    const auto sent = static_cast<double>(std::bit_width(ranks() - 1 - rank()));
    count(sent, sent * sizeof(ExactSum));
    return team_->before(mine);
  }
  std::vector<std::uint32_t> gather(std::uint32_t mine) override {
    count(rounds_, others() * sizeof mine);
    return team_->gather(mine);
  }
  void exchange(std::span<const ParcelOut> out, std::span<const ParcelIn> in) override {
    for (const ParcelOut& parcel : out) count(1, bytes_of(parcel.bytes));
    team_->exchange(out, in);
  }
  void complete(std::span<std::byte> column, std::span<const std::size_t> begins) override {
    if (!column.empty()) {
      const double element = bytes_of(column) / static_cast<double>(begins.back());
      count(rounds_, others() * element * static_cast<double>(begins[rank() + 1] - begins[rank()]));
    }
    team_->complete(column, begins);
  }
  void share(std::span<std::byte> bytes) override {
    if (rank() == 0) count(others(), others() * bytes_of(bytes));
    team_->share(bytes);
  }
  void send(std::size_t to, std::span<const std::byte> bytes) override {
    count(1, bytes_of(bytes));
    team_->send(to, bytes);
  }
  void expect(std::size_t from, std::span<std::byte> bytes) override { team_->expect(from, bytes); }
  void await() override { team_->await(); }

 private:
  template <class T>
  static double bytes_of(std::span<T> elements) {
    return static_cast<double>(elements.size_bytes());
  }
  double others() const { return static_cast<double>(ranks() - 1); }
  void count(double messages, double bytes) { traffic_ += {messages, bytes}; }

  Team* team_;
  double rounds_;
  Traffic traffic_;
};

}  // namespace mote
