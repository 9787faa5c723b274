#pragma once
/// A function of one number as polynomials on segments: the golden twin of mote_piecewise, and the fit that makes its
/// table.

#include <algorithm>
#include <bit>
#include <functional>
#include <vector>

#include "mote/hardware/arithmetic.hpp"
#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// How a number becomes a place u >= 0 in the table.
enum class Fold : int {
  kPlain = 0,    ///< u = x - least x
  kSides = 1,    ///< u = |x - centre|, a table for each side
  kOdd = 2,      ///< u = |x - centre|, y changes its sign with x - centre
  kEven = 3,     ///< u = |x - centre|
  kMirrored = 4  ///< u = x, or -1 - x where x is negative: y is odd about minus half a step; x is signed
};

/// What a unit looks like before its table is known.
///
/// [0, 2^bottom) and each octave above are cut into 2^segment_bits segments.
struct PiecewiseShape {
  Format x, y;
  Fold fold = Fold::kPlain;
  int centre = 0;  ///< a word of x
  int bottom = 0;
  int segment_bits = 1;
  int degree = 2;  ///< 1 or 2
  int guard = 4;   ///< bits that the coefficients have below y's last
  Multiplier multiplier = Multiplier::kDsp;

  /// Bits of u; a place that needs more (the least x about centre 0) is the greatest.
  int u_bits() const;
  int regions() const { return u_bits() - bottom + 1; }
  /// Bits of the place in a segment: as many as the longest segment has, from 2 to 17 (what a DSP block takes).
  int delta_bits() const;
  std::size_t entries() const;
};

/// A unit with its table.
///
/// shape   coefficients: entries() of each
/// cost    about 5 ns a number
class Piecewise {
 public:
  struct Coefficients {
    std::int32_t c0, c1, c2;
  };

  Piecewise(const PiecewiseShape& shape, std::vector<Coefficients> table);

  Word operator()(Word x) const {
    const auto [u, negative] = place_of(x);
    const Cell cell = cell_of(u, negative);
    const Coefficients& c = table_[cell.entry];
    const Word slope = c.c1 + ((c.c2 * cell.delta) >> delta_bits_);
    const Word kept = (c.c0 + ((slope * cell.delta) >> delta_bits_)) >> shape_.guard;
    return std::clamp(negative && odd_ ? -kept : kept, shape_.y.least(), shape_.y.greatest());
  }
  void compute(Columns in, Results out) const {
    each(in[0], out[0], [this](Word x) { return (*this)(x); });
  }
  Circuit circuit() const;

  const PiecewiseShape& shape() const { return shape_; }
  /// Bits of the whole table.
  std::size_t memory_bits() const;

 private:
  friend class PiecewiseFit;
  friend struct PiecewiseCell;

  struct Place {
    std::uint64_t u;
    bool negative;
  };
  struct Cell {
    std::size_t entry;
    Word delta;
  };
  struct Widths {
    int c0, c1, c2;
  };

  Place place_of(Word x) const {
    if (shape_.fold == Fold::kPlain) return {static_cast<std::uint64_t>(x - shape_.x.least()), false};
    if (shape_.fold == Fold::kMirrored) return {static_cast<std::uint64_t>(x < 0 ? ~x : x), x < 0};
    const Word from = x - shape_.centre;
    return {std::min(static_cast<std::uint64_t>(from < 0 ? -from : from), u_greatest_), from < 0};
  }

  Cell cell_of(std::uint64_t u, bool negative) const {
    const int region = std::max(0, static_cast<int>(std::bit_width(u)) - shape_.bottom);
    // the place's leading bits fall off; its segment comes first in `field`, then the place in it
    const int lost = octaves_ ? 64 - (shape_.bottom + std::max(region, 1) - 1) : 64 - shape_.bottom;
    const std::uint64_t field = lost == 64 ? 0 : u << lost;
    const auto segment = static_cast<std::size_t>(field >> (64 - shape_.segment_bits));
    const auto delta = static_cast<Word>(field << shape_.segment_bits) >> (64 - delta_bits_);
    const std::size_t first =
        (sides_ && negative ? std::size_t{1} << region_bits_ : 0) + static_cast<std::size_t>(region);
    const Word half = Word{1} << (delta_bits_ - 1);
    return {(first << shape_.segment_bits) + segment, delta < 0 ? delta + half : delta - half};
  }

  Widths widths() const;
  int cell_latency() const;

  PiecewiseShape shape_;
  std::vector<Coefficients> table_;
  std::uint64_t u_greatest_;
  int delta_bits_;
  int region_bits_;
  bool octaves_, sides_, odd_;
};

/// The first half of a unit: (c0, c1, c2, d, side) of x, the polynomial c0 + (c1 + c2 d) d of its segment, d the place
/// in it in units of 2^-delta_bits; side is 1 where x is below the centre. The golden twin of mote_piecewise_cell.
struct PiecewiseCell {
  Piecewise unit;

  /// Of the words, in their order; the side has a bit.
  std::vector<Format> formats() const;
  bool odd() const { return unit.odd_; }
  void compute(Columns in, Results out) const;
  Circuit circuit() const;
};

/// What a fit may choose from, and how good it must be.
struct FitGoal {
  double steps = 1;  ///< the greatest error, in steps of y
  int degree = 2;
  Multiplier multiplier = Multiplier::kDsp;
  std::size_t most_entries = 4096;
};

/// The unit of the fewest table entries whose error keeps to the goal.
///
/// shape   function: of the value of x, on every x of the format; where it exceeds y's format, y saturates
/// error   Refusal (kWrongUse) when no table of at most so many entries is good enough
/// cost    milliseconds to a second
Piecewise fit_piecewise(const std::function<double(double)>& function, const Format& x, const Format& y, Fold fold,
                        int centre = 0, const FitGoal& goal = {});

/// A unit of one shape, as good as it gets.
Piecewise fit_shape(const std::function<double(double)>& function, const PiecewiseShape& shape);

/// The greatest error of a unit in steps of y, against the function where y holds it: at up to `points` numbers of
/// every segment, its first and last among them.
double worst_error(const Piecewise& unit, const std::function<double(double)>& function, std::uint64_t points = 65);

}  // namespace mote::hardware
