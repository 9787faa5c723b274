#include "mote/lanes/normal_table.hpp"

#include <cmath>
#include <utility>

#include "mote/base/normal.hpp"
#include "mote/base/numbers.hpp"

namespace mote::lanes {
namespace {

/// Coefficients in s = v - middle of the interpolant of |z|(v scale) on |s| <= half_width.
template <std::size_t kDegree>
std::array<double, kDegree + 1> interpolant(double scale, double middle, double half_width) {
  constexpr std::size_t kPoints = kDegree + 1;
  // divided differences at Chebyshev points, then Newton's form expanded from the inside out
  std::array<double, kPoints> at{};
  std::array<double, kPoints> differences{};
  for (std::size_t i = 0; i < kPoints; ++i) {
    at[i] = half_width * std::cos(kPi * (static_cast<double>(i) + 0.5) / kPoints);
    differences[i] = -standard_normal_quantile((middle + at[i]) * scale);
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
    const auto narrow = interpolant<NormalTable::kDegreeFloat>(scale, 1.5, 0.5);
    const int exponent = 127 + 32 - 1 - octave;
    for (std::size_t j = 0; j < narrow.size(); ++j)
      table.narrow[j][static_cast<std::size_t>(exponent % 16)] = static_cast<float>(narrow[j]);
    const int wide_exponent = 1023 + 64 - 1 - octave;
    auto& halves = octave <= 8 ? table.halves : table.halves_low;
    for (const int half : {0, 1}) {
      const auto c = interpolant<NormalTable::kDegreeHalves>(scale, 1.25 + 0.5 * half, 0.25);
      for (std::size_t j = 0; j < c.size(); ++j)
        halves[j][static_cast<std::size_t>(2 * (wide_exponent % 8) + half)] = c[j];
    }
    constexpr int kPieces = 1 << NormalTable::kFineBits;
    for (int piece = 0; piece < kPieces; ++piece)
      table.fine[static_cast<std::size_t>(kPieces * (wide_exponent % 16) + piece)] =
          interpolant<NormalTable::kDegreeFine>(scale, 1 + (2 * piece + 1) * NormalTable::kFineHalf,
                                                NormalTable::kFineHalf);
  }
  return table;
}

}  // namespace

const NormalTable& normal_table() {
  static const NormalTable table = build();
  return table;
}

}  // namespace mote::lanes
