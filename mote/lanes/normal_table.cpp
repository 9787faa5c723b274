#include "mote/lanes/normal_table.hpp"

#include <cmath>
#include <utility>

#include "mote/base/normal.hpp"
#include "mote/base/numbers.hpp"

namespace mote::lanes {
namespace {

/// Coefficients in s = v - 3/2 of the interpolant of |z|(v scale) on v in [1, 2].
template <std::size_t kDegree>
std::array<double, kDegree + 1> interpolant(double scale) {
  constexpr std::size_t kPoints = kDegree + 1;
  // divided differences at Chebyshev points, then Newton's form expanded from the inside out
  std::array<double, kPoints> at{};
  std::array<double, kPoints> differences{};
  for (std::size_t i = 0; i < kPoints; ++i) {
    at[i] = 0.5 * std::cos(kPi * (static_cast<double>(i) + 0.5) / kPoints);
    differences[i] = -standard_normal_quantile((1.5 + at[i]) * scale);
  }
  for (std::size_t order = 1; order < kPoints; ++order)
    for (std::size_t i = kPoints - 1; i >= order; --i)
      differences[i] = (differences[i] - differences[i - 1]) / (at[i] - at[i - order]);
  std::array<double, kPoints> c{};
  for (std::size_t i = kPoints; i-- > 0;) {
    for (std::size_t j = kPoints - 1; j > 0; --j) c[j] = c[j - 1] - at[i] * c[j];
    c[0] = differences[i] - at[i] * c[0];
  }
  return c;
}

NormalTable build() {
  NormalTable table{};
  for (int octave = 1; octave <= NormalTable::kOctaves; ++octave) {
    const double scale = std::ldexp(1.0, -1 - octave);
    const auto narrow = interpolant<NormalTable::kDegreeFloat>(scale);
    const int exponent = 127 + 32 - 1 - octave;
    for (std::size_t j = 0; j < narrow.size(); ++j)
      table.narrow[j][static_cast<std::size_t>(exponent % 16)] = static_cast<float>(narrow[j]);
    const auto wide = interpolant<NormalTable::kDegreeDouble>(scale);
    const int wide_exponent = 1023 + 64 - 1 - octave;
    auto& part = octave <= 8 ? table.wide : table.wide_low;
    for (std::size_t j = 0; j < wide.size(); ++j) part[j][static_cast<std::size_t>(wide_exponent % 8)] = wide[j];
  }
  return table;
}

}  // namespace

const NormalTable& normal_table() {
  static const NormalTable table = build();
  return table;
}

}  // namespace mote::lanes
