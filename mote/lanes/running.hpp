#pragma once
/// What the resamplers need beyond arithmetic, register by register: running sums along the lanes, exact in fixed
/// point, and values repeated where marks say so.

#include "mote/lanes/vector.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

/// The whole number that goes with an R, of the same size.
template <class R>
using Whole = std::conditional_t<std::is_same_v<R, float>, std::int32_t, std::int64_t>;
template <class R>
using WholeTag = typename Registers<Whole<R>>::Tag;
template <class R>
using WholeRegister = typename Registers<Whole<R>>::Register;
template <class R>
using NumberRegister = typename Registers<R>::Register;

/// Units that a sum is split into: as many as leave room for the rounding of some thousand terms.
template <class R>
inline constexpr R kUnits = std::is_same_v<R, float> ? R(0x1p30) : R(0x1p51);

#if HWY_TARGET <= HWY_AVX3

/// Sums of the lanes up to and including each.
MOTE_INLINE WholeRegister<float> running_sum(WholeRegister<float> v) {
  const __m512i zero = _mm512_setzero_si512();
  v.raw = _mm512_add_epi32(v.raw, _mm512_alignr_epi32(v.raw, zero, 15));
  v.raw = _mm512_add_epi32(v.raw, _mm512_alignr_epi32(v.raw, zero, 14));
  v.raw = _mm512_add_epi32(v.raw, _mm512_alignr_epi32(v.raw, zero, 12));
  v.raw = _mm512_add_epi32(v.raw, _mm512_alignr_epi32(v.raw, zero, 8));
  return v;
}
MOTE_INLINE WholeRegister<double> running_sum(WholeRegister<double> v) {
  const __m512i zero = _mm512_setzero_si512();
  v.raw = _mm512_add_epi64(v.raw, _mm512_alignr_epi64(v.raw, zero, 7));
  v.raw = _mm512_add_epi64(v.raw, _mm512_alignr_epi64(v.raw, zero, 6));
  v.raw = _mm512_add_epi64(v.raw, _mm512_alignr_epi64(v.raw, zero, 4));
  return v;
}
/// The last lane in all lanes.
MOTE_INLINE WholeRegister<float> last_lane(WholeRegister<float> v) {
  return {_mm512_permutexvar_epi32(_mm512_set1_epi32(15), v.raw)};
}
MOTE_INLINE WholeRegister<double> last_lane(WholeRegister<double> v) {
  return {_mm512_permutexvar_epi64(_mm512_set1_epi64(7), v.raw)};
}
/// The nearest whole number, below 2^31 in magnitude.
MOTE_INLINE WholeRegister<float> nearest(NumberRegister<float> v) { return {_mm512_cvtps_epi32(v.raw)}; }
/// The least whole number that is not below, below 2^31 in magnitude.
MOTE_INLINE WholeRegister<float> rounded_up(NumberRegister<float> v) {
  return {_mm512_cvt_roundps_epi32(v.raw, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC)};
}

/// Every lane's predecessor: the last lane of `before`, then all but the last of v.
MOTE_INLINE WholeRegister<float> preceding(WholeRegister<float> before, WholeRegister<float> v) {
  return {_mm512_alignr_epi32(v.raw, before.raw, 15)};
}
MOTE_INLINE WholeRegister<double> preceding(WholeRegister<double> before, WholeRegister<double> v) {
  return {_mm512_alignr_epi64(v.raw, before.raw, 7)};
}

#elif HWY_TARGET == HWY_AVX2

MOTE_INLINE WholeRegister<float> preceding(WholeRegister<float> before, WholeRegister<float> v) {
  return {_mm256_alignr_epi8(v.raw, _mm256_permute2x128_si256(before.raw, v.raw, 0x21), 12)};
}
MOTE_INLINE WholeRegister<double> preceding(WholeRegister<double> before, WholeRegister<double> v) {
  return {_mm256_alignr_epi8(v.raw, _mm256_permute2x128_si256(before.raw, v.raw, 0x21), 8)};
}
MOTE_INLINE WholeRegister<float> running_sum(WholeRegister<float> v) {
  v.raw = _mm256_add_epi32(v.raw, _mm256_slli_si256(v.raw, 4));
  v.raw = _mm256_add_epi32(v.raw, _mm256_slli_si256(v.raw, 8));
  // the sum of the lower half goes to all of the upper one
  return {_mm256_add_epi32(v.raw, _mm256_permute2x128_si256(_mm256_shuffle_epi32(v.raw, 0xFF), v.raw, 0x08))};
}
MOTE_INLINE WholeRegister<double> running_sum(WholeRegister<double> v) {
  v.raw = _mm256_add_epi64(v.raw, _mm256_slli_si256(v.raw, 8));
  return {_mm256_add_epi64(v.raw, _mm256_permute2x128_si256(_mm256_shuffle_epi32(v.raw, 0xEE), v.raw, 0x08))};
}
MOTE_INLINE WholeRegister<float> last_lane(WholeRegister<float> v) {
  return {_mm256_permutevar8x32_epi32(v.raw, _mm256_set1_epi32(7))};
}
MOTE_INLINE WholeRegister<double> last_lane(WholeRegister<double> v) { return {_mm256_permute4x64_epi64(v.raw, 0xFF)}; }
MOTE_INLINE WholeRegister<float> nearest(NumberRegister<float> v) { return {_mm256_cvtps_epi32(v.raw)}; }
MOTE_INLINE WholeRegister<float> rounded_up(NumberRegister<float> v) { return nearest(hn::Ceil(v)); }

#else

MOTE_INLINE WholeRegister<float> preceding(WholeRegister<float> before, WholeRegister<float> v) {
  return {_mm_alignr_epi8(v.raw, before.raw, 12)};
}
MOTE_INLINE WholeRegister<double> preceding(WholeRegister<double> before, WholeRegister<double> v) {
  return {_mm_alignr_epi8(v.raw, before.raw, 8)};
}
MOTE_INLINE WholeRegister<float> running_sum(WholeRegister<float> v) {
  v.raw = _mm_add_epi32(v.raw, _mm_slli_si128(v.raw, 4));
  return {_mm_add_epi32(v.raw, _mm_slli_si128(v.raw, 8))};
}
MOTE_INLINE WholeRegister<double> running_sum(WholeRegister<double> v) {
  return {_mm_add_epi64(v.raw, _mm_slli_si128(v.raw, 8))};
}
MOTE_INLINE WholeRegister<float> last_lane(WholeRegister<float> v) { return {_mm_shuffle_epi32(v.raw, 0xFF)}; }
MOTE_INLINE WholeRegister<double> last_lane(WholeRegister<double> v) { return {_mm_shuffle_epi32(v.raw, 0xEE)}; }
MOTE_INLINE WholeRegister<float> nearest(NumberRegister<float> v) { return {_mm_cvtps_epi32(v.raw)}; }
MOTE_INLINE WholeRegister<float> rounded_up(NumberRegister<float> v) { return nearest(hn::Ceil(v)); }

#endif

/// The number itself, rounded to R.
MOTE_INLINE NumberRegister<float> as_number(WholeRegister<float> v) {
  return hn::ConvertTo(Registers<float>::Tag{}, v);
}

#if HWY_TARGET <= HWY_AVX3

MOTE_INLINE WholeRegister<double> nearest(NumberRegister<double> v) { return {_mm512_cvtpd_epi64(v.raw)}; }
MOTE_INLINE WholeRegister<double> rounded_up(NumberRegister<double> v) {
  return {_mm512_cvt_roundpd_epi64(v.raw, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC)};
}
MOTE_INLINE NumberRegister<double> as_number(WholeRegister<double> v) { return {_mm512_cvtepi64_pd(v.raw)}; }

#else

// Doubles: a number from 0 to 2^52 plus 2^52 has the number itself in the low bits of its mantissa.

MOTE_INLINE NumberRegister<double> two_to_52() { return hn::Set(Registers<double>::Tag{}, 0x1p52); }
MOTE_INLINE WholeRegister<double> nearest(NumberRegister<double> v) {
  const WholeTag<double> whole;
  return hn::Sub(hn::BitCast(whole, hn::Add(v, two_to_52())), hn::BitCast(whole, two_to_52()));
}
MOTE_INLINE WholeRegister<double> rounded_up(NumberRegister<double> v) { return nearest(hn::Ceil(v)); }

MOTE_INLINE NumberRegister<double> as_number(WholeRegister<double> v) {
  const Registers<double>::Tag tag;
  return hn::Sub(hn::BitCast(tag, hn::Add(v, hn::BitCast(WholeTag<double>{}, two_to_52()))), two_to_52());
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
