#pragma once
/// Systematic resampling as a stream: blocks of weights in, blocks of children out, no ancestor indices, no gather.
///
/// Children are ordered like their ancestors. A scan of a block of weights gives the first child of each surviving
/// particle; survivors are kept in order in a short list; a block of children is written by running along that list.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "mote/filter/particles.hpp"
#include "mote/lanes/compaction.hpp"
#include "mote/software/simd/block_pass.hpp"

namespace mote {

inline namespace HWY_NAMESPACE {

namespace hn = lanes::hn;

/// The survivors between the weights read and the children written.
///
/// cost    memory: three blocks of particles
template <class R, std::size_t kD>
class SurvivorStream {
 public:
  explicit SurvivorStream(std::size_t dimensions)
      : columns_(column_pointers<const R, kD>(dimensions)),
        starts_(kCapacity + kSlack),
        storage_(dimensions),
        values_(column_pointers<R, kD>(dimensions)),
        flags_(kBlock + kSlack),
        cumulative_(kBlock) {
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
    mark(from, count);
    expand(count, to);
  }

  /// The first half of write(): finds the survivors that begin among these children. What it stores byte by byte the
  /// second half reads by vectors, so that other work between them costs less than after them.
  void mark(std::uint32_t from, std::size_t count) {
    const auto end = from + static_cast<std::uint32_t>(count);
    while (map_->first[next_block_] < end) {
      skip_to(from);
      make_room();
      scan(next_block_++);
    }
    std::fill_n(starts_.data() + size_, kFence, std::numeric_limits<Whole>::max());
    skip_to(from);
    flag(from, end);
  }

  /// The second half: child k continues survivor at_ + (marks among the first k + 1).
  [[gnu::flatten, gnu::noinline]] void expand(std::size_t count, const ColumnPointers<R, kD>& to_columns) {
    const auto values = values_;
    const auto to = to_columns;
    std::uint8_t* const all_flags = flags_.data();
    std::size_t at = at_;
    for (std::size_t out = 0; out < count; out += 64) {
      const lanes::Repeats<R> repeats(all_flags + out);
      std::memset(all_flags + out, 0, 64);
      for (std::size_t v = 0; v < 64 && out + v < count; v += kPer) {
        const lanes::Repeater<R> repeated = repeats.repeater(v);
        const std::size_t from = at + repeats.begins(v);
        for (std::size_t d = 0; d < to.size(); ++d) hn::Store(repeated(values[d] + from), kNumber, to[d] + out + v);
        at += repeats.count(v);
      }
    }
    at_ = at;
  }

 private:
  /// When a block is to be scanned, those left begin inside the chunk that is written, but for one; a longer list would
  /// leave the first-level cache.
  static constexpr std::size_t kCapacity = 2 * kBlock + 64;
  static constexpr std::size_t kSlack = 64;  // room for whole vectors beyond the end
  static constexpr std::size_t kFence = 4;   // starts beyond the list's end that no child reaches: where flag() stops

  /// The last survivor that begins at or before `from` fills up what comes before the next one.
  void skip_to(std::uint32_t from) {
    while (at_ + 1 < size_ && starts_[at_ + 1] <= static_cast<Whole>(from)) ++at_;
  }

  void make_room() {
    if (size_ + kBlock <= kCapacity) return;
    const std::size_t rest = size_ - at_;
    std::memmove(starts_.data(), starts_.data() + at_, rest * sizeof(Whole));
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
    append(block, n, first, end);
    if (size_ == before) {  // rounding hid the block's only children
      const auto heaviest =
          static_cast<std::size_t>(std::max_element(weights_ + start, weights_ + start + n) - weights_);
      keep(heaviest, first);
    }
    starts_[before] = static_cast<Whole>(first);  // nor may it hide the first of them
  }

  void keep(std::size_t particle, std::uint32_t first_child) {
    starts_[size_] = static_cast<Whole>(first_child);
    for (std::size_t d = 0; d < values_.size(); ++d) values_[d][size_] = columns_[d][particle];
    ++size_;
  }

  using Whole = lanes::Whole<R>;
  using Registers = lanes::Registers<R>;
  static constexpr lanes::WholeTag<R> kWhole{};
  static constexpr typename Registers::Tag kNumber{};
  static constexpr std::size_t kLanes = lanes::kWidth<R>;
  static constexpr std::size_t kPer = Registers::kPerRegister;

  /// From the weights of a block to where their children end.
  ///
  /// Weights are rounded to whole units of 2^-30 (float) or 2^-51 (double) of the block's own sum, so the cumulative
  /// ones are exact, whatever the order of additions, and never step back; a weight below half a unit counts as zero.
  class BlockScale {
   public:
    BlockScale(const ChildMap& map, std::size_t block, std::uint32_t end) {
      const double begin = map.position[block];
      const double children = map.children_per_weight[block];
      const double units = lanes::kUnits<R> * children / (map.position[block + 1] - begin);
      const auto per_weight = static_cast<R>(std::min<double>(units, std::numeric_limits<R>::max()));
      // float: the position's whole part is added where it is exact
      const double base = std::is_same_v<R, float> ? std::floor(begin) : 0;
      to_units_ = hn::Set(kNumber, per_weight);
      to_children_ = hn::Set(kNumber, static_cast<R>(children / static_cast<double>(per_weight)));
      rest_ = hn::Set(kNumber, static_cast<R>(begin - base));
      whole_ = hn::Set(kWhole, static_cast<Whole>(base));
      last_ = hn::Set(kWhole, static_cast<Whole>(end));
      highest_ = hn::Set(kNumber, static_cast<R>(end));
    }
    MOTE_INLINE auto units_of(const R* weights) const {
      return lanes::nearest(hn::Mul(hn::Load(kNumber, weights), to_units_));
    }
    /// One past the last child: ceil(position of the cumulative weight), at most the block's.
    MOTE_INLINE auto past(lanes::WholeRegister<R> cumulative) const {
      const auto position = hn::MulAdd(lanes::as_number(cumulative), to_children_, rest_);
      if constexpr (std::is_same_v<R, float>)
        return hn::Min(last_, hn::Add(whole_, lanes::rounded_up(position)));
      else
        return lanes::rounded_up(hn::Min(highest_, position));
    }

   private:
    lanes::NumberRegister<R> to_units_, to_children_, rest_, highest_;
    lanes::WholeRegister<R> whole_, last_;
  };

  /// Appends the particles of a block that have children: those whose end lies beyond their predecessor's.
  ///
  /// Two loops, each a short chain of operations for a vector: a processor keeps few long ones going at once.
  [[gnu::flatten, gnu::noinline]] void append(std::size_t block, std::size_t n, std::uint32_t first,
                                              std::uint32_t end) {
    const BlockScale scale(*map_, block, end);
    const R* const weights = weights_ + block * kBlock;
    Whole* const cumulative = cumulative_.data();
    auto carry = hn::Zero(kWhole);
    for (std::size_t j = 0; j < n; j += kPer) {
      const auto sums = lanes::running_sum(scale.units_of(weights + j));
      hn::Store(hn::Add(sums, carry), kWhole, cumulative + j);
      carry = hn::Add(carry, lanes::last_lane(sums));
      lanes::prefetch(weights + j + kBlock);
    }
    auto columns = columns_;
    for (auto& column : columns) column += block * kBlock;
    const auto values = values_;
    Whole* const starts = starts_.data();
    std::size_t size = size_;
    auto previous = hn::Set(kWhole, static_cast<Whole>(first));
    for (std::size_t j = 0; j < n; j += kPer) {
      const auto past = scale.past(hn::Load(kWhole, cumulative + j));
      const auto child = lanes::preceding(previous, past);
      previous = past;
      const lanes::Keeper<R> kept(hn::Gt(past, child));
      hn::StoreU(kept(child), kWhole, starts + size);
      for (std::size_t d = 0; d < values.size(); ++d) {
        hn::StoreU(kept(hn::Load(kNumber, columns[d] + j)), kNumber, values[d] + size);
        lanes::prefetch(columns[d] + j + kBlock);
      }
      size += kept.count();
    }
    size_ = size;
  }

  /// Marks the first children in [from, end) of the survivors after at_.
  void flag(std::uint32_t from, std::uint32_t end) {
    const Whole* const starts = starts_.data();
    std::uint8_t* const flags = flags_.data();
    const auto last = static_cast<Whole>(end);
    const Whole* s = starts + at_ + 1;
    for (; s[3] < last; s += 4) {
      flags[s[0] - from] = 0xFF;
      flags[s[1] - from] = 0xFF;
      flags[s[2] - from] = 0xFF;
      flags[s[3] - from] = 0xFF;
    }
    for (; *s < last; ++s) flags[*s - from] = 0xFF;
  }

  const ChildMap* map_ = nullptr;
  ColumnPointers<const R, kD> columns_;
  const R* weights_ = nullptr;
  std::size_t particles_ = 0;
  std::size_t next_block_ = 0;   // the next block of weights to scan
  AlignedVector<Whole> starts_;  // first child of each survivor
  std::vector<AlignedVector<R>> storage_;
  ColumnPointers<R, kD> values_;
  AlignedVector<std::uint8_t> flags_;
  AlignedVector<Whole> cumulative_;  // weights of a block, in units
  std::size_t size_ = 0;             // survivors in the list
  std::size_t at_ = 0;               // the one whose children are being written
};

}  // namespace HWY_NAMESPACE
}  // namespace mote
