#include "mote/filter/sobol.hpp"

#include <algorithm>
#include <stdexcept>

#include <boost/random/sobol.hpp>

namespace mote {
namespace {

using Table = boost::random::default_sobol_table;
static_assert(Table::max_dimension == Sobol::kMostDimensions);

constexpr std::size_t kDigits = 32;
constexpr unsigned kTree = 6;  // digits whose coins fit into one word: 2^6 - 1 nodes

/// v_b = m_b 2^{31-b} of a dimension.
///
///   m_b = 2 a_1 m_{b-1} ^ 4 a_2 m_{b-2} ^ ... ^ 2^s m_{b-s} ^ m_{b-s},   a the coefficients of a primitive polynomial
///
/// source  Bratley & Fox 1988, algorithm 659
std::array<std::uint32_t, kDigits> direction_numbers(std::size_t dimension) {
  std::array<std::uint32_t, kDigits> m{};
  if (dimension == 0) {
    m.fill(1);
  } else {
    const std::uint32_t polynomial = Table::polynomial(dimension - 1);
    const auto degree = static_cast<std::size_t>(std::bit_width(polynomial)) - 1;
    for (std::size_t b = 0; b < degree; ++b) m[b] = Table::minit(dimension - 1, b);
    for (std::size_t b = degree; b < kDigits; ++b) {
      m[b] = m[b - degree];
      for (std::size_t k = 1; k <= degree; ++k)
        if ((polynomial >> (degree - k) & 1U) != 0) m[b] ^= m[b - k] << k;
    }
  }
  for (std::size_t b = 0; b < kDigits; ++b) m[b] <<= kDigits - 1 - b;
  return m;
}

/// The word of a node of a tree of digits: splitmix64 at place `node` of the sequence that starts from `key`.
std::uint64_t word_at(std::uint64_t key, std::uint64_t node) { return mixed(key + node * 0x9E3779B97F4A7C15ULL); }

}  // namespace

Sobol::Sobol(std::size_t dimensions) {
  if (dimensions > kMostDimensions) throw std::invalid_argument("Sobol: at most 3667 dimensions");
  for (std::size_t d = 0; d < dimensions; ++d) directions_.push_back(direction_numbers(d));
}

ScrambledPoints::ScrambledPoints(const Sobol& sobol, std::size_t points, const Draws& draws)
    : sobol_(&sobol),
      trees_((static_cast<unsigned>(std::bit_width(std::max<std::size_t>(points, 1) - 1)) + kTree - 1) / kTree) {
  for (std::size_t d = 0; d < sobol.dimensions(); ++d)
    keys_.push_back(
        keyed_generator({draws.seed, draws.step, Purpose::kPoints, static_cast<std::uint32_t>(d), draws.stream}, 0)
            .next());
}

std::uint64_t ScrambledPoints::bits(std::size_t point, std::size_t dimension) const {
  const std::uint32_t digits = sobol_->digits(static_cast<std::uint32_t>(point), dimension);
  std::uint64_t scrambled = 0;
  std::uint64_t before = 1;  // the digits passed, behind a leading one
  unsigned left = kDigits;
  unsigned tree = 0;
  do {
    const std::uint64_t coins = word_at(keys_[dimension], before);
    std::uint64_t node = 1;
    for (unsigned k = 0; k < kTree; ++k) {
      const std::uint64_t digit = digits >> --left & 1U;
      scrambled = scrambled << 1U | (digit ^ (coins >> node & 1U));
      node = node << 1U | digit;
    }
    before = before << kTree | (node ^ std::uint64_t{1} << kTree);
  } while (++tree < trees_);
  const unsigned done = kDigits - left;
  return scrambled << (64 - done) | word_at(keys_[dimension], before) >> done;
}

}  // namespace mote
