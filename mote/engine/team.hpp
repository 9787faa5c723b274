#pragma once
/// Team: processes that share the particles of one filter.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mote/base/exact_sum.hpp"

namespace mote {

/// Bytes for another rank of a team, or from it.
template <class Byte>
struct Parcel {
  std::size_t rank;
  std::span<Byte> bytes;
};
using ParcelOut = Parcel<const std::byte>;
using ParcelIn = Parcel<std::byte>;

/// Ranks 0, 1, ..., R-1, which all call the same operations in the same order, but for send(), expect() and await(). No
/// result depends on R: sums are exact.
///
/// error   none is survived: where a rank is lost the whole team ends
class Team {
 public:
  virtual ~Team() = default;

  virtual std::size_t rank() const = 0;
  virtual std::size_t ranks() const = 0;
  /// Replaces each number by the largest that a rank has.
  virtual void largest(std::span<double> numbers) = 0;
  /// Replaces each sum by that over all ranks.
  virtual void add(std::span<ExactSum> sums) = 0;
  /// The sum over the ranks before this one.
  virtual ExactSum before(const ExactSum& mine) = 0;
  /// The number of every rank, in their order.
  virtual std::vector<std::uint32_t> gather(std::uint32_t mine) = 0;
  /// Hands over parcels; those between two ranks arrive in the order in which they were sent.
  ///
  /// shape   for every parcel sent one of its length is awaited by its receiver
  virtual void exchange(std::span<const ParcelOut> out, std::span<const ParcelIn> in) = 0;
  /// Completes a column of which rank r has the elements [begins[r], begins[r + 1]).
  ///
  /// shape   begins: (R + 1,), from 0 on; elements of 4 or 8 bytes
  virtual void complete(std::span<std::byte> column, std::span<const std::size_t> begins) = 0;
  /// Hands rank 0's bytes to all.
  virtual void share(std::span<std::byte> bytes) = 0;

  /// One rank to another, of which the others know nothing: sends a copy of the bytes, and may return before they
  /// arrive. Those between two ranks arrive in the order in which they were sent.
  virtual void send(std::size_t to, std::span<const std::byte> bytes) = 0;
  /// Makes room for the next message of a rank, of this length; await() says when it is there.
  virtual void expect(std::size_t from, std::span<std::byte> bytes) = 0;
  /// Waits for the oldest message that was made room for.
  virtual void await() = 0;

 protected:
  Team() = default;
  Team(const Team&) = default;
  Team(Team&&) = default;
  Team& operator=(const Team&) = default;
  Team& operator=(Team&&) = default;
};

}  // namespace mote
