#pragma once
/// Membership: which groups of a filter's particles a process has, and how it hears of the others.

#include <span>
#include <vector>

#include "mote/filter/topology.hpp"

namespace mote {

/// What one group sends another.
struct Letter {
  std::size_t from, to;  ///< groups
  std::vector<std::byte> bytes;
};

/// A process's groups, a run of all K. This one has them all; where several processes share them, all call the same
/// operations in the same order, and no result depends on who has what: sums over all particles are formed by group,
/// then over the groups in their order.
class Membership {
 public:
  /// All groups.
  explicit Membership(const Groups& groups) : Membership(groups, 0, groups.count()) {}
  virtual ~Membership() = default;

  const Groups& groups() const { return groups_; }
  /// The groups here are [begin, end).
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }
  bool has(std::size_t k) const { return begin_ <= k && k < end_; }
  bool has_all() const { return begin_ == 0 && end_ == groups_.count(); }
  /// Particles of groups before the first one here.
  std::size_t offset() const { return groups_.first(begin_); }
  /// Particles here.
  std::size_t particles() const { return groups_.first(end_) - offset(); }
  /// Where group k begins among the particles here, and its particles.
  std::size_t first(std::size_t k) const { return groups_.first(k) - offset(); }
  std::size_t size(std::size_t k) const { return groups_.size(k); }

  /// of(first, n) of every group here, its particles being [first, first + n).
  template <class Of>
  std::vector<double> by_group(const Of& of) const {
    std::vector<double> all;
    for (std::size_t k = begin_; k < end_; ++k) all.push_back(of(first(k), size(k)));
    return all;
  }
  double sum(std::vector<double> here) const {
    double sum = 0;
    for (const double term : of_all(std::move(here))) sum += term;
    return sum;
  }
  double largest(std::vector<double> here) const {
    const auto all = of_all(std::move(here));
    return *std::max_element(all.begin(), all.end());
  }

  /// A number of every group, from those of the groups here.
  virtual std::vector<double> of_all(std::vector<double> here) const { return here; }
  /// Hands over letters to groups elsewhere, and fills those that groups elsewhere send here.
  ///
  /// shape   both in the order of the senders, and of their neighbours; the bytes of `in` have their length
  virtual void carry(std::span<const Letter> /*out*/, std::span<Letter> /*in*/) const {}
  /// Completes a column of all N particles, of which those here are this process's.
  ///
  /// shape   elements of 4 or 8 bytes
  virtual void complete(std::span<std::byte> /*column*/) const {}

 protected:
  Membership(const Groups& groups, std::size_t begin, std::size_t end) : groups_(groups), begin_(begin), end_(end) {}
  Membership(const Membership&) = default;
  Membership(Membership&&) = default;
  Membership& operator=(const Membership&) = default;
  Membership& operator=(Membership&&) = default;

 private:
  Groups groups_;
  std::size_t begin_, end_;
};

}  // namespace mote
