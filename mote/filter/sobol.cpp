#include "mote/filter/sobol.hpp"

#include <algorithm>
#include <stdexcept>

#include <boost/random/sobol.hpp>

namespace mote {
namespace {

using Table = boost::random::default_sobol_table;
static_assert(Table::max_dimension == Sobol::kMostDimensions);

constexpr std::size_t kDigits = 32;

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

}  // namespace

Sobol::Sobol(std::size_t dimensions) {
  if (dimensions > kMostDimensions) throw std::invalid_argument("Sobol: at most 3667 dimensions");
  for (std::size_t d = 0; d < dimensions; ++d) directions_.push_back(direction_numbers(d));
}

void ScrambledPoints::scramble(const Sobol& sobol, std::size_t points, const Draws& draws) {
  digits_.resize(sobol.dimensions());
  // direction number b has b + 1 digits: no column of L beyond those is met
  const auto used = static_cast<std::size_t>(std::bit_width(std::max<std::size_t>(points, 1) - 1));
  for (std::size_t d = 0; d < digits_.size(); ++d) {
    Xoshiro coins =
        keyed_generator({draws.seed, draws.step, Purpose::kPoints, static_cast<std::uint32_t>(d), draws.stream}, 0);
    Digits& digits = digits_[d];
    digits.shift = coins.next();
    std::array<std::uint64_t, kDigits> column;
    for (std::size_t j = 0; j < used; ++j) column[j] = (coins.next() | std::uint64_t{1} << 63U) >> j;
    for (std::size_t b = 0; b < used; ++b) {
      digits.direction[b] = 0;
      for (std::uint32_t left = sobol.digits(std::uint32_t{1} << b, d); left != 0; left &= left - 1)
        digits.direction[b] ^= column[kDigits - 1 - static_cast<std::size_t>(std::countr_zero(left))];
    }
  }
}

}  // namespace mote
