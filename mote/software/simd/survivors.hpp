#pragma once
/// Systematic resampling as a stream: blocks of weights in, blocks of children out, no ancestor indices, no gather.
///
/// Children are ordered like their ancestors. A scan of a block of weights gives the first child of each surviving
/// particle; survivors are kept in order in a short list; a block of children is written by running along that list.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "mote/filter/particles.hpp"
#include "mote/software/simd/block_pass.hpp"

namespace mote {

inline namespace HWY_NAMESPACE {

namespace detail {

/// counts[b] holds, byte by byte, how many of the bits 0..k of b are set, k = 0..7.
inline constexpr std::array<std::uint64_t, 256> kRunningCounts = [] {
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t b = 0; b < 256; ++b)
    for (std::uint64_t k = 0; k < 8; ++k)
      table[b] |= static_cast<std::uint64_t>(std::popcount(b & ((2ULL << k) - 1))) << (8 * k);
  return table;
}();

}  // namespace detail

/// The survivors between the weights read and the children written.
///
/// cost    memory: five blocks of particles
template <class R, std::size_t kD>
class SurvivorStream {
 public:
  explicit SurvivorStream(std::size_t dimensions)
      : columns_(column_pointers<const R, kD>(dimensions)),
        starts_(kCapacity + kSlack),
        storage_(dimensions),
        values_(column_pointers<R, kD>(dimensions)),
        flags_(kBlock + kSlack) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      storage_[d].resize(kCapacity + kSlack);
      values_[d] = storage_[d].data();
    }
  }

  /// Prepares for children from `child` on of the particles x, whose weights are in the scales of their blocks.
  void begin(const ChildMap& map, const Particles<R>& x, const R* weights, std::uint32_t child) {
    map_ = &map;
    for (std::size_t d = 0; d < columns_.size(); ++d) columns_[d] = x.component(d).data();
    weights_ = weights;
    particles_ = x.size();
    next_block_ = map.block_of(child);
    size_ = 0;
    at_ = 0;
  }

  /// Writes children [from, from + count) by component; calls come in order, count at most a block.
  void write(std::uint32_t from, std::size_t count, const ColumnPointers<R, kD>& to) {
    const auto end = from + static_cast<std::uint32_t>(count);
    while (map_->first[next_block_] < end) {
      make_room();
      scan(next_block_++);
    }
    // the last survivor that begins at or before `from` fills up what comes before the next one
    while (at_ + 1 < size_ && starts_[at_ + 1] <= from) ++at_;
    flag(from, end);
    expand(count, to);
  }

 private:
  static constexpr std::size_t kCapacity = 4 * kBlock;
  static constexpr std::size_t kSlack = 64;  // room for whole vectors beyond the end

  void make_room() {
    if (size_ + kBlock <= kCapacity) return;
    const std::size_t rest = size_ - at_;
    std::memmove(starts_.data(), starts_.data() + at_, rest * sizeof(std::uint32_t));
    for (R* const column : values_) std::memmove(column, column + at_, rest * sizeof(R));
    size_ = rest;
    at_ = 0;
  }

  /// Appends the survivors of a block, each with its first child.
  void scan(std::size_t block) {
    const std::uint32_t first = map_->first[block];
    const std::uint32_t end = map_->first[block + 1];
    if (first == end) return;
    const std::size_t start = block * kBlock;
    const std::size_t n = std::min(kBlock, particles_ - start);
    const std::size_t before = size_;
    append(block, start, n, first, end);
    if (size_ == before) {  // rounding hid the block's only children
      const auto heaviest =
          static_cast<std::size_t>(std::max_element(weights_ + start, weights_ + start + n) - weights_);
      keep(heaviest, first);
    }
    starts_[before] = first;  // nor may it hide the first of them
  }

  void keep(std::size_t particle, std::uint32_t first_child) {
    starts_[size_] = first_child;
    for (std::size_t d = 0; d < values_.size(); ++d) values_[d][size_] = columns_[d][particle];
    ++size_;
  }

#if HWY_TARGET <= HWY_AVX3
  static constexpr std::size_t kLanes = lanes::kWidth<R>;
  using Whole = std::conditional_t<std::is_same_v<R, float>, __m512i, __m256i>;

  /// Asks for what the next block's scan reads from j on.
  MOTE_INLINE void fetch_ahead(std::size_t j) const {
    lanes::prefetch(weights_ + j + kBlock);
    for (std::size_t d = 0; d < columns_.size(); ++d) lanes::prefetch(columns_[d] + j + kBlock);
  }

  /// Inclusive sums along the lanes.
  static MOTE_INLINE auto prefix(const R* from) {
    const __m512i zero = _mm512_setzero_si512();
    if constexpr (std::is_same_v<R, float>) {
      __m512 v = _mm512_load_ps(from);
      const auto shifted = [&](auto count) {
        return _mm512_castsi512_ps(_mm512_alignr_epi32(_mm512_castps_si512(v), zero, 16 - decltype(count)::value));
      };
      v = _mm512_add_ps(v, shifted(std::integral_constant<int, 1>()));
      v = _mm512_add_ps(v, shifted(std::integral_constant<int, 2>()));
      v = _mm512_add_ps(v, shifted(std::integral_constant<int, 4>()));
      return _mm512_add_ps(v, shifted(std::integral_constant<int, 8>()));
    } else {
      __m512d v = _mm512_load_pd(from);
      const auto shifted = [&](auto count) {
        return _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(v), zero, 8 - decltype(count)::value));
      };
      v = _mm512_add_pd(v, shifted(std::integral_constant<int, 1>()));
      v = _mm512_add_pd(v, shifted(std::integral_constant<int, 2>()));
      return _mm512_add_pd(v, shifted(std::integral_constant<int, 4>()));
    }
  }

  // One past the last child of each particle is ceil(position of the cumulative weight); a particle survives if that is
  // more than its predecessor's.
  void append(std::size_t block, std::size_t start, std::size_t n, std::uint32_t first, std::uint32_t end) {
    const double whole = std::floor(map_->position[block]);
    const auto scale = static_cast<R>(map_->children_per_weight[block]);
    const auto rest = static_cast<R>(map_->position[block] - whole);
    const auto base = static_cast<int>(whole);
    const auto columns = columns_;
    const auto values = values_;
    const R* const weights = weights_;
    std::uint32_t* const starts = starts_.data();
    if constexpr (std::is_same_v<R, float>) {
      const __m512 vector_scale = _mm512_set1_ps(scale);
      const __m512 vector_rest = _mm512_set1_ps(rest);
      const __m512i vector_base = _mm512_set1_epi32(base);
      const __m512i last = _mm512_set1_epi32(static_cast<int>(end));
      const __m512i top = _mm512_set1_epi32(15);
      __m512i previous = _mm512_set1_epi32(static_cast<int>(first));
      __m512 carry = _mm512_setzero_ps();
      std::size_t size = size_;
      for (std::size_t j = start; j < start + n; j += 16) {
        fetch_ahead(j);
        const __m512 sums = prefix(weights + j);
        const __m512 through = _mm512_add_ps(sums, carry);
        carry = _mm512_add_ps(carry, _mm512_permutexvar_ps(top, sums));
        const __m512i past = _mm512_min_epi32(
            last,
            _mm512_add_epi32(vector_base, _mm512_cvt_roundps_epi32(_mm512_fmadd_ps(through, vector_scale, vector_rest),
                                                                   _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC)));
        const __m512i child = _mm512_alignr_epi32(past, previous, 15);
        if (__builtin_expect(_mm512_cmplt_epi32_mask(past, child) != 0, 0)) {
          size_ = size;
          previous = _mm512_set1_epi32(append_unordered(past, child, j));
          size = size_;
          continue;
        }
        const __m512i bits = _mm512_castps_si512(_mm512_load_ps(weights + j));
        const __mmask16 survives = _mm512_mask_cmplt_epi32_mask(_mm512_test_epi32_mask(bits, bits), child, past);
        _mm512_storeu_si512(starts + size, _mm512_maskz_compress_epi32(survives, child));
        for (std::size_t d = 0; d < values.size(); ++d)
          _mm512_storeu_ps(values[d] + size, _mm512_maskz_compress_ps(survives, _mm512_load_ps(columns[d] + j)));
        size += static_cast<std::size_t>(__builtin_popcount(survives));
        previous = past;
      }
      size_ = size;
    } else {
      const __m512d vector_scale = _mm512_set1_pd(scale);
      const __m512d vector_rest = _mm512_set1_pd(rest);
      const __m256i vector_base = _mm256_set1_epi32(base);
      const __m256i last = _mm256_set1_epi32(static_cast<int>(end));
      const __m512i top = _mm512_set1_epi64(7);
      __m256i previous = _mm256_set1_epi32(static_cast<int>(first));
      __m512d carry = _mm512_setzero_pd();
      std::size_t size = size_;
      for (std::size_t j = start; j < start + n; j += 8) {
        fetch_ahead(j);
        const __m512d sums = prefix(weights + j);
        const __m512d through = _mm512_add_pd(sums, carry);
        carry = _mm512_add_pd(carry, _mm512_permutexvar_pd(top, sums));
        const __m256i past = _mm256_min_epi32(
            last,
            _mm256_add_epi32(vector_base, _mm512_cvt_roundpd_epi32(_mm512_fmadd_pd(through, vector_scale, vector_rest),
                                                                   _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC)));
        const __m256i child = _mm256_alignr_epi32(past, previous, 7);
        if (__builtin_expect(_mm256_cmplt_epi32_mask(past, child) != 0, 0)) {
          size_ = size;
          previous = _mm256_set1_epi32(append_unordered(past, child, j));
          size = size_;
          continue;
        }
        const __m512i bits = _mm512_castpd_si512(_mm512_load_pd(weights + j));
        const __mmask8 survives = _mm256_mask_cmplt_epi32_mask(_mm512_test_epi64_mask(bits, bits), child, past);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(starts + size), _mm256_maskz_compress_epi32(survives, child));
        for (std::size_t d = 0; d < values.size(); ++d)
          _mm512_storeu_pd(values[d] + size, _mm512_maskz_compress_pd(survives, _mm512_load_pd(columns[d] + j)));
        size += static_cast<std::size_t>(__builtin_popcount(survives));
        previous = past;
      }
      size_ = size;
    }
  }

  /// The rare vector whose cumulative sums step back by a rounding: one by one, held monotone. Returns one past its
  /// last child.
  [[gnu::noinline]] int append_unordered(Whole past, Whole child, std::size_t j) {
    std::array<int, kLanes> ends{};
    std::array<int, kLanes> begins{};
    std::memcpy(ends.data(), &past, sizeof ends);
    std::memcpy(begins.data(), &child, sizeof begins);
    int reached = begins[0];
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (ends[i] > reached && weights_[j + i] > 0) keep(j + i, static_cast<std::uint32_t>(reached));
      reached = std::max(reached, ends[i]);
    }
    return reached;
  }

  void expand(std::size_t count, const ColumnPointers<R, kD>& to_columns) {
    const auto values = values_;
    const auto to = to_columns;
    std::uint8_t* const all_flags = flags_.data();
    std::size_t at = at_;
    for (std::size_t out = 0; out < count; out += 64) {
      const __m512i flags = _mm512_load_si512(all_flags + out);
      _mm512_store_si512(all_flags + out, _mm512_setzero_si512());
      std::uint64_t marks = _mm512_movepi8_mask(flags);
      for (std::size_t v = 0; v < 64 && out + v < count; v += kLanes) {
        // child k continues survivor at + (marks among the first k + 1); a mark on the first child moves the load
        const auto mark = static_cast<std::uint32_t>(marks) & ((1U << kLanes) - 1);
        marks = kLanes == 16 ? marks >> 16U : marks >> 8U;
        const std::size_t from = at + (mark & 1U);
        const std::uint32_t later = mark & ~1U;
        const std::uint64_t low = detail::kRunningCounts[later & 255U];
        if constexpr (std::is_same_v<R, float>) {
#ifdef __AVX512VPOPCNTDQ__
          const __m512i up_to = _mm512_set_epi32(0xFFFF, 0x7FFF, 0x3FFF, 0x1FFF, 0xFFF, 0x7FF, 0x3FF, 0x1FF, 0xFF, 0x7F,
                                                 0x3F, 0x1F, 0xF, 7, 3, 1);
          const __m512i index =
              _mm512_popcnt_epi32(_mm512_and_si512(_mm512_set1_epi32(static_cast<int>(later)), up_to));
#else
          const std::uint64_t high = detail::kRunningCounts[later >> 8U] + (low >> 56U) * 0x0101010101010101ULL;
          const __m512i index =
              _mm512_cvtepu8_epi32(_mm_set_epi64x(static_cast<long long>(high), static_cast<long long>(low)));
#endif
          for (std::size_t d = 0; d < to.size(); ++d)
            _mm512_store_ps(to[d] + out + v, _mm512_permutexvar_ps(index, _mm512_loadu_ps(values[d] + from)));
        } else {
          const __m512i index = _mm512_cvtepu8_epi64(_mm_cvtsi64_si128(static_cast<long long>(low)));
          for (std::size_t d = 0; d < to.size(); ++d)
            _mm512_store_pd(to[d] + out + v, _mm512_permutexvar_pd(index, _mm512_loadu_pd(values[d] + from)));
        }
        at += static_cast<std::size_t>(__builtin_popcount(mark));
      }
    }
    at_ = at;
  }
#else
  void append(std::size_t block, std::size_t start, std::size_t n, std::uint32_t first, std::uint32_t end) {
    const double position = map_->position[block];
    const double scale = map_->children_per_weight[block];
    double through = 0;
    std::uint32_t reached = first;
    for (std::size_t i = start; i < start + n && reached < end; ++i) {
      through += static_cast<double>(weights_[i]);
      const auto past = std::min(end, static_cast<std::uint32_t>(std::max(0.0, std::ceil(position + through * scale))));
      if (past <= reached || !(weights_[i] > 0)) continue;
      keep(i, reached);
      reached = past;
    }
  }

  void expand(std::size_t count, const ColumnPointers<R, kD>& to_columns) {
    std::size_t at = at_;
    for (std::size_t d = 0; d < to_columns.size(); ++d) {
      at = at_;
      for (std::size_t k = 0; k < count; ++k) {
        at += flags_[k] != 0 ? 1 : 0;
        to_columns[d][k] = values_[d][at];
      }
    }
    at_ = at;
    std::memset(flags_.data(), 0, count);
  }
#endif

  /// Marks the first children in [from, end) of the survivors after at_.
  void flag(std::uint32_t from, std::uint32_t end) {
    const std::uint32_t* const starts = starts_.data();
    std::uint8_t* const flags = flags_.data();
    const std::uint32_t* const stop = std::lower_bound(starts + at_ + 1, starts + size_, end);
    const std::uint32_t* s = starts + at_ + 1;
    for (; s + 4 <= stop; s += 4) {
      flags[s[0] - from] = 0xFF;
      flags[s[1] - from] = 0xFF;
      flags[s[2] - from] = 0xFF;
      flags[s[3] - from] = 0xFF;
    }
    for (; s < stop; ++s) flags[*s - from] = 0xFF;
  }

  const ChildMap* map_ = nullptr;
  ColumnPointers<const R, kD> columns_;
  const R* weights_ = nullptr;
  std::size_t particles_ = 0;
  std::size_t next_block_ = 0;  // the next block of weights to scan
  AlignedVector<std::uint32_t> starts_;
  std::vector<AlignedVector<R>> storage_;
  ColumnPointers<R, kD> values_;
  AlignedVector<std::uint8_t> flags_;
  std::size_t size_ = 0;  // survivors in the list
  std::size_t at_ = 0;    // the one whose children are being written
};

}  // namespace HWY_NAMESPACE
}  // namespace mote
