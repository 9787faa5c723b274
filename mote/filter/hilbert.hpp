#pragma once
/// Hilbert's curve: an order for points of several dimensions in which neighbours along the order are neighbours in
/// space.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mote/filter/particles.hpp"

namespace mote {

/// Binary digits of a cell's coordinate: 2^28 particles would have 2^5 cells a side each, if places in 64 bits allow.
///
/// shape   1..32; in more than 64 dimensions 1, and the curve runs through the first 64
constexpr unsigned hilbert_digits(std::size_t dimensions) {
  return static_cast<unsigned>(
      std::clamp<std::size_t>(28 / dimensions + 5, 1, std::max<std::size_t>(64 / dimensions, 1)));
}

/// The place of a cell along Hilbert's curve through the cube of 2^digits cells a side: cells with consecutive places
/// share a face.
///
/// shape   cell: (D,), D digits <= 64, coordinates below 2^digits; overwritten
/// cost    O(D digits)
/// source  Skilling 2004, "Programming the Hilbert curve"
std::uint64_t hilbert_place(std::span<std::uint32_t> cell, unsigned digits);

/// A place in an order, and who holds it.
struct Placed {
  std::uint64_t place;
  Index index;

  friend bool operator<(const Placed& a, const Placed& b) {
    return a.place != b.place ? a.place < b.place : a.index < b.index;
  }
};

/// Orders weighted particles: by value in one dimension; in more along Hilbert's curve through the unit cube, into
/// which each component goes by the logistic distribution function of its mean and standard deviation.
///
///   u_d = 1 / (1 + exp(-(pi / sqrt 3) (x_d - mean_d) / sd_d));   an angle by its wrapped difference from the mean
///
/// shape   states: one a component; out: (N,) sorted; values that are not numbers come at an end
/// cost    O(N log N), 16 N bytes
/// source  Gerber & Chopin 2015, section 3.1, who scale to mean +- 2 sd
void place_particles(const WeightedSet& set, const std::vector<Quantity>& states, std::vector<Placed>& out);

}  // namespace mote
