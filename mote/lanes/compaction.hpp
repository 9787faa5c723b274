#pragma once
/// Lanes moved together where a comparison holds, and repeated where marks say so: lists made shorter and longer,
/// register by register.

#include "mote/lanes/running.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

namespace detail {

/// A table of permutations by bits: number k of entry[b] is source(b, k), in kBytes bytes, as the indices of its bytes
/// where kBytes is above 1.
template <class Entry, std::size_t kNumbers, std::size_t kBytes, class Source>
constexpr auto permutations(const Source& source) {
  std::array<Entry, std::size_t{1} << kNumbers> table{};
  for (std::size_t b = 0; b < table.size(); ++b)
    for (std::size_t k = 0; k < kNumbers; ++k)
      for (std::size_t byte = 0; byte < kBytes; ++byte)
        table[b][k * kBytes + byte] = static_cast<std::uint8_t>(kBytes * source(b, k) + byte);
  return table;
}
/// How many of the bits 0..k of b are set.
constexpr std::size_t running_count(std::size_t b, std::size_t k) {
  return static_cast<std::size_t>(std::popcount(b & ((std::size_t{2} << k) - 1)));
}
/// The place of the set bit number k of b, counted from 0; 0 if there are fewer.
constexpr std::size_t place_of(std::size_t b, std::size_t k) {
  for (; k > 0; --k) b &= b - 1;
  return b == 0 ? 0 : static_cast<std::size_t>(std::countr_zero(b));
}

}  // namespace detail

/// Bit k: the highest bit of byte k.
///
/// shape   flags: (64,), aligned to 64 bytes
MOTE_INLINE std::uint64_t marks_of(const std::uint8_t* flags) {
  using Bytes = Registers<std::uint8_t>;
  const Bytes::Tag tag;
  std::uint64_t marks = 0;
  unrolled<Bytes::kCount>([&](std::size_t k) __attribute__((always_inline)) {
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(tag, hn::MaskFromVec(hn::Load(tag, flags + k * Bytes::kPerRegister)), bits.data());
    marks |= std::bit_cast<std::uint64_t>(bits) << (k * Bytes::kPerRegister);
  });
  return marks;
}

#if HWY_TARGET <= HWY_AVX3

/// The lanes for which a comparison of whole numbers holds, moved together to the front; the others hold anything.
template <class R>
class Keeper {
 public:
  explicit MOTE_INLINE Keeper(const hn::Mask<WholeTag<R>>& holds) : bits_(holds.raw) {}

  /// How many there are.
  MOTE_INLINE std::size_t count() const { return static_cast<std::size_t>(std::popcount(std::uint32_t{bits_})); }

  MOTE_INLINE NumberRegister<R> operator()(NumberRegister<R> v) const {
    if constexpr (std::is_same_v<R, float>)
      return {_mm512_maskz_compress_ps(bits_, v.raw)};
    else
      return {_mm512_maskz_compress_pd(bits_, v.raw)};
  }
  MOTE_INLINE WholeRegister<R> operator()(WholeRegister<R> v) const {
    return hn::BitCast(WholeTag<R>{}, (*this)(hn::BitCast(typename Registers<R>::Tag{}, v)));
  }

 private:
  std::conditional_t<std::is_same_v<R, float>, __mmask16, __mmask8> bits_;
};

/// A register in which values are repeated: lane k holds values[number of marks among bits 1..k], bit 0 counting for
/// nothing.
template <class R>
class Repeater {
 public:
  static constexpr std::size_t kLanes = Registers<R>::kPerRegister;

  /// marks: bits at and beyond kLanes are ignored.
  explicit MOTE_INLINE Repeater(std::uint64_t marks) : index_(index_of(static_cast<std::uint32_t>(marks) & kLater)) {}

  /// shape   values: (kLanes,), at any address
  MOTE_INLINE NumberRegister<R> operator()(const R* values) const {
    const auto v = hn::LoadU(typename Registers<R>::Tag{}, values);
    if constexpr (std::is_same_v<R, float>)
      return {_mm512_permutexvar_ps(index_, v.raw)};
    else
      return {_mm512_permutexvar_pd(index_, v.raw)};
  }

 private:
  static constexpr std::uint32_t kLater = ((1U << kLanes) - 1) & ~1U;

  static MOTE_INLINE __m512i index_of(std::uint32_t later) {
    using Counts = std::array<std::uint8_t, 8>;
    static constexpr auto kCounts = detail::permutations<Counts, 8, 1>(detail::running_count);
    const auto low = std::bit_cast<std::uint64_t>(kCounts[later & 255U]);
    if constexpr (std::is_same_v<R, double>) {
      return _mm512_cvtepu8_epi64(_mm_cvtsi64_si128(static_cast<long long>(low)));
    } else {
#ifdef __AVX512VPOPCNTDQ__
      const __m512i up_to = _mm512_set_epi32(0xFFFF, 0x7FFF, 0x3FFF, 0x1FFF, 0xFFF, 0x7FF, 0x3FF, 0x1FF, 0xFF, 0x7F,
                                             0x3F, 0x1F, 0xF, 7, 3, 1);
      return _mm512_popcnt_epi32(_mm512_and_si512(_mm512_set1_epi32(static_cast<int>(later)), up_to));
#else
      const std::uint64_t high =
          std::bit_cast<std::uint64_t>(kCounts[later >> 8U]) + (low >> 56U) * 0x0101010101010101ULL;
      return _mm512_cvtepu8_epi32(_mm_set_epi64x(static_cast<long long>(high), static_cast<long long>(low)));
#endif
    }
  }

  __m512i index_;
};

#else

/// A permutation of the lanes of a register, from a table of kBytes[0..2^lanes).
template <class R>
class Permutation {
 public:
  static constexpr std::size_t kLanes = Registers<R>::kPerRegister;
#if HWY_TARGET == HWY_AVX2
  using Entry = std::array<std::uint8_t, 8>;  // 32-bit pieces: two of them make a double
  static constexpr std::size_t kBytes = 8 / kLanes;

  explicit MOTE_INLINE Permutation(const Entry& entry)
      : index_(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(entry.data())))) {}
  MOTE_INLINE NumberRegister<R> operator()(NumberRegister<R> v) const {
    if constexpr (std::is_same_v<R, float>)
      return {_mm256_permutevar8x32_ps(v.raw, index_)};
    else
      return {_mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(v.raw), index_))};
  }

 private:
  __m256i index_;
#else
  struct alignas(16) Entry : std::array<std::uint8_t, 16> {};
  static constexpr std::size_t kBytes = 16 / kLanes;

  explicit MOTE_INLINE Permutation(const Entry& entry)
      : index_(_mm_load_si128(reinterpret_cast<const __m128i*>(entry.data()))) {}
  MOTE_INLINE NumberRegister<R> operator()(NumberRegister<R> v) const {
    if constexpr (std::is_same_v<R, float>)
      return {_mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(v.raw), index_))};
    else
      return {_mm_castsi128_pd(_mm_shuffle_epi8(_mm_castpd_si128(v.raw), index_))};
  }

 private:
  __m128i index_;
#endif
};

/// As above, by a table of permutations.
template <class R>
class Keeper {
 public:
  explicit MOTE_INLINE Keeper(const hn::Mask<WholeTag<R>>& holds) : bits_(bits_of(holds)), permuted_(kTable[bits_]) {}

  MOTE_INLINE std::size_t count() const { return static_cast<std::size_t>(std::popcount(bits_)); }

  MOTE_INLINE NumberRegister<R> operator()(NumberRegister<R> v) const { return permuted_(v); }
  MOTE_INLINE WholeRegister<R> operator()(WholeRegister<R> v) const {
    return hn::BitCast(WholeTag<R>{}, permuted_(hn::BitCast(typename Registers<R>::Tag{}, v)));
  }

 private:
  static MOTE_INLINE std::uint32_t bits_of(const hn::Mask<WholeTag<R>>& holds) {
    const auto sign = hn::BitCast(typename Registers<R>::Tag{}, hn::VecFromMask(WholeTag<R>{}, holds));
#if HWY_TARGET == HWY_AVX2
    if constexpr (std::is_same_v<R, float>)
      return static_cast<std::uint32_t>(_mm256_movemask_ps(sign.raw));
    else
      return static_cast<std::uint32_t>(_mm256_movemask_pd(sign.raw));
#else
    if constexpr (std::is_same_v<R, float>)
      return static_cast<std::uint32_t>(_mm_movemask_ps(sign.raw));
    else
      return static_cast<std::uint32_t>(_mm_movemask_pd(sign.raw));
#endif
  }

  using P = Permutation<R>;
  static constexpr auto kTable = detail::permutations<typename P::Entry, P::kLanes, P::kBytes>(detail::place_of);
  std::uint32_t bits_;
  P permuted_;
};

/// As above, by a table of permutations.
template <class R>
class Repeater {
 public:
  static constexpr std::size_t kLanes = Registers<R>::kPerRegister;

  explicit MOTE_INLINE Repeater(std::uint64_t marks) : permuted_(kTable[marks & kLater]) {}

  MOTE_INLINE NumberRegister<R> operator()(const R* values) const {
    return permuted_(hn::LoadU(typename Registers<R>::Tag{}, values));
  }

 private:
  static constexpr std::uint32_t kLater = ((1U << kLanes) - 1) & ~1U;

  using P = Permutation<R>;
  static constexpr auto kTable = detail::permutations<typename P::Entry, P::kLanes, P::kBytes>(detail::running_count);
  P permuted_;
};

#endif

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
