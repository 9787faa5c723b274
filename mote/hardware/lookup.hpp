#pragma once
/// A function of one number as a table of all its values.

#include <functional>
#include <vector>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// y = table[x], by mote_rom: an entry for every number of x's format.
///
///   table[x] = f(x), rounded to nearest; saturated where y does not hold it
///
/// shape   x: from 1 to kMostBits bits
/// error   half a step of y where y is in range: entries are rounded correctly
/// cost    a clock, two where the table fills a block of memory, or would if it were not told to stay out of them
class Lookup {
 public:
  static constexpr int kMostBits = 12;
  /// From so many bits on synthesis puts a table into a block of memory, whose words come a clock later.
  static constexpr std::size_t kBlockFrom = 8192;

  /// From so many bits on a table costs more than a choice of its number.
  static constexpr std::size_t kSharedFrom = 1024;

  Lookup(const std::function<double(double)>& function, const Format& x, const Format& y);
  /// The entries as they are, that of the number 0 first and those of negative numbers after the others.
  Lookup(const Format& x, const Format& y, std::vector<Word> table);

  Word operator()(Word x) const { return table_[static_cast<std::size_t>(x) & (table_.size() - 1)]; }
  void compute(Columns in, Results out) const {
    each(in[0], out[0], [this](Word x) { return (*this)(x); });
  }
  Circuit circuit() const;

  const Format& x() const { return x_; }
  const Format& y() const { return y_; }
  std::size_t memory_bits() const { return table_.size() * static_cast<std::size_t>(y_.width()); }
  bool in_block() const { return large() && !logic_; }
  /// The same table in look-up tables of a device, however large it is.
  Lookup in_logic() const;
  /// The table's contents, for the parameter File.
  Memory memory() const;

  friend bool operator==(const Lookup&, const Lookup&) = default;

 private:
  bool large() const { return memory_bits() >= kBlockFrom; }

  Format x_, y_;
  std::vector<Word> table_;
  bool logic_ = false;
};

/// A table in a block of memory, read for two numbers at once: y0 = table[x0], y1 = table[x1]; mote_rom_pair.
struct LookupPair {
  Lookup table;

  void compute(Columns in, Results out) const {
    for (const std::size_t k : {0U, 1U}) each(in[k], out[k], table);
  }
  Circuit circuit() const;
};

}  // namespace mote::hardware
