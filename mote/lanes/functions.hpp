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
template <class R, std::size_t N>
MOTE_INLINE Vector<R> polynomial(const Vector<R>& x, const std::array<double, N>& c) {
  return horner<N - 1>(x, [&](std::size_t i) { return Vector<R>(c[i]); });
}

/// The integer lanes of the width of R.
template <class R>
using Whole = std::conditional_t<std::is_same_v<R, float>, std::int32_t, std::int64_t>;

template <class R>
MOTE_INLINE Registers<Whole<R>> to_whole(const Vector<R>& a) {
  return Registers<Whole<R>>::map([](auto x) { return hn::ConvertTo(typename Registers<Whole<R>>::Tag{}, x); },
                                  a.parts);
}
template <class R>
MOTE_INLINE Vector<R> from_whole(const Registers<Whole<R>>& a) {
  return Vector<R>(Registers<R>::map([](auto x) { return hn::ConvertTo(typename Registers<R>::Tag{}, x); }, a));
}
template <class R>
inline constexpr int kMantissaBits = std::is_same_v<R, float> ? 23 : 52;
template <class R>
inline constexpr int kBias = std::is_same_v<R, float> ? 127 : 1023;

/// 2^n for whole n from -bias + 1 to bias.
template <class R>
MOTE_INLINE Vector<R> power_of_two(const Vector<R>& n) {
  const auto biased = to_whole(n + Vector<R>(kBias<R>));
  const auto shifted = Registers<Whole<R>>::map([](auto x) { return hn::ShiftLeft<kMantissaBits<R>>(x); }, biased);
  return Vector<R>(shifted.template as<R>());
}

/// p 2^n for whole n; underflows to zero, overflows to infinity.
template <class R>
MOTE_INLINE Vector<R> scaled(const Vector<R>& p, const Vector<R>& n) {
#if HWY_TARGET <= HWY_AVX3
  return Vector<R>::map(
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
  const Vector<R> bounded = max(min(n, Vector<R>(2 * kBias<R>)), Vector<R>(2 - 2 * kBias<R>));
  const Vector<R> first = floor(bounded * Vector<R>(0.5));
  return p * power_of_two(first) * power_of_two(bounded - first);
#endif
}

/// Least-error polynomials of 2^f on [-1/2, 1/2] that are 1 at 0.
inline constexpr std::array<double, 6> kExp2Float{
    1.0, 6.931469775e-01, 2.402224184e-01, 5.550733813e-02, 9.671529072e-03, 1.326476231e-03};
inline constexpr std::array<double, 11> kExp2Double{1.0,
                                                    6.93147180559946174e-01,
                                                    2.40226506959100750e-01,
                                                    5.55041086646516704e-02,
                                                    9.61812910761866528e-03,
                                                    1.33335582007945925e-03,
                                                    1.54035304247765285e-04,
                                                    1.52526729248507372e-05,
                                                    1.32154516332214336e-06,
                                                    1.02059054137655955e-07,
                                                    7.07097786650813908e-09};
/// log(3/2 + s) for s in [-1/2, 1/2], by Chebyshev's series.
inline constexpr std::array<double, 7> kLogFloat{4.054652915e-01,  6.666836726e-01, -2.222453974e-01, 9.823154226e-02,
                                                 -4.892903467e-02, 3.044900454e-02, -1.741407752e-02};

}  // namespace detail

/// 2^t for weights: relative error below 3e-7 (float), 1e-14 (double); 0 for t = -infinity, NaN for NaN, not for
/// t = infinity.
template <class R>
MOTE_INLINE Vector<R> exp2_weight(const Vector<R>& t) {
#if HWY_TARGET <= HWY_AVX3
  if constexpr (std::is_same_v<R, float>) {
    return Vector<R>::map(
        [](auto x) {
          const auto f = decltype(x){_mm512_reduce_ps(x.raw, 0)};
          const auto n = hn::Sub(x, f);
          const Vector<R> p = detail::polynomial(Vector<R>(Registers<R>{{f}}), detail::kExp2Float);
          return decltype(x){_mm512_scalef_ps(p.parts.r[0].raw, n.raw)};
        },
        t);
  } else {
    return Vector<R>::map(
        [](auto x) {
          const auto f = decltype(x){_mm512_reduce_pd(x.raw, 0)};
          const auto n = hn::Sub(x, f);
          const Vector<R> p = detail::polynomial(Vector<R>(Registers<R>{{f}}), detail::kExp2Double);
          return decltype(x){_mm512_scalef_pd(p.parts.r[0].raw, n.raw)};
        },
        t);
  }
#else
  // The sum with 1.5 times 2^23 (2^52) is rounded to a whole number, which it has in its lowest bits: with the bias,
  // those of the exponent of 2^n. Exponent 0 is that of 0: below 2^-126 (2^-1022) a weight is nothing beside the
  // block's largest.
  constexpr R kRounder = (std::is_same_v<R, float> ? R(0x1.8p23) : R(0x1.8p52)) + detail::kBias<R>;
  const Vector<R> bounded = max(Vector<R>(-detail::kBias<R>), t);
  const Vector<R> biased = bounded + Vector<R>(kRounder);
  const Vector<R> f = bounded - (biased - Vector<R>(kRounder));
  Vector<R> p;
  if constexpr (std::is_same_v<R, float>) {
    p = detail::polynomial(f, detail::kExp2Float);
  } else {
    p = detail::polynomial(f, detail::kExp2Double);
  }
  const auto power = Registers<detail::Whole<R>>::map([](auto x) { return hn::ShiftLeft<detail::kMantissaBits<R>>(x); },
                                                      biased.parts.template as<detail::Whole<R>>());
  return p * Vector<R>(power.template as<R>());
#endif
}

template <class R>
MOTE_INLINE Vector<R> exp(const Vector<R>& x) {
  using V = Vector<R>;
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

namespace detail {

/// log(2^more x) of positive normal numbers x.
template <class R>
MOTE_INLINE Vector<R> log_of_normal(const Vector<R>& x, const Vector<R>& more) {
  using V = Vector<R>;
  using I = Registers<Whole<R>>;
  using T = typename I::Tag;
  constexpr bool kFloat = std::is_same_v<R, float>;
  // x = 2^e m with m in [1/sqrt 2, sqrt 2): subtract the bits of 1/sqrt 2, what is left above the mantissa is e
  constexpr auto kRootBits = kFloat ? static_cast<Whole<R>>(0x3F3504F3) : static_cast<Whole<R>>(0x3FE6A09E667F3BCDLL);
  const I bits = x.parts.template as<Whole<R>>();
  const I exponent =
      I::map([&](auto b) { return hn::ShiftRight<kMantissaBits<R>>(hn::Sub(b, hn::Set(T{}, kRootBits))); }, bits);
  const I mantissa =
      I::map([&](auto b, auto e) { return hn::Sub(b, hn::ShiftLeft<kMantissaBits<R>>(e)); }, bits, exponent);
  const V m(mantissa.template as<R>());
  const V e = from_whole<R>(exponent) + more;
  const V f = m - V(1);
  const V s = f / (f + V(2));
  const V z = s * s;
  V r;
  if constexpr (kFloat) {
    r = z * polynomial(z, std::array<double, 4>{0.66666662693, 0.40000972152, 0.28498786688, 0.24279078841});
  } else {
    r = z * polynomial(
                z, std::array<double, 7>{6.666666666666735130e-01, 3.999999999940941908e-01, 2.857142874366239149e-01,
                                         2.222219843214978396e-01, 1.818357216161805012e-01, 1.531383769920937332e-01,
                                         1.479819860511658591e-01});
  }
  const V half_square = V(0.5) * f * f;
  const V high(kFloat ? 0.693359375 : 6.93147180369123816490e-01);
  const V low(kFloat ? -2.12194440e-4 : 1.90821492927058770002e-10);
  return fma(e, high, f - (half_square - (fma(s, half_square + r, e * low))));
}

}  // namespace detail

template <class R>
MOTE_INLINE Vector<R> log(const Vector<R>& x) {
  using V = Vector<R>;
  constexpr bool kFloat = std::is_same_v<R, float>;
  // a subnormal is scaled up first
  const auto tiny = x < V(kFloat ? 0x1p-126 : 0x1p-1022);
  const V normal = select(tiny, x * V(kFloat ? 0x1p25 : 0x1p54), x);
  const V result = detail::log_of_normal(normal, select(tiny, V(kFloat ? -25 : -54), V(0)));
  const V finite = select(x < V(kInfinity), result, x);  // infinity and NaN stay what they are
  return select(V(0) < x, finite, select(x == V(0), V(-kInfinity), V(kNaN) + x));
}

/// log u of uniform numbers for comparisons, 0 < u < 1 and normal: error below 2e-6 + 1 ulp (float), that of log() in
/// double.
template <class R>
MOTE_INLINE Vector<R> log_uniform(const Vector<R>& u) {
  if constexpr (std::is_same_v<R, float>) {
#if HWY_TARGET <= HWY_AVX3
    return Vector<R>::map(
        [](auto x) {
          const auto e = decltype(x){_mm512_getexp_ps(x.raw)};
          const auto m = decltype(x){_mm512_getmant_ps(x.raw, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_zero)};
          const Vector<R> s(Registers<R>{{hn::Sub(m, hn::Set(typename Registers<R>::Tag{}, 1.5F))}});
          return hn::MulAdd(e, hn::Set(typename Registers<R>::Tag{}, std::numbers::ln2_v<float>),
                            detail::polynomial(s, detail::kLogFloat).parts.r[0]);
        },
        u);
#else
    using I = Registers<detail::Whole<R>>;
    using T = typename I::Tag;
    const I bits = u.parts.template as<detail::Whole<R>>();
    const I exponent = I::map([](auto b) { return hn::ShiftRight<detail::kMantissaBits<R>>(b); }, bits);
    const I mantissa =
        I::map([](auto b) { return hn::OrAnd(hn::Set(T{}, 0x3F800000), b, hn::Set(T{}, 0x7FFFFF)); }, bits);
    const Vector<R> s = Vector<R>(mantissa.template as<R>()) - Vector<R>(1.5F);
    return fma(detail::from_whole<R>(exponent) - Vector<R>(detail::kBias<R>), Vector<R>(std::numbers::ln2_v<float>),
               detail::polynomial(s, detail::kLogFloat));
#endif
  } else {
    return detail::log_of_normal(u, Vector<R>(0));
  }
}

namespace detail {

/// Lanes computed one by one by the scalar library.
template <class R, class F>
[[gnu::noinline, gnu::const]] Vector<R> one_by_one(F f, Vector<R> x) noexcept {
  alignas(64) std::array<R, 64 / sizeof(R)> lane;
  x.store(lane.data());
  for (R& v : lane) v = f(v);
  return Vector<R>::load(lane.data());
}

/// sin and cos of arguments up to kReducible.
template <class R>
MOTE_INLINE numbers::SinCos<Vector<R>> reduced_sin_cos(const Vector<R>& x) {
  using V = Vector<R>;
  using I = Registers<Whole<R>>;
  using T = typename I::Tag;
  constexpr bool kFloat = std::is_same_v<R, float>;
  const V n = round(x * V(2 / kPi));
  V r;
  V rest(0);  // of the reduced argument
  if constexpr (kFloat) {
#if HWY_NATIVE_FMA
    // pi/2 in three parts; fused, each product is exact
    r = fnma(n, V(1.57079637050628662109375), x);
    r = fnma(n, V(-4.37113900018624283e-8), r);
    r = fnma(n, V(-1.71512451000588005e-15), r);
#else
    // pi/2 in parts of so few bits that n times a part is exact
    r = fnma(n, V(1.5703125), x);
    r = fnma(n, V(4.837512969970703125e-4), r);
    r = fnma(n, V(7.549789954891882e-8), r);
#endif
  } else {  // pi/2 in parts of 33, 33 and 53 bits: nothing is rounded but r, and what that loses is kept
    const V most = fnma(n, V(1.57079632673412561417e+00), x);
    const V second(6.07710050630396597660e-11);
    const V more = fnma(n, second, most);
    const V last = fnma(n, V(2.02226624879595063154e-21), fnma(n, second, most - more));
    r = more + last;
    rest = (more - r) + last;
  }
  const V z = r * r;
  V s;
  V c;
  if constexpr (kFloat) {
    s = fma(z * r, polynomial(z, std::array<double, 3>{-1.6666654611e-1, 8.3321608736e-3, -1.9515295891e-4}), r);
    c = fma(z * z,
            polynomial(z, std::array<double, 3>{4.166664568298827e-2, -1.388731625493765e-3, 2.443315711809948e-5}),
            fnma(z, V(0.5), V(1)));
  } else {
    s = r + fma(z * r,
                polynomial(z, std::array<double, 6>{-1.66666666666666307295e-1, 8.33333333332211858878e-3,
                                                    -1.98412698295895385996e-4, 2.75573136213857245213e-6,
                                                    -2.50507477628578072866e-8, 1.58962301576546568060e-10}),
                rest);
    const V correction =
        fma(z * z,
            polynomial(z, std::array<double, 6>{4.16666666666665929218e-2, -1.38888888888730564116e-3,
                                                2.48015872888517045348e-5, -2.75573141792967388112e-7,
                                                2.08757008419747316778e-9, -1.13585365213876817300e-11}),
            -(r * rest));
    c = fnma(z, V(0.5), V(1)) + correction;
  }
  // quarter q: (s, c), (c, -s), (-s, -c), (-c, s)
  const I q = to_whole(n);
  Mask<R> swapped;
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

/// The largest argument that reduced_sin_cos() reduces well.
template <class R>
inline constexpr double kReducible = HWY_NATIVE_FMA ? (std::is_same_v<R, float> ? 0x1p13 : 0x1p26)
                                                    : (std::is_same_v<R, float> ? 0x1p7 : 0x1p19);

/// True if every lane is an argument that reduced_sin_cos() reduces well.
template <class R>
MOTE_INLINE bool reducible(const Vector<R>& x) {
  return (abs(x) < Vector<R>(kReducible<R>)).bits() ==
         static_cast<std::uint32_t>((std::uint64_t{1} << Vector<R>::kLanes) - 1);
}

}  // namespace detail

template <class R>
MOTE_INLINE numbers::SinCos<Vector<R>> sin_cos(const Vector<R>& x) {
  if (!detail::reducible(x))
    return {detail::one_by_one([](R v) { return std::sin(v); }, x),
            detail::one_by_one([](R v) { return std::cos(v); }, x)};
  return detail::reduced_sin_cos(x);
}
template <class R>
MOTE_INLINE Vector<R> sin(const Vector<R>& x) {
  if (!detail::reducible(x)) return detail::one_by_one([](R v) { return std::sin(v); }, x);
  return detail::reduced_sin_cos(x).sine;
}
template <class R>
MOTE_INLINE Vector<R> cos(const Vector<R>& x) {
  if (!detail::reducible(x)) return detail::one_by_one([](R v) { return std::cos(v); }, x);
  return detail::reduced_sin_cos(x).cosine;
}
template <class R>
MOTE_INLINE Vector<R> tan(const Vector<R>& x) {
  if (!detail::reducible(x)) return detail::one_by_one([](R v) { return std::tan(v); }, x);
  const auto both = detail::reduced_sin_cos(x);
  return both.sine / both.cosine;
}

namespace detail {

/// atan(top / bottom) for 0 <= top <= bottom, top and bottom finite; 0 for 0/0.
template <class R>
MOTE_INLINE Vector<R> atan_of_ratio(const Vector<R>& top, const Vector<R>& bottom) {
  using V = Vector<R>;
  // above tan(pi/8): atan(t) = pi/4 + atan((t - 1) / (t + 1)), formed before the one division
  const auto steep = V(0.41421356237309504880) * bottom < top;
  const V numerator = select(steep, top - bottom, top);
  const V denominator = select(steep, top + bottom, bottom);
  const V t = numerator / max(V(std::numeric_limits<R>::min()), denominator);
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
template <class R>
MOTE_INLINE Vector<R> with_sign(const Vector<R>& v, const Vector<R>& s) {
  return Vector<R>::map([](auto a, auto b) { return hn::CopySign(a, b); }, v, s);
}

}  // namespace detail

template <class R>
MOTE_INLINE Vector<R> atan2(const Vector<R>& y, const Vector<R>& x) {
  using V = Vector<R>;
  const V largest(std::numeric_limits<R>::max());
  const V ay = min(largest, abs(y));  // in this order NaN goes through, here and in what follows
  const V ax = min(largest, abs(x));
  const auto swapped = ax < ay;
  V a = detail::atan_of_ratio(select(swapped, ax, ay), select(swapped, ay, ax));
  a = select(swapped, V(kPi / 2) - a, a);
  const auto behind = detail::with_sign(V(1), x) < V(0);
  return detail::with_sign(select(behind, V(kPi) - a, a), y);
}

template <class R>
MOTE_INLINE Vector<R> atan(const Vector<R>& x) {
  using V = Vector<R>;
  const V ax = abs(x);
  const auto swapped = V(1) < ax;
  const V a = detail::atan_of_ratio(select(swapped, V(1), min(ax, V(std::numeric_limits<R>::max()))),
                                    select(swapped, min(ax, V(std::numeric_limits<R>::max())), V(1)));
  return select(x == x, detail::with_sign(select(swapped, V(kPi / 2) - a, a), x), x);
}

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
