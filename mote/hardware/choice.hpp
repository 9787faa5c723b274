#pragma once
/// Comparisons and choices: golden twins of mote_less, mote_select, mote_extremum, mote_negate_if, mote_convert
/// and mote_finish.

#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// y = a < b, of any two formats, exact.
struct Less {
  Format a, b;

  Word operator()(Word left, Word right) const {
    const int fraction = a.fraction > b.fraction ? a.fraction : b.fraction;
    return (static_cast<WideWord>(left) << (fraction - a.fraction)) <
           (static_cast<WideWord>(right) << (fraction - b.fraction));
  }
  void compute(Columns in, Results out) const { each(in[0], in[1], out[0], *this); }
  Circuit circuit() const;
};

/// y = s ? a : b.
struct Select {
  Format y;
  bool registered = true;

  void compute(Columns in, Results out) const {
    for (std::size_t i = 0; i < out[0].size(); ++i) out[0][i] = in[0][i] != 0 ? in[1][i] : in[2][i];
  }
  Circuit circuit() const;
};

/// y = min(a, b), or max(a, b).
struct Extremum {
  Format y;
  bool greater = false;

  Word operator()(Word a, Word b) const { return (a < b) == greater ? b : a; }
  void compute(Columns in, Results out) const { each(in[0], in[1], out[0], *this); }
  Circuit circuit() const;
};

/// y = s ? -a : a, saturated; a and y have one fraction.
struct NegateIf {
  Format a, y;

  Word operator()(Word s, Word number) const { return resized(s != 0 ? -number : number, a.fraction, y); }
  void compute(Columns in, Results out) const { each(in[0], in[1], out[0], *this); }
  Circuit circuit() const;
};

/// y = a in another format, without a register.
struct Convert {
  Format a, y;
  Finish finish = {};

  Word operator()(Word number) const { return resized(number, a.fraction, y, finish); }
  void compute(Columns in, Results out) const { each(in[0], out[0], *this); }
  Circuit circuit() const;
};

/// The same behind a register.
struct Finished {
  Format a, y;
  Finish finish = {};

  Word operator()(Word number) const { return resized(number, a.fraction, y, finish); }
  void compute(Columns in, Results out) const { each(in[0], out[0], *this); }
  Circuit circuit() const;
};

/// The `count` bits of a word from bit `first` on, as an unsigned number with `fraction` bits after the point.
Convert bits_of(const Format& a, int first, int count, int fraction = 0);

}  // namespace mote::hardware
