#pragma once
/// Shifts by places that the data say: golden twins of mote_normalise and mote_scale.

#include <algorithm>
#include <bit>

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// (e, m, n) of (x, n): both words shifted to the left until x's leading one stands at the top; e is the place where it
/// stood.
///
/// With `even` the shift is even and e counts pairs of places. shape   width from 2 to 62, even where `even`
struct Normalise {
  int width;
  bool even = false;

  int e_width() const { return std::max(1, ceil_log2(static_cast<std::uint64_t>(width))); }

  int shift(Word x) const {
    const int place = std::max(0, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(x))) - 1);
    return even ? (width - 1 - place) / 2 * 2 : width - 1 - place;
  }
  void compute(Columns in, Results out) const {
    const auto all = ~std::uint64_t{0} >> (64 - width);
    for (std::size_t i = 0; i < out[0].size(); ++i) {
      const int s = shift(in[0][i]);
      out[0][i] = even ? s / 2 : width - 1 - s;
      out[1][i] = static_cast<Word>((static_cast<std::uint64_t>(in[0][i]) << s) & all);
      out[2][i] = static_cast<Word>((static_cast<std::uint64_t>(in[1][i]) << s) & all);
    }
  }
  Circuit circuit() const;
};

/// y = m 2^-s, to the nearest, ties up, saturated. All are unsigned.
///
/// error   half a step of y, where y is in range
struct Scale {
  Format m;
  int s_width;
  Format y;

  Word operator()(Word mantissa, Word s) const {
    const int lift = y.fraction + 1 - m.fraction;
    const WideWord wide =
        lift >= 0 ? static_cast<WideWord>(mantissa) << lift : static_cast<WideWord>(mantissa) >> -lift;
    const WideWord rounded = s > 126 ? 0 : ((wide >> s) + 1) >> 1;
    return rounded > y.greatest() ? y.greatest() : static_cast<Word>(rounded);
  }
  void compute(Columns in, Results out) const { each(in[0], in[1], out[0], *this); }
  Circuit circuit() const;
};

}  // namespace mote::hardware
