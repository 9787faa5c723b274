#pragma once
/// What chains side by side accept, turned over: from a step of every lane to the steps of each lane, and the values
/// that a lane holds after each of them.

#include <array>
#include <bit>

#include "mote/lanes/vector.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

/// Acceptances of kWidth<R> chains, one a lane, in as many steps.
template <class R>
class Acceptances {
 public:
  static constexpr std::size_t kLanes = kWidth<R>;

  /// The same by step: a bit a lane, step after step.
  class BySteps {
   public:
    MOTE_INLINE void note(std::size_t step, const Mask<R>& accepts) {
      words_[step * kLanes / 64] |= std::uint64_t{accepts.bits()} << (step * kLanes % 64);
    }

   private:
    friend class Acceptances;
    std::array<std::uint64_t, kLanes * kLanes / 64> words_{};
  };

  MOTE_INLINE void turn(const BySteps& by_steps) {
    const auto eight_lanes = [](__m128i lanes, std::uint32_t * steps) __attribute__((always_inline)) {
      for (std::size_t lane = 8; lane-- > 0; lanes = _mm_add_epi8(lanes, lanes))  // a byte a step: its highest bit
        steps[lane] = static_cast<std::uint32_t>(_mm_movemask_epi8(lanes));
    };
    const auto word = [&](std::size_t k) { return static_cast<long long>(by_steps.words_[k]); };
    if constexpr (kLanes == 16) {
      const __m128i early = _mm_set_epi64x(word(1), word(0));
      const __m128i late = _mm_set_epi64x(word(3), word(2));
      const __m128i low = _mm_set1_epi16(255);
      eight_lanes(_mm_packus_epi16(_mm_and_si128(early, low), _mm_and_si128(late, low)), steps_.data());
      eight_lanes(_mm_packus_epi16(_mm_srli_epi16(early, 8), _mm_srli_epi16(late, 8)), steps_.data() + 8);
    } else {
      eight_lanes(_mm_cvtsi64_si128(word(0)), steps_.data());
    }
    count_places();
  }
  /// Acceptances of the first so many lanes.
  MOTE_INLINE std::size_t count(std::size_t lanes) const {
    std::size_t all = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) all += static_cast<std::size_t>(std::popcount(steps_[lane]));
    return all;
  }
  /// The steps in which a lane accepted.
  MOTE_INLINE std::uint32_t steps(std::size_t lane) const { return steps_[lane]; }

  /// After step k a lane holds what the last step up to k in which it accepted offered, or what it held `before`.
  MOTE_INLINE Vector<R> held(std::size_t lane, const Vector<R>& offered, R before) const {
#if HWY_TARGET <= HWY_AVX3
    const auto* const places = reinterpret_cast<const __m128i*>(places_.data() + lane * kLanes);
    const auto values = offered.parts.r[0].raw;
    using Register = typename Registers<R>::Register;
    if constexpr (std::is_same_v<R, float>)
      return Vector<R>(Registers<R>{{Register{
          _mm512_permutex2var_ps(values, _mm512_cvtepi8_epi32(_mm_load_si128(places)), _mm512_set1_ps(before))}}});
    else
      return Vector<R>(Registers<R>{{Register{
          _mm512_permutex2var_pd(values, _mm512_cvtepi8_epi64(_mm_loadl_epi64(places)), _mm512_set1_pd(before))}}});
#else
    // register by register: the last offer of each, or what the one before ended with
    using Parts = Registers<R>;
    constexpr std::size_t kPer = Parts::kPerRegister;
    Vector<R> all;
    auto carried = hn::Set(typename Parts::Tag{}, before);
    for (std::size_t k = 0; k < Parts::kCount; ++k) {
      const auto& row = kLast[steps_[lane] >> (k * kPer) & ((1U << kPer) - 1)];
      const auto values = offered.parts.r[k].raw;
#if HWY_TARGET == HWY_AVX2
      const __m256i last = _mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row.data())));
      if constexpr (std::is_same_v<R, float>) {
        all.parts.r[k].raw =
            _mm256_blendv_ps(_mm256_permutevar8x32_ps(values, last), carried.raw, _mm256_castsi256_ps(last));
        carried.raw = _mm256_permutevar8x32_ps(all.parts.r[k].raw, _mm256_set1_epi32(7));
      } else {
        const __m256 moved = _mm256_permutevar8x32_ps(_mm256_castpd_ps(values), last);
        all.parts.r[k].raw = _mm256_blendv_pd(_mm256_castps_pd(moved), carried.raw, _mm256_castsi256_pd(last));
        carried.raw = _mm256_permute4x64_pd(all.parts.r[k].raw, 0xFF);
      }
#else
      const __m128i last = _mm_load_si128(reinterpret_cast<const __m128i*>(row.data()));
      const auto held_then = [&](__m128i offers, __m128i earlier) __attribute__((always_inline)) {
        return _mm_blendv_epi8(_mm_shuffle_epi8(offers, last), earlier, last);
      };
      if constexpr (std::is_same_v<R, float>) {
        const __m128i held = held_then(_mm_castps_si128(values), _mm_castps_si128(carried.raw));
        all.parts.r[k].raw = _mm_castsi128_ps(held);
        carried.raw = _mm_castsi128_ps(_mm_shuffle_epi32(held, 0xFF));
      } else {
        const __m128i held = held_then(_mm_castpd_si128(values), _mm_castpd_si128(carried.raw));
        all.parts.r[k].raw = _mm_castsi128_pd(held);
        carried.raw = _mm_castsi128_pd(_mm_shuffle_epi32(held, 0xEE));
      }
#endif
    }
    return all;
#endif
  }

 private:
#if HWY_TARGET <= HWY_AVX3
  /// The last accepting step up to each, -1 where there is none: running maxima of bytes, by shifts in eight of them.
  MOTE_INLINE void count_places() {
    constexpr std::size_t kAtOnce = 64 / kLanes;  // lanes
    for (std::size_t lane = 0; lane < kLanes; lane += kAtOnce) {
      std::uint64_t accepting = 0;
      for (std::size_t k = 0; k < kAtOnce; ++k) accepting |= std::uint64_t{steps_[lane + k]} << (k * kLanes);
      const __m512i step = kLanes == 16 ? _mm512_broadcast_i32x4(_mm_set_epi64x(0x100F0E0D0C0B0A09, 0x0807060504030201))
                                        : _mm512_set1_epi64(0x0807060504030201);  // counted from 1
      __m512i last = _mm512_maskz_mov_epi8(accepting, step);
      last = _mm512_max_epu8(last, _mm512_slli_epi64(last, 8));
      last = _mm512_max_epu8(last, _mm512_slli_epi64(last, 16));
      last = _mm512_max_epu8(last, _mm512_slli_epi64(last, 32));
      if constexpr (kLanes == 16) {
        const __m512i last_of_eight = _mm512_broadcast_i32x4(_mm_set_epi64x(0x0707070707070707, -1));
        last = _mm512_max_epu8(last, _mm512_shuffle_epi8(last, last_of_eight));
      }
      last = _mm512_sub_epi8(last, _mm512_set1_epi8(1));
      _mm512_store_si512(places_.data() + lane * kLanes, last);
    }
  }
  alignas(64) std::array<std::int8_t, kLanes * kLanes> places_;
#else
  void count_places() {}

  /// Where the last accepted offer of a register is after each step, by the steps in which it was accepted; negative
  /// where there is none. AVX2: by halves of eight bytes, which become words; SSE4: by bytes.
  static constexpr std::size_t kStepsAtOnce = Registers<R>::kPerRegister;
  static constexpr std::size_t kParts = (HWY_TARGET == HWY_AVX2 ? 8 : 16) / kStepsAtOnce;  // of an offer
  alignas(16) static constexpr auto kLast = [] {
    std::array<std::array<std::int8_t, kParts * kStepsAtOnce>, std::size_t{1} << kStepsAtOnce> all{};
    for (std::size_t steps = 0; steps < all.size(); ++steps) {
      int last = -1;
      for (std::size_t step = 0; step < kStepsAtOnce; ++step) {
        if ((steps >> step & 1U) != 0) last = static_cast<int>(step);
        for (std::size_t part = 0; part < kParts; ++part)
          all[steps][step * kParts + part] =
              static_cast<std::int8_t>(last < 0 ? -1 : last * static_cast<int>(kParts) + static_cast<int>(part));
      }
    }
    return all;
  }();
#endif

  std::array<std::uint32_t, kLanes> steps_;  // a bit each
};

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
