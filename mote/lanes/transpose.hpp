#pragma once
/// Squares of numbers turned over: what lay along the lanes lies across them.

#include "mote/lanes/vector.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

/// Turns a square of kWidth<R> rows over: number k of the row at from(i) goes to number i of the row at to(k).
///
/// shape   from(i), to(k): pointers to kWidth<R> numbers, at any address; all rows are read before one is written
/// cost    where registers have 512 bits: 16 loads and 64 shuffles for 256 floats, 32 and 8 for 64 doubles
template <class R, class From, class To>
MOTE_INLINE void transpose(const From& from, const To& to) {
  constexpr std::size_t kRows = kWidth<R>;
#if HWY_TARGET <= HWY_AVX3
  if constexpr (std::is_same_v<R, float>) {
    std::array<__m512, kRows> pairs;
    unrolled<kRows / 2>([&](std::size_t k) __attribute__((always_inline)) {
      const __m512 a = _mm512_loadu_ps(from(2 * k));
      const __m512 b = _mm512_loadu_ps(from(2 * k + 1));
      pairs[2 * k] = _mm512_unpacklo_ps(a, b);
      pairs[2 * k + 1] = _mm512_unpackhi_ps(a, b);
    });
    std::array<__m512, kRows> quads;
    unrolled<kRows / 4>([&](std::size_t g) __attribute__((always_inline)) {
      unrolled<2>([&](std::size_t h) __attribute__((always_inline)) {
        const __m512d a = _mm512_castps_pd(pairs[4 * g + h]);
        const __m512d b = _mm512_castps_pd(pairs[4 * g + 2 + h]);
        quads[4 * g + 2 * h] = _mm512_castpd_ps(_mm512_unpacklo_pd(a, b));
        quads[4 * g + 2 * h + 1] = _mm512_castpd_ps(_mm512_unpackhi_pd(a, b));
      });
    });
    unrolled<4>([&](std::size_t j) __attribute__((always_inline)) {
      const __m512 even_low = _mm512_shuffle_f32x4(quads[j], quads[4 + j], 0x88);
      const __m512 even_high = _mm512_shuffle_f32x4(quads[8 + j], quads[12 + j], 0x88);
      const __m512 odd_low = _mm512_shuffle_f32x4(quads[j], quads[4 + j], 0xDD);
      const __m512 odd_high = _mm512_shuffle_f32x4(quads[8 + j], quads[12 + j], 0xDD);
      _mm512_storeu_ps(to(j), _mm512_shuffle_f32x4(even_low, even_high, 0x88));
      _mm512_storeu_ps(to(4 + j), _mm512_shuffle_f32x4(odd_low, odd_high, 0x88));
      _mm512_storeu_ps(to(8 + j), _mm512_shuffle_f32x4(even_low, even_high, 0xDD));
      _mm512_storeu_ps(to(12 + j), _mm512_shuffle_f32x4(odd_low, odd_high, 0xDD));
    });
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
