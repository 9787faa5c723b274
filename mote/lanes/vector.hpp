#pragma once
/// The vector number type: sixteen floats or eight doubles, one particle a lane, which models accept as their S.
///
/// A vector is one 512-bit register, two of 256 or four of 128 bits, whatever the file that includes this is compiled
/// for; its width in lanes never changes, so neither do the addresses of random numbers. Everything lives in a
/// namespace named after the instruction set: files compiled for different ones can be linked into one program. Built
/// on Highway; docs/decisions/0004-vector-library.md.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

// Highway 1.0.3 refuses -march=native on processors with VNNI and VBMI2 (Ice Lake and later) unless their target is
// asked for: it tests a macro that it does not define.
#ifndef HWY_WANT_AVX3_DL
#define HWY_WANT_AVX3_DL
#endif
#include <hwy/highway.h>

#include "mote/base/numbers.hpp"

#define MOTE_INLINE inline __attribute__((always_inline))

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// f(0), ..., f(kCount - 1) without a loop in the code: a loop inside a loop over particles, however short, keeps g++
/// from taking constants out of the outer one.
template <std::size_t kCount, class F>
MOTE_INLINE void unrolled(const F& f) {
  [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) { (f(k), ...); }
  (std::make_index_sequence<kCount>());
}

/// While it lives, subnormal numbers count as zero in the thread that made it: results below the least normal number
/// are flushed, operands too. Weights are full of them – a particle far off weighs 2^-130 – and some processors leave
/// the pipeline for every one, 150 cycles or more.
class SubnormalsAreZero {
 public:
  MOTE_INLINE SubnormalsAreZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlushResults | kFlushOperands); }
  MOTE_INLINE ~SubnormalsAreZero() { _mm_setcsr(before_); }
  SubnormalsAreZero(const SubnormalsAreZero&) = delete;
  SubnormalsAreZero(SubnormalsAreZero&&) = delete;
  SubnormalsAreZero& operator=(const SubnormalsAreZero&) = delete;
  SubnormalsAreZero& operator=(SubnormalsAreZero&&) = delete;

 private:
  static constexpr unsigned kFlushResults = 0x8000, kFlushOperands = 0x0040;
  unsigned before_;
};

/// Asks for the cache line at p to be in the second-level cache in a while; p may point anywhere. Blocks are pages of
/// their own to a processor, which foresees no further than the page it is in.
template <class T>
MOTE_INLINE void prefetch(const T* p) {
  __builtin_prefetch(p, 0, 2);
}

/// Lanes of a vector of R.
template <class R>
inline constexpr std::size_t kWidth = 64 / sizeof(R);

/// A vector of 64 bytes of T, as native registers: what Vector and the generators are made of.
template <class T>
struct Registers {
  static constexpr std::size_t kLanes = 64 / sizeof(T);
  using Tag = hn::CappedTag<T, 64 / sizeof(T)>;
  using Register = hn::Vec<Tag>;
  static constexpr std::size_t kPerRegister = hn::MaxLanes(Tag{});
  static constexpr std::size_t kCount = kLanes / kPerRegister;

  std::array<Register, kCount> r;

  static MOTE_INLINE Registers load(const T* from) {
    Registers out;
    unrolled<kCount>([&](std::size_t k) { out.r[k] = hn::LoadU(Tag{}, from + k * kPerRegister); });
    return out;
  }
  static MOTE_INLINE Registers all(T value) {
    Registers out;
    unrolled<kCount>([&](std::size_t k) { out.r[k] = hn::Set(Tag{}, value); });
    return out;
  }
  MOTE_INLINE void store(T* to) const {
    unrolled<kCount>([&](std::size_t k) { hn::StoreU(r[k], Tag{}, to + k * kPerRegister); });
  }
  /// f applied register by register.
  template <class F, class... Others>
  static MOTE_INLINE Registers map(F f, const Others&... others) {
    Registers out;
    unrolled<kCount>([&](std::size_t k) { out.r[k] = f(others.r[k]...); });
    return out;
  }
  /// The same bits as lanes of U.
  template <class U>
  MOTE_INLINE Registers<U> as() const {
    Registers<U> out;
    unrolled<kCount>([&](std::size_t k) { out.r[k] = hn::BitCast(typename Registers<U>::Tag{}, r[k]); });
    return out;
  }
};

/// Where a comparison holds, lane by lane.
template <class R>
struct Mask {
  using Parts = Registers<R>;
  using Register = hn::Mask<typename Parts::Tag>;
  std::array<Register, Parts::kCount> r;

  /// One bit a lane, lane 0 lowest.
  MOTE_INLINE std::uint32_t bits() const {
    std::uint32_t all = 0;
    for (std::size_t k = 0; k < r.size(); ++k) {
#if HWY_TARGET <= HWY_AVX3
      const auto low = static_cast<std::uint32_t>(r[k].raw);
#else
      std::array<std::uint8_t, 8> bytes{};
      hn::StoreMaskBits(typename Parts::Tag{}, r[k], bytes.data());
      const auto low = static_cast<std::uint32_t>(bytes[0] | (bytes[1] << 8U));
#endif
      all |= low << static_cast<std::uint32_t>(k * Parts::kPerRegister);
    }
    return all;
  }
  friend MOTE_INLINE Mask operator|(const Mask& a, const Mask& b) {
    Mask out;
    for (std::size_t k = 0; k < out.r.size(); ++k) out.r[k] = hn::Or(a.r[k], b.r[k]);
    return out;
  }
  MOTE_INLINE bool any() const {
    Register some = r[0];
    for (std::size_t k = 1; k < r.size(); ++k) some = hn::Or(some, r[k]);
    return !hn::AllFalse(typename Parts::Tag{}, some);
  }
};

/// kWidth<R> numbers at once: as many as a block's generators serve.
template <class R>
struct Vector {
  using Number = R;
  using Parts = Registers<R>;
  using Tag = typename Parts::Tag;
  static constexpr std::size_t kLanes = Parts::kLanes;

  Parts parts;

  Vector() = default;
  MOTE_INLINE explicit Vector(const Parts& p) : parts(p) {}
  /// The same number in every lane.
  template <class T>
  requires std::is_arithmetic_v<T> MOTE_INLINE explicit Vector(T all) : parts(Parts::all(static_cast<R>(all))) {}

  static MOTE_INLINE Vector load(const R* from) { return Vector(Parts::load(from)); }
  MOTE_INLINE void store(R* to) const { parts.store(to); }

  template <class F, class... Others>
  static MOTE_INLINE Vector map(F f, const Others&... others) {
    return Vector(Parts::map(f, others.parts...));
  }
  template <class F, class... Others>
  static MOTE_INLINE Mask<R> compare(F f, const Others&... others) {
    Mask<R> out;
    unrolled<Parts::kCount>([&](std::size_t k) { out.r[k] = f(others.parts.r[k]...); });
    return out;
  }

  friend MOTE_INLINE Vector operator+(const Vector& a, const Vector& b) {
    return map([](auto x, auto y) { return hn::Add(x, y); }, a, b);
  }
  friend MOTE_INLINE Vector operator-(const Vector& a, const Vector& b) {
    return map([](auto x, auto y) { return hn::Sub(x, y); }, a, b);
  }
  friend MOTE_INLINE Vector operator*(const Vector& a, const Vector& b) {
    return map([](auto x, auto y) { return hn::Mul(x, y); }, a, b);
  }
  friend MOTE_INLINE Vector operator-(const Vector& a) {
    return map([](auto x) { return hn::Neg(x); }, a);
  }
  friend MOTE_INLINE Mask<R> operator<(const Vector& a, const Vector& b) {
    return compare([](auto x, auto y) { return hn::Lt(x, y); }, a, b);
  }
  friend MOTE_INLINE Mask<R> operator==(const Vector& a, const Vector& b) {
    return compare([](auto x, auto y) { return hn::Eq(x, y); }, a, b);
  }
  friend MOTE_INLINE Mask<R> operator<=(const Vector& a, const Vector& b) {
    return compare([](auto x, auto y) { return hn::Le(x, y); }, a, b);
  }
  /// Quotient; error below 2.5 ulp where divisor and quotient are normal numbers, infinities and zeros as usual.
  friend MOTE_INLINE Vector operator/(const Vector& a, const Vector& b) {
#if HWY_TARGET <= HWY_AVX3
    // 14 bits of the reciprocal, then Newton. For b = 0 or infinite the correction is NaN, which max() replaces.
    if constexpr (std::is_same_v<R, float>) {
      return map(
          [](auto x, auto y) {
            const auto r = decltype(y){_mm512_rcp14_ps(y.raw)};
            const auto e =
                decltype(y){_mm512_max_ps(_mm512_fnmadd_ps(y.raw, r.raw, _mm512_set1_ps(2.0F)), _mm512_set1_ps(0.5F))};
            return hn::Mul(x, hn::Mul(r, e));
          },
          a, b);
    } else {
      return map(
          [](auto x, auto y) {
            const __m512d two = _mm512_set1_pd(2.0);
            const __m512d half = _mm512_set1_pd(0.5);
            __m512d r = _mm512_rcp14_pd(y.raw);
            r = _mm512_mul_pd(r, _mm512_max_pd(_mm512_fnmadd_pd(y.raw, r, two), half));
            r = _mm512_mul_pd(r, _mm512_max_pd(_mm512_fnmadd_pd(y.raw, r, two), half));
            return hn::Mul(x, decltype(y){r});
          },
          a, b);
    }
#else
    return map([](auto x, auto y) { return hn::Div(x, y); }, a, b);
#endif
  }
};

/// a where the mask holds, else b.
template <class R>
MOTE_INLINE Vector<R> select(const Mask<R>& m, const Vector<R>& a, const Vector<R>& b) {
  Vector<R> out;
  unrolled<Vector<R>::Parts::kCount>(
      [&](std::size_t k) { out.parts.r[k] = hn::IfThenElse(m.r[k], a.parts.r[k], b.parts.r[k]); });
  return out;
}
template <class R>
MOTE_INLINE Mask<R> less(const Vector<R>& a, const Vector<R>& b) {
  return a < b;
}
template <class R>
MOTE_INLINE Vector<R> abs(const Vector<R>& a) {
  return Vector<R>::map([](auto x) { return hn::Abs(x); }, a);
}
template <class R>
MOTE_INLINE Vector<R> sqrt(const Vector<R>& a) {
  return Vector<R>::map([](auto x) { return hn::Sqrt(x); }, a);
}
template <class R>
MOTE_INLINE Vector<R> floor(const Vector<R>& a) {
  return Vector<R>::map([](auto x) { return hn::Floor(x); }, a);
}
/// The nearest whole number, ties to even.
template <class R>
MOTE_INLINE Vector<R> round(const Vector<R>& a) {
  return Vector<R>::map([](auto x) { return hn::Round(x); }, a);
}
/// The larger; b where a is NaN.
template <class R>
MOTE_INLINE Vector<R> max(const Vector<R>& a, const Vector<R>& b) {
  return Vector<R>::map([](auto x, auto y) { return hn::Max(x, y); }, a, b);
}
template <class R>
MOTE_INLINE Vector<R> min(const Vector<R>& a, const Vector<R>& b) {
  return Vector<R>::map([](auto x, auto y) { return hn::Min(x, y); }, a, b);
}
/// a b + c in one rounding where the machine has it.
template <class R>
MOTE_INLINE Vector<R> fma(const Vector<R>& a, const Vector<R>& b, const Vector<R>& c) {
  return Vector<R>::map([](auto x, auto y, auto z) { return hn::MulAdd(x, y, z); }, a, b, c);
}
/// c - a b.
template <class R>
MOTE_INLINE Vector<R> fnma(const Vector<R>& a, const Vector<R>& b, const Vector<R>& c) {
  return Vector<R>::map([](auto x, auto y, auto z) { return hn::NegMulAdd(x, y, z); }, a, b, c);
}

/// entry(0) + entry(1) x + ... + entry(kDegree) x^kDegree by Horner's rule.
template <std::size_t kDegree, class R, class Entry>
MOTE_INLINE Vector<R> horner(const Vector<R>& x, const Entry& entry) {
  Vector<R> sum = entry(kDegree);
  unrolled<kDegree>([&](std::size_t step)
                        __attribute__((always_inline)) { sum = fma(sum, x, entry(kDegree - 1 - step)); });
  return sum;
}

/// The first `count` numbers at `from`, all of a vector if there are more; `rest` in the other lanes. Nothing else is
/// read.
template <class R>
MOTE_INLINE Vector<R> load_first(const R* from, std::size_t count, const Vector<R>& rest) {
#if HWY_TARGET <= HWY_AVX3
  const typename Vector<R>::Tag tag;
  const auto mask = hn::FirstN(tag, count);
  return Vector<R>::map([&](auto others) { return hn::IfThenElse(mask, hn::MaskedLoad(mask, tag, from), others); },
                        rest);
#else
  alignas(64) std::array<R, kWidth<R>> lane;
  rest.store(lane.data());
  std::copy_n(from, std::min(count, lane.size()), lane.data());
  return Vector<R>::load(lane.data());
#endif
}
/// Stores the first `count` lanes, all if that is more than there are. Nothing else is written.
template <class R>
MOTE_INLINE void store_first(const Vector<R>& a, std::size_t count, R* to) {
#if HWY_TARGET <= HWY_AVX3
  const typename Vector<R>::Tag tag;
  hn::BlendedStore(a.parts.r[0], hn::FirstN(tag, count), tag, to);
#else
  alignas(64) std::array<R, kWidth<R>> lane;
  a.store(lane.data());
  std::copy_n(lane.data(), std::min(count, lane.size()), to);
#endif
}

/// Lane 0.
template <class R>
MOTE_INLINE R first(const Vector<R>& a) {
  return hn::GetLane(a.parts.r[0]);
}
namespace detail {

/// The sum of a register's lanes, as sum() adds them.
template <class Register>
MOTE_INLINE double sum_of_halves(const Register& v) {
  using Tag = hn::DFromV<Register>;
  if constexpr (sizeof(Register) > 16) {
    const hn::Half<Tag> half;
    return sum_of_halves(hn::Add(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  } else {
    auto pair = v;
    if constexpr (hn::MaxLanes(Tag{}) > 2) pair = hn::Add(v, hn::Shuffle1032(v));
    return static_cast<double>(hn::GetLane(pair)) + static_cast<double>(hn::ExtractLane(pair, 1));
  }
}

}  // namespace detail

/// The sum of all lanes: halves are added until a pair is left, whose sum is formed in double.
template <class R>
MOTE_INLINE double sum(const Vector<R>& a) {
  auto parts = a.parts.r;
  for (std::size_t half = parts.size() / 2; half > 0; half /= 2)
    for (std::size_t k = 0; k < half; ++k) parts[k] = hn::Add(parts[k], parts[k + half]);
  return detail::sum_of_halves(parts[0]);
}
/// The largest lane.
template <class R>
MOTE_INLINE R largest(const Vector<R>& a) {
  auto high = a.parts.r[0];
  for (std::size_t k = 1; k < a.parts.r.size(); ++k) high = hn::Max(high, a.parts.r[k]);
  return hn::GetLane(hn::MaxOfLanes(typename Vector<R>::Tag{}, high));
}

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
