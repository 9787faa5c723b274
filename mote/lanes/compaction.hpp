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

/// A register in which values are repeated: lane k holds values[number of marks among lanes 1..k].
template <class R>
class Repeater {
 public:
  /// How many marks there are up to each lane, a byte for each, the first lane's aside.
  explicit MOTE_INLINE Repeater(const std::uint8_t* counts) {
    const auto* const bytes = reinterpret_cast<const __m128i*>(counts);
    if constexpr (std::is_same_v<R, float>)
      places_ = _mm512_cvtepu8_epi32(_mm_load_si128(bytes));
    else
      places_ = _mm512_cvtepu8_epi64(_mm_loadl_epi64(bytes));
  }

  /// shape   values: (kLanes,), at any address
  MOTE_INLINE NumberRegister<R> operator()(const R* values) const {
    const auto v = hn::LoadU(typename Registers<R>::Tag{}, values);
    if constexpr (std::is_same_v<R, float>)
      return {_mm512_permutexvar_ps(places_, v.raw)};
    else
      return {_mm512_permutexvar_pd(places_, v.raw)};
  }

 private:
  __m512i places_;
};

/// Marks of 64 lanes, counted up to each: running sums of bytes, by shifts in eight of them.
template <class R>
class MarkCounts {
 public:
  MOTE_INLINE MarkCounts(const std::uint8_t* flags, std::uint64_t) {
    constexpr long long kLater = 0x0101010101010100;  // of eight lanes; and then eight more of a float's register
    constexpr long long kMore = sizeof(R) == 4 ? kLater | 1 : kLater;
    const __m512i later = _mm512_set_epi64(kMore, kLater, kMore, kLater, kMore, kLater, kMore, kLater);
    __m512i counts = _mm512_and_si512(_mm512_load_si512(flags), later);
    counts = _mm512_add_epi8(counts, _mm512_slli_epi64(counts, 8));
    counts = _mm512_add_epi8(counts, _mm512_slli_epi64(counts, 16));
    counts = _mm512_add_epi8(counts, _mm512_slli_epi64(counts, 32));
    if constexpr (sizeof(R) == 4) {
      const __m512i last_of_eight = _mm512_broadcast_i32x4(_mm_set_epi64x(0x0707070707070707, -1));
      counts = _mm512_add_epi8(counts, _mm512_shuffle_epi8(counts, last_of_eight));
    }
    _mm512_store_si512(counts_.data(), counts);
  }
  MOTE_INLINE Repeater<R> repeater(std::size_t lane) const { return Repeater<R>(counts_.data() + lane); }

 private:
  alignas(64) std::array<std::uint8_t, 64> counts_;
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

/// As above, by a table of permutations; from the marks of its lanes, those beyond them aside.
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

/// Marks of 64 lanes.
template <class R>
class MarkCounts {
 public:
  MOTE_INLINE MarkCounts(const std::uint8_t*, std::uint64_t marks) : marks_(marks) {}
  MOTE_INLINE Repeater<R> repeater(std::size_t lane) const { return Repeater<R>(marks_ >> lane); }

 private:
  std::uint64_t marks_;
};

#endif

/// Values repeated over 64 lanes, register by register: a flagged lane begins the next value.
template <class R>
class Repeats {
 public:
  static constexpr std::size_t kLanes = Registers<R>::kPerRegister;

  /// shape   flags: (64,), 0 or 255, aligned to 64 bytes
  explicit MOTE_INLINE Repeats(const std::uint8_t* flags) : marks_(marks_of(flags)), counts_(flags, marks_) {}

  /// Whether the register from `lane` on begins with the next value, so that its values are to be read from there.
  MOTE_INLINE std::size_t begins(std::size_t lane) const { return marks_ >> lane & 1U; }
  /// How many values begin in that register.
  MOTE_INLINE std::size_t count(std::size_t lane) const {
    return static_cast<std::size_t>(std::popcount(marks_ >> lane & ((std::uint64_t{1} << kLanes) - 1)));
  }
  MOTE_INLINE Repeater<R> repeater(std::size_t lane) const { return counts_.repeater(lane); }

 private:
  std::uint64_t marks_;
  MarkCounts<R> counts_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
