#pragma once
/// Squares of numbers turned over: what lay along the lanes lies across them.

#include "mote/lanes/vector.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

/// Turns a square of kWidth<R> rows over: number k of the row at from(i) goes to number i of the row at to(k).
///
/// shape   from(i), to(k): pointers to kWidth<R> numbers, at any address; all rows are read before one is written
/// cost    where registers have 512 bits: 64 loads and 32 shuffles for 256 floats, 32 and 8 for 64 doubles
template <class R, class From, class To>
MOTE_INLINE void transpose(const From& from, const To& to) {
  constexpr std::size_t kRows = kWidth<R>;
#if HWY_TARGET <= HWY_AVX3
  if constexpr (std::is_same_v<R, float>) {
    // quarter q of rows i, 4 + i, 8 + i, 12 + i side by side: loads, no shuffles; four such squares of four remain
    std::array<__m512, kRows> column;
    unrolled<4>([&](std::size_t q) __attribute__((always_inline)) {
      std::array<__m512, 4> quarter;
      unrolled<4>([&](std::size_t i) __attribute__((always_inline)) {
        const auto piece = [&](std::size_t row) __attribute__((always_inline)) {
          return _mm_loadu_ps(from(row) + 4 * q);
        };
        __m512 all = _mm512_castps128_ps512(piece(i));
        all = _mm512_mask_broadcast_f32x4(all, 0x00F0, piece(4 + i));
        all = _mm512_mask_broadcast_f32x4(all, 0x0F00, piece(8 + i));
        quarter[i] = _mm512_mask_broadcast_f32x4(all, 0xF000, piece(12 + i));
      });
      const auto pair = [&](const __m512& a, const __m512& b, std::size_t low) __attribute__((always_inline)) {
        const __m512d even = _mm512_castps_pd(_mm512_unpacklo_ps(a, b));
        const __m512d odd = _mm512_castps_pd(_mm512_unpackhi_ps(a, b));
        return low == 0 ? even : odd;
      };
      unrolled<2>([&](std::size_t half) __attribute__((always_inline)) {
        const __m512d a = pair(quarter[0], quarter[1], half);
        const __m512d b = pair(quarter[2], quarter[3], half);
        column[4 * q + 2 * half] = _mm512_castpd_ps(_mm512_unpacklo_pd(a, b));
        column[4 * q + 2 * half + 1] = _mm512_castpd_ps(_mm512_unpackhi_pd(a, b));
      });
    });
    unrolled<kRows>([&](std::size_t k) __attribute__((always_inline)) { _mm512_storeu_ps(to(k), column[k]); });
  } else {
    std::array<__m512d, kRows> column;
    unrolled<4>([&](std::size_t q) __attribute__((always_inline)) {
      std::array<__m512d, 2> quarter;
      unrolled<2>([&](std::size_t i) __attribute__((always_inline)) {
        const auto piece = [&](std::size_t row) __attribute__((always_inline)) {
          return _mm_loadu_pd(from(row) + 2 * q);
        };
        __m512d all = _mm512_castpd128_pd512(piece(i));
        all = _mm512_mask_broadcast_f64x2(all, 0x0C, piece(2 + i));
        all = _mm512_mask_broadcast_f64x2(all, 0x30, piece(4 + i));
        quarter[i] = _mm512_mask_broadcast_f64x2(all, 0xC0, piece(6 + i));
      });
      column[2 * q] = _mm512_unpacklo_pd(quarter[0], quarter[1]);
      column[2 * q + 1] = _mm512_unpackhi_pd(quarter[0], quarter[1]);
    });
    unrolled<kRows>([&](std::size_t k) __attribute__((always_inline)) { _mm512_storeu_pd(to(k), column[k]); });
  }
#else
  std::array<R, kRows * kRows> square;
  for (std::size_t i = 0; i < kRows; ++i) {
    const R* const row = from(i);
    for (std::size_t k = 0; k < kRows; ++k) square[k * kRows + i] = row[k];
  }
  for (std::size_t k = 0; k < kRows; ++k) {
    R* const row = to(k);
    for (std::size_t i = 0; i < kRows; ++i) row[i] = square[k * kRows + i];
  }
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
