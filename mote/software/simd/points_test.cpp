#include "mote/software/simd/points.hpp"

#include <gtest/gtest.h>

#include "mote/base/aligned.hpp"
#include "mote/base/normal.hpp"

namespace mote {
namespace {

/// Makes the draws of all points in chunks of several lengths and hands each to check(point, draw, number).
template <class R, class Check>
void visit(const Sobol& sobol, std::size_t points, const lanes::DrawPattern& pattern, const Draws& draws,
           const Check& check) {
  VectorPoints<R> vectors;
  vectors.scramble(sobol, points, draws);
  const typename VectorPoints<R>::Source source({draws.seed, draws.step, Purpose::kMove, 0});
  AlignedVector<R> numbers(pattern.normal.size() * kBlock);
  for (std::size_t start = 0; start < points; start += 256) {
    const std::size_t count = std::min<std::size_t>(256, points - start);
    vectors.make_ready(source, pattern, start, count, numbers.data());
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t k = 0; k < pattern.normal.size(); ++k) check(start + j, k, numbers[k * kBlock + j]);
  }
}

// claim    the draws are those of PointDraw: uniform numbers bit by bit, normal numbers but for the table's error
// referee  ScrambledPoints, a point at a time
// design   whole and broken vectors, a number of points that is no power of two, steps scrambled anew; the twin
//          (another step) must be caught
template <class R>
void expect_the_points_of_the_reference() {
  const Sobol sobol(5);
  const lanes::DrawPattern pattern{{true, false, true, false, false}};
  for (const std::size_t n : {1UL, 5UL, 16UL, 1000UL, 1024UL, 5001UL})
    for (const std::uint32_t step : {1U, 2U}) {
      const ScrambledPoints points(sobol, n, {3, step});
      const ScrambledPoints twin(sobol, n, {3, step + 1});
      std::size_t like_the_twin = 0;
      std::size_t all = 0;
      visit<R>(sobol, n, pattern, {3, step}, [&](std::size_t i, std::size_t k, R number) {
        const std::uint64_t bits = points.bits(i, k);
        if (pattern.normal[k]) {
          EXPECT_NEAR(number, normal_from_bits(bits), (std::is_same_v<R, float> ? 2e-4 : 1e-8)) << n << ", " << i;
        } else if constexpr (std::is_same_v<R, float>) {
          EXPECT_EQ(number, uniform_from_bits(static_cast<std::uint32_t>(bits >> 32U))) << n << ", " << i;
        } else {
          EXPECT_EQ(number, uniform_from_bits(bits)) << n << ", " << i;
        }
        ++all;
        if (std::abs(number - (pattern.normal[k] ? normal_from_bits(twin.bits(i, k))
                                                 : uniform_from_bits(twin.bits(i, k)))) < 2e-4)
          ++like_the_twin;
      });
      EXPECT_LT(like_the_twin, all / 10 + 1) << "the twin";
    }
}

TEST(VectorPoints, AreThoseOfTheReference) {
  expect_the_points_of_the_reference<float>();
  expect_the_points_of_the_reference<double>();
}

}  // namespace
}  // namespace mote
