#pragma once
/// Functions in fixed point, each by tables of polynomials or by CORDIC: compounds of the library's operators.
///
/// error   below one step of the result's format everywhere, where the result is in range; it saturates elsewhere.
///         Tests hold every function to that on all numbers of small formats and on 10^7 of larger ones.
/// shape   results of up to about 24 bits (a table's coefficients are words of 32)
/// cost    building: the fit of the tables, up to a second

#include "mote/hardware/arithmetic.hpp"
#include "mote/hardware/compound.hpp"

namespace mote::hardware {

/// How a function's kernel is computed after its argument was reduced.
enum class Form { kTable, kCordic };

struct FunctionOptions {
  Form form = Form::kTable;
  Multiplier multiplier = Multiplier::kDsp;
  int interval = 1;           ///< clocks from one word to the next
  bool logic_tables = false;  ///< tables of all values stay out of blocks of memory
};

/// y = 1 / x. 0 is taken for one step of x.
Compound reciprocal(const Format& x, const Format& y, const FunctionOptions& options = {});

/// y = a / b. 0 / b = 0; a divisor 0 is taken for one step of b.
Compound divide(const Format& a, const Format& b, const Format& y, const FunctionOptions& options = {});

/// y = sqrt(x), x unsigned.
Compound square_root(const Format& x, const Format& y, const FunctionOptions& options = {});

/// y = log(x), x unsigned. 0 is taken for one step of x.
Compound logarithm(const Format& x, const Format& y, const FunctionOptions& options = {});

/// y = exp(x).
Compound exponential(const Format& x, const Format& y, const FunctionOptions& options = {});

/// (cos x, sin x), x in radians.
Compound cosine_and_sine(const Format& x, const Format& y, const FunctionOptions& options = {});

/// y = tan(x), x in radians. Within 2^-(2 integer + fraction + 2) of a pole, by bits of y, it saturates with either
/// sign.
///
/// shape   y: signed, from 1 integer bit on
Compound tangent(const Format& x, const Format& y, const FunctionOptions& options = {});

/// y = atan2(b, a), the angle of the point (a, b), in radians; (0, 0) has angle 0, and (a, 0) with a < 0 has pi.
///
/// shape   a and b: one format; y: signed, 2 integer bits
Compound arc_tangent_2(const Format& point, int fraction, const FunctionOptions& options = {});

/// y = atan(x) in radians.
///
/// shape   y: signed, 1 integer bit
Compound arc_tangent(const Format& x, int fraction, const FunctionOptions& options = {});

/// x - 2 pi k, the angle closest to 0; within a step of -pi and pi either may come.
///
/// shape   y: signed, 2 integer bits, x's fraction
Compound wrapped_angle(const Format& x);

}  // namespace mote::hardware
