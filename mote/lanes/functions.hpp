#pragma once
/// Elementary functions of vectors. Bounds in ulp of the exact value, over the stated arguments; infinities, NaN, zeros
/// and signs as in <cmath> unless said otherwise. lanes/functions_test.cpp measures every one of them.
///
///             float   double   arguments
///   exp        1.5     1.5     all
///   log        1.5     1.5     all
///   sin, cos   1.5     1.5     all; beyond kReducible the scalar library's
///   tan        4.5     4.5     as sin
///   atan       3.5     3.5     all
///   atan2      4       4       all; atan2(0, 0) = 0
///
/// source  coefficients of Moshier's Cephes (sin, cos, atan, exp in float) and Sun's fdlibm (log)

#include <cmath>

#include "mote/lanes/vector.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

namespace detail {

/// c[0] + c[1] x + ... by Horner's rule.
template <class R, std::size_t kBytes, std::size_t N>
MOTE_INLINE Vector<R, kBytes> polynomial(const Vector<R, kBytes>& x, const std::array<double, N>& c) {
  return horner<N - 1>(x, [&](std::size_t i) { return Vector<R, kBytes>(c[i]); });
}

/// The integer lanes of the width of R.
template <class R>
using Whole = std::conditional_t<std::is_same_v<R, float>, std::int32_t, std::int64_t>;

template <class R, std::size_t kBytes>
MOTE_INLINE Registers<Whole<R>, kBytes> to_whole(const Vector<R, kBytes>& a) {
  return Registers<Whole<R>, kBytes>::map(
      [](auto x) { return hn::ConvertTo(typename Registers<Whole<R>, kBytes>::Tag{}, x); }, a.parts);
}
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> from_whole(const Registers<Whole<R>, kBytes>& a) {
  return Vector<R, kBytes>(
      Registers<R, kBytes>::map([](auto x) { return hn::ConvertTo(typename Registers<R, kBytes>::Tag{}, x); }, a));
}
template <class R>
inline constexpr int kMantissaBits = std::is_same_v<R, float> ? 23 : 52;
template <class R>
inline constexpr int kBias = std::is_same_v<R, float> ? 127 : 1023;

/// 2^n for whole n from -bias + 1 to bias.
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> power_of_two(const Vector<R, kBytes>& n) {
  const auto biased = to_whole(n + Vector<R, kBytes>(kBias<R>));
  const auto shifted =
      Registers<Whole<R>, kBytes>::map([](auto x) { return hn::ShiftLeft<kMantissaBits<R>>(x); }, biased);
  return Vector<R, kBytes>(shifted.template as<R>());
}

/// p 2^n for whole n; underflows to zero, overflows to infinity.
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> scaled(const Vector<R, kBytes>& p, const Vector<R, kBytes>& n) {
#if HWY_TARGET <= HWY_AVX3
  return Vector<R, kBytes>::map(
      [](auto x, auto e) {
        if constexpr (std::is_same_v<R, float>) {
          return decltype(x){_mm512_scalef_ps(x.raw, e.raw)};
        } else {
          return decltype(x){_mm512_scalef_pd(x.raw, e.raw)};
        }
      },
      p, n);
#else
  // in two steps, so that results near the ends of the range are reached
  const Vector<R, kBytes> bounded = max(min(n, Vector<R, kBytes>(2 * kBias<R>)), Vector<R, kBytes>(2 - 2 * kBias<R>));
  const Vector<R, kBytes> first = floor(bounded * Vector<R, kBytes>(0.5));
  return p * power_of_two(first) * power_of_two(bounded - first);
#endif
}

/// ln 2 to the power i over i factorial: 2^f = sum c_i f^i.
template <std::size_t N>
constexpr std::array<double, N> exp2_series() {
  std::array<double, N> c{1};
  for (std::size_t i = 1; i < N; ++i) c[i] = c[i - 1] * std::numbers::ln2 / static_cast<double>(i);
  return c;
}
/// Least-error polynomial of 2^f on [-1/2, 1/2] that is 1 at 0.
inline constexpr std::array<double, 6> kExp2Float{
    1.0, 6.931469775e-01, 2.402224184e-01, 5.550733813e-02, 9.671529072e-03, 1.326476231e-03};
inline constexpr std::array<double, 12> kExp2Double = exp2_series<12>();

}  // namespace detail

/// 2^t for weights: relative error below 3e-7 (float), 1e-14 (double); no infinities or NaN in, 0 for t = -infinity.
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> exp2_weight(const Vector<R, kBytes>& t) {
#if HWY_TARGET <= HWY_AVX3
  if constexpr (std::is_same_v<R, float>) {
    return Vector<R, kBytes>::map(
        [](auto x) {
          const auto f = decltype(x){_mm512_reduce_ps(x.raw, 0)};
          const auto n = hn::Sub(x, f);
          const Vector<R, 64> p = detail::polynomial(Vector<R, 64>(Registers<R, 64>{{f}}), detail::kExp2Float);
          return decltype(x){_mm512_scalef_ps(p.parts.r[0].raw, n.raw)};
        },
        t);
  } else {
    return Vector<R, kBytes>::map(
        [](auto x) {
          const auto f = decltype(x){_mm512_reduce_pd(x.raw, 0)};
          const auto n = hn::Sub(x, f);
          const Vector<R, 64> p = detail::polynomial(Vector<R, 64>(Registers<R, 64>{{f}}), detail::kExp2Double);
          return decltype(x){_mm512_scalef_pd(p.parts.r[0].raw, n.raw)};
        },
        t);
  }
#else
  // below 2^least the weight of a particle is nothing beside the heaviest of its block
  const Vector<R, kBytes> bounded = max(t, Vector<R, kBytes>(2 - detail::kBias<R>));
  const Vector<R, kBytes> n = round(bounded);
  Vector<R, kBytes> p;
  if constexpr (std::is_same_v<R, float>) {
    p = detail::polynomial(bounded - n, detail::kExp2Float);
  } else {
    p = detail::polynomial(bounded - n, detail::kExp2Double);
  }
  return select(t < Vector<R, kBytes>(2 - detail::kBias<R>), Vector<R, kBytes>(0), p * detail::power_of_two(n));
#endif
}

template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> exp(const Vector<R, kBytes>& x) {
  using V = Vector<R, kBytes>;
  constexpr bool kFloat = std::is_same_v<R, float>;
  // beyond these the result is 0 or infinite anyway; NaN passes through min and max as the second operand's
  const V bounded = min(max(x, V(kFloat ? -105.0 : -750.0)), V(kFloat ? 90.0 : 711.0));
  const V n = round(bounded * V(std::numbers::log2e));
  V y;
  if constexpr (kFloat) {
    const V r = fnma(n, V(-2.12194440e-4), fnma(n, V(0.693359375), bounded));
    const V p = detail::polynomial(r, std::array<double, 6>{5.0000001201e-1, 1.6666665459e-1, 4.1665795894e-2,
                                                            8.3334519073e-3, 1.3981999507e-3, 1.9875691500e-4});
    y = fma(r * r, p, r) + V(1);
  } else {
    const V r = fnma(n, V(1.42860682030941723212e-6), fnma(n, V(6.93145751953125e-1), bounded));
    V p(1.0 / 6227020800.0);
    double factorial = 6227020800.0;  // 13!
    for (int i = 13; i > 2; --i) {
      factorial /= i;
      p = fma(p, r, V(1 / factorial));
    }
    y = fma(r * r, p, r) + V(1);
  }
  const V result = detail::scaled(y, n);
  return select(x == x, result, x);
}

template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> log(const Vector<R, kBytes>& x) {
  using V = Vector<R, kBytes>;
  using I = Registers<detail::Whole<R>, kBytes>;
  using T = typename I::Tag;
  constexpr bool kFloat = std::is_same_v<R, float>;
  // a subnormal is scaled up first
  const auto tiny = x < V(kFloat ? 0x1p-126 : 0x1p-1022);
  const V normal = select(tiny, x * V(kFloat ? 0x1p25 : 0x1p54), x);
  // x = 2^e m with m in [1/sqrt 2, sqrt 2): subtract the bits of 1/sqrt 2, what is left above the mantissa is e
  constexpr auto kRootBits =
      kFloat ? static_cast<detail::Whole<R>>(0x3F3504F3) : static_cast<detail::Whole<R>>(0x3FE6A09E667F3BCDLL);
  const I bits = normal.parts.template as<detail::Whole<R>>();
  const I exponent = I::map(
      [&](auto b) { return hn::ShiftRight<detail::kMantissaBits<R>>(hn::Sub(b, hn::Set(T{}, kRootBits))); }, bits);
  const I mantissa =
      I::map([&](auto b, auto e) { return hn::Sub(b, hn::ShiftLeft<detail::kMantissaBits<R>>(e)); }, bits, exponent);
  const V m(mantissa.template as<R>());
  const V e = detail::from_whole<R>(exponent) - select(tiny, V(kFloat ? 25 : 54), V(0));
  const V f = m - V(1);
  const V s = f / (f + V(2));
  const V z = s * s;
  V r;
  if constexpr (kFloat) {
    r = z * detail::polynomial(z, std::array<double, 4>{0.66666662693, 0.40000972152, 0.28498786688, 0.24279078841});
  } else {
    r = z * detail::polynomial(
                z, std::array<double, 7>{6.666666666666735130e-01, 3.999999999940941908e-01, 2.857142874366239149e-01,
                                         2.222219843214978396e-01, 1.818357216161805012e-01, 1.531383769920937332e-01,
                                         1.479819860511658591e-01});
  }
  const V half_square = V(0.5) * f * f;
  const V high(kFloat ? 0.693359375 : 6.93147180369123816490e-01);
  const V low(kFloat ? -2.12194440e-4 : 1.90821492927058770002e-10);
  const V result = fma(e, high, f - (half_square - (fma(s, half_square + r, e * low))));
  const V finite = select(x < V(kInfinity), result, x);  // infinity and NaN stay what they are
  return select(V(0) < x, finite, select(x == V(0), V(-kInfinity), V(kNaN) + x));
}

namespace detail {

/// Lanes computed one by one by the scalar library.
template <class R, std::size_t kBytes, class F>
[[gnu::noinline, gnu::const]] Vector<R, kBytes> one_by_one(F f, Vector<R, kBytes> x) noexcept {
  alignas(64) std::array<R, kBytes / sizeof(R)> lane;
  x.store(lane.data());
  for (R& v : lane) v = f(v);
  return Vector<R, kBytes>::load(lane.data());
}

template <class R, std::size_t kBytes>
struct SinCos {
  Vector<R, kBytes> sine, cosine;
};

/// sin and cos of arguments up to kReducible.
template <class R, std::size_t kBytes>
MOTE_INLINE SinCos<R, kBytes> sin_cos(const Vector<R, kBytes>& x) {
  using V = Vector<R, kBytes>;
  using I = Registers<Whole<R>, kBytes>;
  using T = typename I::Tag;
  constexpr bool kFloat = std::is_same_v<R, float>;
  const V n = round(x * V(2 / kPi));
  V r;
#if HWY_NATIVE_FMA
  if constexpr (kFloat) {  // pi/2 in three parts; fused, each product is exact
    r = fnma(n, V(1.57079637050628662109375), x);
    r = fnma(n, V(-4.37113900018624283e-8), r);
    r = fnma(n, V(-1.71512451000588005e-15), r);
  } else {
    r = fnma(n, V(1.57079632679489655800e+00), x);
    r = fnma(n, V(6.12323399573676603587e-17), r);
    r = fnma(n, V(-1.49738490485916983e-33), r);
  }
#else
  if constexpr (kFloat) {  // pi/2 in parts of so few bits that n times a part is exact
    r = fnma(n, V(1.5703125), x);
    r = fnma(n, V(4.837512969970703125e-4), r);
    r = fnma(n, V(7.549789954891882e-8), r);
  } else {
    r = fnma(n, V(1.57079632673412561417e+00), x);
    r = fnma(n, V(6.07710050630396597660e-11), r);
    r = fnma(n, V(2.02226624879595063154e-21), r);
  }
#endif
  const V z = r * r;
  V s;
  V c;
  if constexpr (kFloat) {
    s = fma(z * r, polynomial(z, std::array<double, 3>{-1.6666654611e-1, 8.3321608736e-3, -1.9515295891e-4}), r);
    c = fma(z * z,
            polynomial(z, std::array<double, 3>{4.166664568298827e-2, -1.388731625493765e-3, 2.443315711809948e-5}),
            fnma(z, V(0.5), V(1)));
  } else {
    s = fma(z * r,
            polynomial(z, std::array<double, 6>{-1.66666666666666307295e-1, 8.33333333332211858878e-3,
                                                -1.98412698295895385996e-4, 2.75573136213857245213e-6,
                                                -2.50507477628578072866e-8, 1.58962301576546568060e-10}),
            r);
    c = fma(z * z,
            polynomial(z, std::array<double, 6>{4.16666666666665929218e-2, -1.38888888888730564116e-3,
                                                2.48015872888517045348e-5, -2.75573141792967388112e-7,
                                                2.08757008419747316778e-9, -1.13585365213876817300e-11}),
            fnma(z, V(0.5), V(1)));
  }
  // quarter q: (s, c), (c, -s), (-s, -c), (-c, s)
  const I q = to_whole(n);
  Mask<R, kBytes> swapped;
  for (std::size_t k = 0; k < q.r.size(); ++k)
    swapped.r[k] = hn::RebindMask(typename V::Tag{}, hn::TestBit(q.r[k], hn::Set(T{}, 1)));
  const auto second_bit = [](const I& v) {  // as a sign
    return I::map([](auto n_k) { return hn::ShiftLeft<8 * sizeof(R) - 1>(hn::ShiftRight<1>(n_k)); }, v);
  };
  const I sine_sign = second_bit(q);
  const I cosine_sign = second_bit(I::map([](auto v) { return hn::Add(v, hn::Set(T{}, 1)); }, q));
  const auto signed_as = [](const V& v, const I& sign) {
    return V::map([](auto a, auto b) { return hn::Xor(a, b); }, v, V(sign.template as<R>()));
  };
  return {signed_as(select(swapped, c, s), sine_sign), signed_as(select(swapped, s, c), cosine_sign)};
}

/// The largest argument that sin_cos() reduces well.
template <class R>
inline constexpr double kReducible = HWY_NATIVE_FMA ? (std::is_same_v<R, float> ? 0x1p13 : 0x1p26)
                                                    : (std::is_same_v<R, float> ? 0x1p7 : 0x1p19);

/// True if every lane is an argument that sin_cos() reduces well.
template <class R, std::size_t kBytes>
MOTE_INLINE bool reducible(const Vector<R, kBytes>& x) {
  return (abs(x) < Vector<R, kBytes>(kReducible<R>)).bits() ==
         static_cast<std::uint32_t>((std::uint64_t{1} << Vector<R, kBytes>::kLanes) - 1);
}

}  // namespace detail

template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> sin(const Vector<R, kBytes>& x) {
  if (!detail::reducible(x)) return detail::one_by_one([](R v) { return std::sin(v); }, x);
  return detail::sin_cos(x).sine;
}
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> cos(const Vector<R, kBytes>& x) {
  if (!detail::reducible(x)) return detail::one_by_one([](R v) { return std::cos(v); }, x);
  return detail::sin_cos(x).cosine;
}
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> tan(const Vector<R, kBytes>& x) {
  if (!detail::reducible(x)) return detail::one_by_one([](R v) { return std::tan(v); }, x);
  const auto both = detail::sin_cos(x);
  return both.sine / both.cosine;
}

namespace detail {

/// atan(top / bottom) for 0 <= top <= bottom, top and bottom finite; 0 for 0/0.
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> atan_of_ratio(const Vector<R, kBytes>& top, const Vector<R, kBytes>& bottom) {
  using V = Vector<R, kBytes>;
  // above tan(pi/8): atan(t) = pi/4 + atan((t - 1) / (t + 1)), formed before the one division
  const auto steep = V(0.41421356237309504880) * bottom < top;
  const V numerator = select(steep, top - bottom, top);
  const V denominator = select(steep, top + bottom, bottom);
  const V t = numerator / max(denominator, V(std::numeric_limits<R>::min()));
  const V z = t * t;
  const V base = select(steep, V(kPi / 4), V(0));
  if constexpr (std::is_same_v<R, float>) {
    const V p =
        polynomial(z, std::array<double, 4>{-3.33329491539e-1, 1.99777106478e-1, -1.38776856032e-1, 8.05374449538e-2});
    return base + fma(z * t, p, t);
  } else {
    const V p = polynomial(
        z, std::array<double, 5>{-6.485021904942025371773e1, -1.228866684490136173410e2, -7.500855792314704667340e1,
                                 -1.615753718733365076637e1, -8.750608600031904122785e-1});
    const V q = polynomial(
        z, std::array<double, 6>{1.945506571482613964425e2, 4.853903996359136964868e2, 4.328810604912902668951e2,
                                 1.650270098316988542046e2, 2.485846490142306297962e1, 1.0});
    const V rest = select(steep, V(3.061616997868382943065e-17), V(0));
    return base + (fma(z * t, p / q, t) + rest);
  }
}

/// v with the sign of s.
template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> with_sign(const Vector<R, kBytes>& v, const Vector<R, kBytes>& s) {
  return Vector<R, kBytes>::map([](auto a, auto b) { return hn::CopySign(a, b); }, v, s);
}

}  // namespace detail

template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> atan2(const Vector<R, kBytes>& y, const Vector<R, kBytes>& x) {
  using V = Vector<R, kBytes>;
  const V largest(std::numeric_limits<R>::max());
  const V ay = min(abs(y), largest);
  const V ax = min(abs(x), largest);
  const auto swapped = ax < ay;
  V a = detail::atan_of_ratio(select(swapped, ax, ay), select(swapped, ay, ax));
  a = select(swapped, V(kPi / 2) - a, a);
  const auto behind = detail::with_sign(V(1), x) < V(0);
  a = detail::with_sign(select(behind, V(kPi) - a, a), y);
  return select(x == x, select(y == y, a, y), x);  // NaN in either argument comes out
}

template <class R, std::size_t kBytes>
MOTE_INLINE Vector<R, kBytes> atan(const Vector<R, kBytes>& x) {
  using V = Vector<R, kBytes>;
  const V ax = abs(x);
  const auto swapped = V(1) < ax;
  const V a = detail::atan_of_ratio(select(swapped, V(1), min(ax, V(std::numeric_limits<R>::max()))),
                                    select(swapped, min(ax, V(std::numeric_limits<R>::max())), V(1)));
  return select(x == x, detail::with_sign(select(swapped, V(kPi / 2) - a, a), x), x);
}

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
