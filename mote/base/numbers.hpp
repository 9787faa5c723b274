#pragma once
/// Arithmetic a model may use for any number type S: plain numbers here; vectors and recorded nodes overload the same
/// names.
///
/// A model calls these and the functions of <cmath> unqualified after `using namespace mote::numbers;`, so that
/// argument-dependent lookup finds the overloads of S.

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

namespace mote {

/// Time index of a state-space model: x_0 is the state before the first step, the first step is 1.
using Step = int;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

namespace numbers {

using std::abs, std::atan, std::atan2, std::cos, std::exp, std::floor, std::log, std::sin, std::sqrt, std::tan;

/// 1 where a < b, else 0 – as a condition for select().
template <std::floating_point S>
bool less(S a, S b) {
  return a < b;
}

/// a where the condition holds, else b (both are computed).
template <std::floating_point S>
S select(bool condition, S a, S b) {
  return condition ? a : b;
}

template <class S>
struct SinCos {
  S sine, cosine;
};

/// Sine and cosine of one angle; vectors share the work that both do.
template <class S>
SinCos<S> sin_cos(const S& angle) {
  return {sin(angle), cos(angle)};
}

/// The angle in [-pi, pi) that differs from `angle` by whole turns.
///
///   wrap(a) = a - 2 pi floor(a / (2 pi) + 1/2)
///
/// unit    in, out: rad
/// cost    one floor, two products
template <class S>
[[gnu::always_inline]] inline S wrap(const S& angle) {
  return angle - S(2 * kPi) * floor(angle * S(0.5 / kPi) + S(0.5));
}

}  // namespace numbers
}  // namespace mote
