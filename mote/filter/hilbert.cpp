#include "mote/filter/hilbert.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "mote/filter/estimate.hpp"

namespace mote {
namespace {

/// Bits in the order of the numbers: of two numbers the smaller has the smaller bits.
std::uint64_t ordered_bits(double value) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

/// The cell of a component in [0, 2^digits): its logistic share of the side; 0 for what is not a number.
class Side {
 public:
  Side(const Moments& moments, bool angle, unsigned digits)
      : moments_(moments), angle_(angle), cells_(std::ldexp(1.0, static_cast<int>(digits))) {}

  double difference(double value) const {
    return angle_ ? numbers::wrap(value - moments_.mean) : value - moments_.mean;
  }
  std::uint32_t cell(double value) const {
    const double steepness = kPi / std::sqrt(3.0) / moments_.sd;
    const double share = 1 / (1 + std::exp(-steepness * difference(value)));
    return share > 0 ? static_cast<std::uint32_t>(std::min(share * cells_, cells_ - 1)) : 0;
  }

 private:
  Moments moments_;
  bool angle_;
  double cells_;
};

}  // namespace

std::uint64_t hilbert_place(std::span<std::uint32_t> cell, unsigned digits) {
  const std::uint32_t top = std::uint32_t{1} << (digits - 1);
  std::uint32_t first = cell[0];
  for (std::uint32_t q = top; q > 1; q >>= 1U) {
    const std::uint32_t below = q - 1;
    const auto high = [q](std::uint32_t c) { return (c & q) != 0 ? ~0U : 0U; };
    first ^= below & high(first);
    for (std::uint32_t& c : cell.subspan(1)) {
      const std::uint32_t swapped = (first ^ c) & below & ~high(c);
      first ^= (below & high(c)) | swapped;
      c ^= swapped;
    }
  }
  cell[0] = first;
  for (std::size_t d = 1; d < cell.size(); ++d) cell[d] ^= cell[d - 1];
  std::uint32_t turned = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1U)
    if ((cell.back() & q) != 0) turned ^= q - 1;
  std::uint64_t place = 0;
  for (std::uint32_t q = top; q > 0; q >>= 1U)
    for (const std::uint32_t c : cell) place = place << 1U | (((c ^ turned) & q) != 0 ? 1U : 0U);
  return place;
}

void place_particles(const WeightedSet& set, const std::vector<Quantity>& states, std::vector<Placed>& out) {
  const std::size_t used = std::min<std::size_t>(states.size(), 64);
  const unsigned digits = hilbert_digits(states.size());
  std::vector<Side> sides;
  for (std::size_t d = 0; d < used; ++d)
    sides.emplace_back(component_moments(set, d, states[d].angle), states[d].angle, digits);
  out.resize(set.size());
  set.visit([&](const auto& x) {
    std::vector<std::uint32_t> cell(used);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto value = [&](std::size_t d) { return static_cast<double>(x.component(d)[i]); };
      out[i].index = static_cast<Index>(i);
      if (used == 1) {
        out[i].place = ordered_bits(states[0].angle ? sides[0].difference(value(0)) : value(0));
      } else {
        for (std::size_t d = 0; d < used; ++d) cell[d] = sides[d].cell(value(d));
        out[i].place = hilbert_place(cell, digits);
      }
    }
  });
  std::sort(out.begin(), out.end());
}

}  // namespace mote
