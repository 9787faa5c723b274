#pragma once
/// Parents along a curve: the particles in the order of Hilbert's curve (of value in one dimension), and for each child
/// the one whose share of the weight it falls upon.

#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "mote/filter/hilbert.hpp"
#include "mote/lanes/functions.hpp"
#include "mote/lanes/ready_draws.hpp"
#include "mote/software/simd/block_sums.hpp"
#include "mote/software/threads.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// hilbert_place() of cells, a vector of them at a time.
///
/// shape   cells: one column a dimension, 1 to 32 of them, `count` cells each, overwritten; D digits <= 32; places:
///         (count,), both filled up to whole vectors
[[gnu::flatten, gnu::noinline]] inline void hilbert_places(std::span<AlignedVector<std::uint32_t>> cells,
                                                           unsigned digits, std::size_t count, std::uint32_t* places) {
  namespace hn = lanes::hn;
  using Cells = lanes::Registers<std::uint32_t>;
  using Tag = Cells::Tag;
  const auto all = [](std::uint32_t value) { return hn::Set(Tag{}, value); };
  const std::uint32_t top = std::uint32_t{1} << (digits - 1);
  for (std::size_t j = 0; j < count; j += Cells::kPerRegister) {
    const auto load = [&](std::size_t d) { return hn::Load(Tag{}, cells[d].data() + j); };
    const auto store = [&](std::size_t d, auto c) { hn::Store(c, Tag{}, cells[d].data() + j); };
    auto first = load(0);
    for (std::uint32_t q = top; q > 1; q >>= 1U) {
      const auto high = [&](auto c) { return hn::VecFromMask(hn::TestBit(c, all(q))); };
      const auto below = all(q - 1);
      first = hn::Xor(first, hn::And(below, high(first)));
      for (std::size_t d = 1; d < cells.size(); ++d) {
        const auto c = load(d);
        const auto is_high = high(c);
        const auto swapped = hn::AndNot(is_high, hn::And(hn::Xor(first, c), below));
        first = hn::Xor(first, hn::Or(hn::And(below, is_high), swapped));
        store(d, hn::Xor(c, swapped));
      }
    }
    store(0, first);
    for (std::size_t d = 1; d < cells.size(); ++d) store(d, hn::Xor(load(d), load(d - 1)));
    const auto last = load(cells.size() - 1);
    auto turned = hn::Zero(Tag{});
    for (std::uint32_t q = top; q > 1; q >>= 1U)
      turned = hn::Xor(turned, hn::And(hn::VecFromMask(hn::TestBit(last, all(q))), all(q - 1)));
    auto place = hn::Zero(Tag{});
    for (std::uint32_t q = top; q > 0; q >>= 1U)
      for (std::size_t d = 0; d < cells.size(); ++d) {
        const auto bit = hn::VecFromMask(hn::TestBit(hn::Xor(load(d), turned), all(q)));
        place = hn::Sub(hn::Add(place, place), bit);  // a bit that is set is -1
      }
    hn::Store(place, Tag{}, places + j);
  }
}

/// Weighted particles of the SIMD engine: their weights are in the scales of their blocks.
template <class R>
struct WeightedBlocks {
  const Particles<R>& x;
  const R* weights;
  const BlockSums& sums;
  const Totals& totals;
};

/// Chooses the parents of SQMC: particles i_1, i_2, .. in order of place along the curve,
///
///   a^n = the first i_k with W^{i_1} + .. + W^{i_k} > (n + u) / N,   u uniform in (0, 1)
///
/// The place is place_particles()'s, in fewer digits: those of some 64 N cells, more in three dimensions or more.
/// Particles in one cell keep their order. Weights are rounded to units of 2^-51 of their sum, whose cumulative sums
/// are exact: parents do not depend on the number of threads.
///
/// shape   as many children as particles
/// cost    O(N): two passes of a radix sort, three from three dimensions on; memory (20 + sizeof(R)) N bytes
/// source  docs/filters.md (F36) to (F38)
template <class R>
class CurveParents {
 public:
  using V = lanes::Vector<R>;

  CurveParents(std::vector<Quantity> states, std::size_t particles)
      : states_(std::move(states)),
        passes_(states_.size() <= 2 ? 2 : 3),
        radix_bits_(std::clamp(static_cast<unsigned>(std::bit_width(particles)) / 2 + 3, 8U, 11U)),
        used_(std::min<std::size_t>(states_.size(), place_bits())),
        digits_(place_bits() / static_cast<unsigned>(used_)),
        chunks_((particles + kChunk - 1) / kChunk),
        entries_(particles + kSlack),
        sorted_(particles + kSlack),
        units_((particles + kBlock - 1) / kBlock * kBlock),
        sums_(chunks_ + 1),
        counts_(2 * chunks_ << radix_bits_),
        parents_(particles + kSlack) {}

  /// shape   moments: (D,), of the weighted particles, circular ones of angles; u in (0, 1)
  /// returns the parents of all children: (N,)
  std::span<const Index> choose(const WeightedBlocks<R>& from, std::span<const Moments> moments, double u, Crew& crew) {
    desks_.resize(std::max(desks_.size(), crew.shares(chunks_, kChunkBlocks)));
    each_chunk(crew, [&](std::size_t desk, std::size_t chunk) {
      for (std::size_t start = chunk * kChunk; start < end_of(chunk); start += kBlock)
        prepare(desks_[desk], from, moments, start, std::min(kBlock, size() - start));
    });
    for (unsigned pass = 0; pass < passes_; ++pass) sort_by_digit(crew, pass * radix_bits_);
    each_chunk(crew, [&](std::size_t, std::size_t chunk) { sums_[chunk + 1] = add_up(chunk); });
    for (std::size_t chunk = 0; chunk < chunks_; ++chunk) sums_[chunk + 1] += sums_[chunk];
    each_chunk(crew, [&](std::size_t desk, std::size_t chunk) { write_children(desks_[desk], chunk, u); });
    return {parents_.data(), size()};
  }

 private:
  static constexpr std::size_t kChunkBlocks = 16;  // of work that is shared out whole
  static constexpr std::size_t kChunk = kChunkBlocks * kBlock;
  static constexpr std::size_t kSlack = 8;  // parents that are written at a time
  static constexpr double kUnits = 0x1p51;  // of all weights: their sums fit into a double

  using Entry = std::uint64_t;  // place and, in the lower half, particle

  struct Desk {
    std::vector<AlignedVector<std::uint32_t>> cells;
    AlignedVector<std::uint32_t> places;
    AlignedVector<R> shares;
    std::array<std::int32_t, kBlock + kSlack> ends;
  };

  std::size_t size() const { return parents_.size() - kSlack; }
  std::size_t end_of(std::size_t chunk) const { return std::min(size(), (chunk + 1) * kChunk); }
  unsigned place_bits() const { return std::min(passes_ * radix_bits_, 32U); }

  template <class Work>
  void each_chunk(Crew& crew, const Work& work) const {
    crew.run(chunks_, kChunkBlocks, [&](std::size_t desk, std::size_t first, std::size_t last) {
      for (std::size_t chunk = first; chunk < last; ++chunk) work(desk, chunk);
    });
  }

  /// Places and weights of the particles of a block, the latter in units.
  void prepare(Desk& desk, const WeightedBlocks<R>& from, std::span<const Moments> moments, std::size_t start,
               std::size_t count) {
    const lanes::SubnormalsAreZero fast;
    desk.cells.resize(used_);
    for (auto& column : desk.cells) column.resize(kBlock);
    desk.places.resize(kBlock);
    desk.shares.resize(kBlock);
    for (std::size_t d = 0; d < used_; ++d)
      find_cells(from.x.component(d).data() + start, moments[d], states_[d].angle, count, desk.shares.data(),
                 desk.cells[d].data());
    const std::uint32_t* places = desk.cells[0].data();
    if (used_ > 1) {
      hilbert_places(desk.cells, digits_, count, desk.places.data());
      places = desk.places.data();
    }
    for (std::size_t j = 0; j < count; ++j) entries_[start + j] = Entry{places[j]} << 32U | (start + j);
    const auto scale =
        static_cast<R>(from.totals.scale_of(from.sums.shift(start / kBlock)) * (kUnits / from.totals.weight));
    for (std::size_t j = 0; j < count; ++j) units_[start + j] = from.weights[start + j] * scale;
  }

  /// Cells of a component by its logistic share of the side; 0 for what is not a number.
  [[gnu::flatten, gnu::noinline]] void find_cells(const R* x, const Moments& moments, bool angle, std::size_t count,
                                                  R* shares, std::uint32_t* cells) const {
    const V mean(moments.mean);
    const V steepness(-kPi / std::sqrt(3.0) / moments.sd);
    const V sides(std::ldexp(1.0, static_cast<int>(digits_)));
    const V last = sides - V(1);
    for (std::size_t j = 0; j < count; j += V::kLanes) {
      const V straight = V::load(x + j) - mean;
      const V difference = angle ? numbers::wrap(straight) : straight;
      const V cell = lanes::min(sides / (V(1) + lanes::exp(steepness * difference)), last);
      lanes::select(V(0) < cell, cell, V(0)).store(shares + j);
    }
    for (std::size_t j = 0; j < kBlock; ++j)
      cells[j] = static_cast<std::uint32_t>(static_cast<std::int32_t>(shares[j]));
  }

  /// One pass of the sort: the entries by radix_bits_ binary digits of their place, those with the same ones in the
  /// order they have.
  void sort_by_digit(Crew& crew, unsigned from_bit) {
    const std::size_t tables = counts_.size() >> radix_bits_;
    each_chunk(crew, [&](std::size_t, std::size_t chunk) { count(chunk, 32 + from_bit); });
    std::uint32_t sum = 0;
    for (std::size_t value = 0; value < std::size_t{1} << radix_bits_; ++value)
      for (std::size_t table = 0; table < tables; ++table)
        sum += std::exchange(counts_[(table << radix_bits_) + value], sum);
    each_chunk(crew, [&](std::size_t, std::size_t chunk) { scatter(chunk, 32 + from_bit); });
    entries_.swap(sorted_);
  }

  /// Calls visit(table, entry) for a chunk's entries: those of its first half with one table of counts and those of the
  /// second with another, in turns. A processor that has seen a count written and read again at once lets every later
  /// reading of it wait for the writing before.
  template <class Visit>
  MOTE_INLINE void each_entry(std::size_t chunk, const Visit& visit) {
    const Entry* const entries = entries_.data();
    std::uint32_t* const first = counts_.data() + (2 * chunk << radix_bits_);
    std::uint32_t* const second = first + (std::size_t{1} << radix_bits_);
    const std::size_t begin = chunk * kChunk;
    const std::size_t half = (end_of(chunk) - begin) / 2;
    for (std::size_t k = begin; k < begin + half; ++k) {
      visit(first, entries[k]);
      visit(second, entries[k + half]);
    }
    if (begin + 2 * half < end_of(chunk)) visit(second, entries[begin + 2 * half]);
  }

  /// How many entries of a chunk have each digit.
  void count(std::size_t chunk, unsigned shift) {
    const Entry mask = (Entry{1} << radix_bits_) - 1;
    std::fill_n(counts_.data() + (2 * chunk << radix_bits_), 2 * (mask + 1), 0U);
    each_entry(
        chunk, [=](std::uint32_t * counts, Entry entry)
                   __attribute__((always_inline)) { ++counts[entry >> shift & mask]; });
  }

  void scatter(std::size_t chunk, unsigned shift) {
    const Entry mask = (Entry{1} << radix_bits_) - 1;
    each_entry(
        chunk, [ =, sorted = sorted_.data() ](std::uint32_t * next, Entry entry)
                   __attribute__((always_inline)) { sorted[next[entry >> shift & mask]++] = entry; });
  }

  /// Cumulative units of a chunk of the ordered particles, in sorted_; all of them.
  std::uint64_t add_up(std::size_t chunk) {
    std::int64_t sum = 0;
    const Entry* const entries = entries_.data();
    const R* const units = units_.data();
    Entry* const sums = sorted_.data();
    const std::size_t end = end_of(chunk);
    for (std::size_t k = chunk * kChunk; k < end; ++k) {
      sum += static_cast<std::int64_t>(units[static_cast<Index>(entries[k])]);
      sums[k] = static_cast<Entry>(sum);
    }
    return static_cast<std::uint64_t>(sum);
  }

  /// Writes the children of a chunk of the ordered particles.
  void write_children(Desk& desk, std::size_t chunk, double u) {
    const double per_unit = static_cast<double>(size()) / static_cast<double>(sums_[chunks_]);
    const auto past = [&](double sum) { return std::min(std::ceil(sum * per_unit - u), static_cast<double>(size())); };
    auto begin = static_cast<std::size_t>(past(static_cast<double>(sums_[chunk])));
    const auto last = static_cast<std::size_t>(past(static_cast<double>(sums_[chunk + 1])));
    Index* const parents = parents_.data();
    for (std::size_t start = chunk * kChunk; start < end_of(chunk); start += kBlock) {
      const std::size_t count = std::min(kBlock, size() - start);
      find_ends(sums_[chunk], per_unit, u, start, count, desk.ends.data());
      const Entry* const entries = entries_.data() + start;
      std::size_t k = 0;
      // a few at once, whether there are so many or not: what is too much is written over
      for (; k < count && begin + kSlack <= last; ++k) {
        const auto i = static_cast<Index>(entries[k]);
        const auto end = static_cast<std::size_t>(desk.ends[k]);
        std::fill_n(parents + begin, kSlack, i);
        if (end > begin + kSlack) std::fill(parents + begin + kSlack, parents + end, i);
        begin = end;
      }
      for (; k < count; ++k) {
        const auto end = static_cast<std::size_t>(desk.ends[k]);
        std::fill(parents + begin, parents + end, static_cast<Index>(entries[k]));
        begin = end;
      }
    }
  }

  /// One past the last child of each of `count` ordered particles.
  [[gnu::flatten, gnu::noinline]] void find_ends(std::uint64_t before, double per_unit, double u, std::size_t start,
                                                 std::size_t count, std::int32_t* ends) const {
    namespace hn = lanes::hn;
    using Words = lanes::Registers<std::uint64_t>;
    using Numbers = lanes::Registers<double>;
    const Numbers::Tag number;
    // a whole number below 2^52 as the lowest bits of one in [2^52, 2^53)
    const auto exponent = hn::Set(Words::Tag{}, 0x4330000000000000U);
    const auto less = hn::Set(number, 0x1p52);
    const auto earlier = hn::Set(Words::Tag{}, before);
    const auto children = hn::Set(number, per_unit);
    const auto offset = hn::Set(number, u);
    const auto most = hn::Set(number, static_cast<double>(size()));
    const hn::Rebind<std::int32_t, Numbers::Tag> whole;
    for (std::size_t j = 0; j < count; j += Numbers::kPerRegister) {
      const auto sum = hn::Add(hn::LoadU(Words::Tag{}, sorted_.data() + start + j), earlier);
      const auto units = hn::Sub(hn::BitCast(number, hn::Or(sum, exponent)), less);
      const auto position = hn::Min(hn::Ceil(hn::Sub(hn::Mul(units, children), offset)), most);
      hn::StoreU(hn::DemoteTo(whole, position), whole, ends + j);
    }
  }

  std::vector<Quantity> states_;
  unsigned passes_, radix_bits_;
  std::size_t used_;  // components that the curve runs through
  unsigned digits_;   // of each
  std::size_t chunks_;
  std::vector<Entry> entries_, sorted_;
  AlignedVector<R> units_;             // by particle, not yet rounded
  std::vector<std::uint64_t> sums_;    // of units before each chunk of the ordered particles; then all
  std::vector<std::uint32_t> counts_;  // by chunk and digit
  std::vector<Desk> desks_;
  std::vector<Index> parents_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote
