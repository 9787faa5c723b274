#pragma once
/// The addressed draws of base/draws.hpp, a vector of particles at a time: the same bits, eight generators side by
/// side.

#include "mote/base/draws.hpp"
#include "mote/lanes/normal_table.hpp"
#include "mote/lanes/vector.hpp"

namespace mote::lanes {
inline namespace HWY_NAMESPACE {

/// Eight xoshiro256++ generators side by side, keyed by an address.
///
/// cost    construction: two blocks of Philox4x32-10 over eight lanes; a word of each generator: ten instructions
class Generators {
 public:
  using Words = Registers<std::uint64_t>;

  explicit MOTE_INLINE Generators(const Address& address) {
    using Tag = Words::Tag;
    alignas(64) static constexpr std::array<std::uint64_t, 8> kLane{0, 1, 2, 3, 4, 5, 6, 7};
    const auto use = static_cast<std::uint32_t>(address.purpose) + (address.stream << 8U);
    std::array<Counter, 2> halves;
    for (std::uint64_t half = 0; half < 2; ++half)
      halves[half] = {
          Words::all(address.block), Words::all(address.step), Words::all(use),
          Words::map([&](auto lane) { return hn::Add(lane, hn::Set(Tag{}, 8 * half)); }, Words::load(kLane.data()))};
    encrypt(halves, address.seed);
    for (std::size_t half = 0; half < 2; ++half) {
      s_[2 * half] = joined(halves[half][0], halves[half][1]);
      s_[2 * half + 1] = joined(halves[half][2], halves[half][3]);
    }
  }

  /// The next word of every generator.
  MOTE_INLINE Words next() {
    const Words word = plus(rotated<23>(plus(s_[0], s_[3])), s_[0]);
    const Words t = Words::map([](auto x) { return hn::ShiftLeft<17>(x); }, s_[1]);
    const Words fourth = mixed_in(s_[3], s_[1]);
    const Words second = mixed_in(s_[1], s_[2], s_[0]);
    s_[2] = mixed_in(t, s_[2], s_[0]);
    s_[0] = mixed_in(s_[0], fourth);
    s_[1] = second;
    s_[3] = rotated<45>(fourth);
    return word;
  }

  /// What refines a float draw far in the tail, one word a generator; see Draw<float>::normal.
  const Words& refinement() const { return s_[1]; }

 private:
  static MOTE_INLINE Words plus(const Words& a, const Words& b) {
    return Words::map([](auto x, auto y) { return hn::Add(x, y); }, a, b);
  }
  static MOTE_INLINE Words mixed_in(const Words& a, const Words& b) {
    return Words::map([](auto x, auto y) { return hn::Xor(x, y); }, a, b);
  }
  static MOTE_INLINE Words mixed_in(const Words& a, const Words& b, const Words& c) {
    return Words::map([](auto x, auto y, auto z) { return hn::Xor3(x, y, z); }, a, b, c);
  }
  template <int kLeft>
  static MOTE_INLINE Words rotated(const Words& a) {
    return Words::map([](auto x) { return hn::RotateRight<64 - kLeft>(x); }, a);
  }
  static MOTE_INLINE Words joined(const Words& low, const Words& high) {
    return Words::map(
        [](auto l, auto h) { return hn::OrAnd(hn::ShiftLeft<32>(h), l, hn::Set(Words::Tag{}, 0xFFFFFFFFU)); }, low,
        high);
  }

  using Counter = std::array<Words, 4>;

  /// Philox4x32-10 of two counters on the low halves of 64-bit lanes; what it leaves in the high halves means nothing.
  static MOTE_INLINE void encrypt(std::array<Counter, 2>& counters, std::uint64_t seed) {
    using Tag = Words::Tag;
    using Halves = Registers<std::uint32_t>;
    const auto product = [](const Words& a, std::uint64_t factor) {
      return Words::map(
          [&](auto x) {
            const typename Halves::Tag halves;
            return hn::MulEven(hn::BitCast(halves, x), hn::BitCast(halves, hn::Set(Tag{}, factor)));
          },
          a);
    };
    const auto high = [](const Words& a) { return Words::map([](auto x) { return hn::ShiftRight<32>(x); }, a); };
    Words key0 = Words::all(seed);
    Words key1 = Words::all(seed >> 32U);
    unrolled<10>([&](std::size_t) __attribute__((always_inline)) {
      for (Counter& c : counters) {
        const Words first = product(c[0], 0xD2511F53U);
        const Words second = product(c[2], 0xCD9E8D57U);
        c[0] = mixed_in(high(second), c[1], key0);
        c[2] = mixed_in(high(first), c[3], key1);
        c[1] = second;
        c[3] = first;
      }
      key0 = plus(key0, Words::all(std::uint64_t{0x9E3779B9U}));
      key1 = plus(key1, Words::all(std::uint64_t{0xBB67AE85U}));
    });
  }

  std::array<Words, 4> s_;
};

/// The polynomials of the normal table in registers, where they fit.
template <class R>
class NormalPolynomials;

template <>
class NormalPolynomials<float> {
 public:
  MOTE_INLINE NormalPolynomials() : table_(&normal_table()) {
    for (std::size_t j = 0; j < c_.size(); ++j) {
      c_[j] = Registers<float>::load(table_->narrow[j].data());
#if HWY_TARGET == HWY_AVX2
      // the upper octaves have the entries 6 to 13, the lower ones 14, 15 and 0 to 5
      const auto [first, second] = c_[j].r;
      c_[j].r = {Registers<float>::Register{_mm256_blend_ps(first.raw, second.raw, 0x3F)}, Registers<float>::Register {
                   _mm256_blend_ps(second.raw, first.raw, 0x3F)
                 }};
#endif
    }
  }

  /// |z| for the numbers u = p 2^32.
  MOTE_INLINE Vector<float> operator()(const Registers<float>& u) const {
    Vector<float> least(u);
    return (*this)(u, least);
  }
  /// The same; `least` becomes no more than any of them that is far in the tail.
  MOTE_INLINE Vector<float> operator()(const Registers<float>& u, Vector<float>& least) const {
    const auto bits = u.template as<std::uint32_t>();
    const Vector<float> s = offset(bits);
    const auto exponent = Registers<std::uint32_t>::map([](auto x) { return hn::ShiftRight<23>(x); }, bits);
    const auto z = [&](std::size_t part) __attribute__((always_inline)) {
      return horner<NormalTable::kDegreeFloat>(
          s, [&](std::size_t j) __attribute__((always_inline)) { return entry(j, part, exponent); });
    };
#if HWY_TARGET == HWY_AVX2
    // one look-up has eight octaves, and few draws lie below them
    const Mask<float> low = Vector<float>(u) < Vector<float>(0x1p23F);
    if (__builtin_expect(low.any(), 0)) {
      least = min(least, Vector<float>(u));
      return select(low, z(1), z(0));
    }
#else
    least = min(least, Vector<float>(u));
#endif
    return z(0);
  }

 private:
  /// s of the polynomials.
  static MOTE_INLINE Vector<float> offset(const Registers<std::uint32_t>& u) {
    using Tag = Registers<std::uint32_t>::Tag;
    const auto v = Registers<std::uint32_t>::map(
        [](auto x) { return hn::OrAnd(hn::Set(Tag{}, 0x3F800000U), x, hn::Set(Tag{}, 0x7FFFFFU)); }, u);
    return Vector<float>(v.template as<float>()) - Vector<float>(1.5F);
  }
  /// Coefficients j of the octaves; AVX2: of the upper eight (part 0) or the lower eight (part 1).
  MOTE_INLINE Vector<float> entry(std::size_t j, [[maybe_unused]] std::size_t part,
                                  const Registers<std::uint32_t>& exponent) const {
#if HWY_TARGET <= HWY_AVX3
    using Register = Registers<float>::Register;
    return Vector<float>(Registers<float>{{ Register { _mm512_permutexvar_ps(exponent.r[0].raw, c_[j].r[0].raw) } }});
#elif HWY_TARGET == HWY_AVX2
    // an entry is found by its exponent mod 8, which is 6 for the lowest octave of each part
    return Vector<float>(Registers<float>::map(
        [&](auto e) { return Registers<float>::Register{_mm256_permutevar8x32_ps(c_[j].r[part].raw, e.raw)}; },
        exponent));
#else
    return Vector<float>(Registers<float>::map(
        [&](auto e) {
          const Registers<std::int32_t>::Tag tag;
          return hn::GatherIndex(Registers<float>::Tag{}, table_->narrow[j].data(),
                                 hn::And(hn::BitCast(tag, e), hn::Set(tag, 15)));
        },
        exponent));
#endif
  }

  const NormalTable* table_;
  std::array<Registers<float>, NormalTable::kDegreeFloat + 1> c_;
};

template <>
class NormalPolynomials<double> {
 public:
  NormalPolynomials() : table_(&normal_table()) {}

#if HWY_TARGET <= HWY_AVX3
  /// |z| for the numbers u = p 2^64, p >= 2^-9, given by their bits.
  MOTE_INLINE Vector<double> operator()(const Registers<std::uint64_t>& u) const { return from(table_->halves, u); }
  /// The same for 2^-17 <= p < 2^-9.
  MOTE_INLINE Vector<double> low(const Registers<std::uint64_t>& u) const { return from(table_->halves_low, u); }

 private:
  using Part = std::array<std::array<double, 16>, NormalTable::kDegreeHalves + 1>;

  static MOTE_INLINE Vector<double> from(const Part& part, const Registers<std::uint64_t>& u) {
    using Tag = Registers<std::uint64_t>::Tag;
    using Register = Registers<double>::Register;
    // without its highest bit the mantissa is that of v or of v - 1/2, both in [1, 3/2)
    const auto v = Registers<std::uint64_t>::map(
        [](auto x) { return hn::OrAnd(hn::Set(Tag{}, 0x3FF0000000000000ULL), x, hn::Set(Tag{}, 0x7FFFFFFFFFFFFULL)); },
        u);
    const Vector<double> s = Vector<double>(v.template as<double>()) - Vector<double>(1.25);
    const __m512i half_octave = _mm512_srli_epi64(u.r[0].raw, 51);  // of which the look-up takes four bits
    return horner<NormalTable::kDegreeHalves>(
        s, [&](std::size_t j) __attribute__((always_inline)) {
          return Vector<double>(Registers<double>{
              { Register {
                _mm512_permutex2var_pd(_mm512_load_pd(part[j].data()), half_octave, _mm512_load_pd(part[j].data() + 8))
              } }});
        });
  }
#else
  /// |z| for the numbers u = p 2^64, p >= 2^-17, given by their bits.
  MOTE_INLINE Vector<double> operator()(const Registers<std::uint64_t>& u) const {
    return Vector<double>(Registers<double>::map([&](auto x) { return of(x); }, u));
  }

 private:
  static_assert(NormalTable::kDegreeFine == 3);
  using Number = Registers<double>::Tag;
  using Register = Registers<double>::Register;

  MOTE_INLINE Register of(Registers<std::uint64_t>::Register u) const {
    constexpr Registers<std::uint64_t>::Tag bits;
    constexpr std::uint64_t kPiece = (std::uint64_t{1} << (52 - NormalTable::kFineBits)) - 1;  // of the mantissa
    const auto v = hn::OrAnd(hn::Set(bits, 0x3FF0000000000000ULL), u, hn::Set(bits, kPiece));
    const Register s = hn::Sub(hn::BitCast(Number{}, v), hn::Set(Number{}, 1.0 + NormalTable::kFineHalf));
    // where the row of octave and piece begins
    constexpr std::uint64_t kRows = std::uint64_t{NormalTable::kOctaves} << NormalTable::kFineBits;
    alignas(32) std::array<std::uint64_t, Registers<double>::kPerRegister> begin;
    hn::Store(hn::And(hn::ShiftRight<50 - NormalTable::kFineBits>(u), hn::Set(bits, 4 * kRows - 4)), bits,
              begin.data());
    // rows become columns: two neighbouring coefficients of lanes 0 and 2, and of 1 and 3
    const auto two_of = [&](std::size_t lane, std::size_t j) __attribute__((always_inline)) {
      const double* const row = table_->fine[0].data() + j;
#if HWY_TARGET == HWY_AVX2
      const __m256d low = _mm256_castpd128_pd256(_mm_load_pd(row + begin[lane]));
      return Register{_mm256_insertf128_pd(low, _mm_load_pd(row + begin[lane + 2]), 1)};
#else
      return Register{_mm_load_pd(row + begin[lane])};
#endif
    };
    const Register even_high = two_of(0, 2);
    const Register odd_high = two_of(1, 2);
    Register z =
        hn::MulAdd(hn::InterleaveUpper(Number{}, even_high, odd_high), s, hn::InterleaveLower(even_high, odd_high));
    const Register even = two_of(0, 0);
    const Register odd = two_of(1, 0);
    z = hn::MulAdd(z, s, hn::InterleaveUpper(Number{}, even, odd));
    return hn::MulAdd(z, s, hn::InterleaveLower(even, odd));
  }
#endif

  const NormalTable* table_;
};

/// The draws of kWidth<R> neighbouring particles of a block: what a model receives as `draw` when S is a vector.
///
/// Uniform numbers and the bits behind every draw equal those of Draw<R>; normal numbers differ by the table's error.
template <class R>
class VectorDraw {
 public:
  explicit MOTE_INLINE VectorDraw(const Address& address) : generators_(address) {}
  using Bits = std::conditional_t<std::is_same_v<R, float>, std::uint32_t, std::uint64_t>;

  MOTE_INLINE Vector<R> normal() { return normal_of(next_bits()); }
  /// The normal numbers of given bits: normal_from_bits() but for the table's error.
  MOTE_INLINE Vector<R> normal_of(const Registers<Bits>& bits) const {
    if constexpr (std::is_same_v<R, float>) {
      return normal_float(bits);
    } else {
      return normal_double(bits);
    }
  }

  /// Whether near_normal() pays: AVX-512 looks up doubles in two tables, the second of which is rare.
  static constexpr bool kHasNear = std::is_same_v<R, float> || HWY_TARGET > HWY_AVX3;

  /// A normal number unless it is far in the tail, and then `least` is left below kTail: see make_ready().
  MOTE_INLINE Vector<R> near_normal(Vector<R>& least) requires kHasNear {
    if constexpr (std::is_same_v<R, float>) {
      const auto bits = next_bits();
      return signed_as(polynomials_(magnitude(bits), least), bits);
    } else {
      const auto bits = next_bits();
      const Registers<double> u = magnitude(bits);
      least = min(least, Vector<double>(u));
      return signed_as(polynomials_(u.template as<std::uint64_t>()), bits);
    }
  }
  static constexpr R kTail = std::is_same_v<R, float> ? R(0x1p15) : R(0x1p47);  ///< 2^-17 of all magnitudes

  MOTE_INLINE Vector<R> uniform() { return uniform_of(next_bits()); }
  /// uniform_from_bits() of given bits.
  static MOTE_INLINE Vector<R> uniform_of(const Registers<Bits>& bits) {
    using Tag = typename Registers<Bits>::Tag;
    if constexpr (std::is_same_v<R, float>) {
      // 1 + k 2^-23 by its bits, minus what centres it: exactly (k + 1/2) 2^-23
      const auto one_to_two =
          Registers<Bits>::map([](auto x) { return hn::Or(hn::ShiftRight<9>(x), hn::Set(Tag{}, 0x3F800000U)); }, bits);
      return Vector<float>(one_to_two.template as<float>()) - Vector<float>(1.0F - 0x1p-24F);
    } else {
      const auto one_to_two = Registers<Bits>::map(
          [](auto x) { return hn::Or(hn::ShiftRight<12>(x), hn::Set(Tag{}, 0x3FF0000000000000ULL)); }, bits);
      return Vector<double>(one_to_two.template as<double>()) - Vector<double>(1.0 - 0x1p-53);
    }
  }

  /// Uniform indices in {0, ..., n-1}, one a lane; those of Draw<R>.
  ///
  /// shape   to: (kWidth<R>,); n <= 2^28
  MOTE_INLINE void index(std::uint32_t n, std::uint32_t* to) {
    using Words = Generators::Words;
    using Halves = Registers<std::uint32_t>;
    const auto times_n = [&](const Words& words) {  // of the low halves
      return Words::map(
          [&](auto w) {
            const typename Halves::Tag halves_of;
            return hn::MulEven(hn::BitCast(halves_of, w), hn::Set(halves_of, n));
          },
          words);
    };
    const Words words = generators_.next();
    const Words low = times_n(words);
    const Words high = times_n(Words::map([](auto w) { return hn::ShiftRight<32>(w); }, words));
    constexpr std::size_t kPer = Words::kPerRegister;
    if constexpr (std::is_same_v<R, float>) {
      const hn::Rebind<std::uint32_t, Words::Tag> narrow;
      for (std::size_t k = 0; k < Words::kCount; ++k) {
        hn::StoreU(hn::TruncateTo(narrow, hn::ShiftRight<32>(low.r[k])), narrow, to + k * kPer);
        hn::StoreU(hn::TruncateTo(narrow, hn::ShiftRight<32>(high.r[k])), narrow, to + 8 + k * kPer);
      }
    } else {
      for (std::size_t k = 0; k < Words::kCount; ++k) {
        const hn::Rebind<std::uint32_t, Words::Tag> narrow;
        const auto product = hn::Add(high.r[k], hn::ShiftRight<32>(low.r[k]));
        hn::StoreU(hn::TruncateTo(narrow, hn::ShiftRight<32>(product)), narrow, to + k * kPer);
      }
    }
  }

 private:
  static constexpr int kXorOfAnd = 0x78;  // a ^ (b & c), as a truth table

  /// The bits of the next draws.
  MOTE_INLINE Registers<Bits> next_bits() {
    if constexpr (std::is_same_v<R, float>) {
      return halves(generators_.next());
    } else {
      return generators_.next();
    }
  }

  /// Low halves of the eight words, then their high halves: the order of the sixteen particles.
  static MOTE_INLINE Registers<std::uint32_t> halves(const Generators::Words& words) {
    using U = Registers<std::uint32_t>;
    const U u = words.template as<std::uint32_t>();
#if HWY_TARGET <= HWY_AVX3
    const __m512i order = _mm512_set_epi32(15, 13, 11, 9, 7, 5, 3, 1, 14, 12, 10, 8, 6, 4, 2, 0);
    return U{{U::Register{_mm512_permutexvar_epi32(order, u.r[0].raw)}}};
#else
    U out;
    constexpr std::size_t kPairs = U::kCount / 2;
    for (std::size_t k = 0; k < kPairs; ++k) {
      out.r[k] = hn::ConcatEven(U::Tag{}, u.r[2 * k + 1], u.r[2 * k]);
      out.r[kPairs + k] = hn::ConcatOdd(U::Tag{}, u.r[2 * k + 1], u.r[2 * k]);
    }
    return out;
#endif
  }

  /// p 2^32 of the draw's magnitude.
  static MOTE_INLINE Registers<float> magnitude(const Registers<std::uint32_t>& bits) {
    using Tag = Registers<std::uint32_t>::Tag;
    const auto m = Registers<std::uint32_t>::map([](auto b) { return hn::And(b, hn::Set(Tag{}, 0x7FFFFFFFU)); }, bits);
#if HWY_TARGET <= HWY_AVX3
    return {{Registers<float>::Register{_mm512_cvt_roundepi32_ps(m.r[0].raw, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC)}}};
#else
    return Registers<float>::map(
        [](auto x) {
          const Registers<float>::Tag tag;
          const auto whole = hn::BitCast(Registers<std::int32_t>::Tag{}, x);
          return hn::Min(hn::ConvertTo(tag, whole), hn::Set(tag, 2147483520.0F));  // rounded up it would be 2^31
        },
        m);
#endif
  }

  /// p 2^64 of the draw's magnitude; rounded up it would be 2^63.
  static MOTE_INLINE Registers<double> magnitude(const Registers<std::uint64_t>& bits) {
    const auto m = Registers<std::uint64_t>::map(
        [](auto b) { return hn::And(b, hn::Set(Registers<std::uint64_t>::Tag{}, 0x7FFFFFFFFFFFFFFFULL)); }, bits);
#if HWY_TARGET <= HWY_AVX3
    return {
        {Registers<double>::Register{_mm512_cvt_roundepi64_pd(m.r[0].raw, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC)}}};
#else
    return Registers<double>::map(
        [](auto x) {
          const Registers<double>::Tag tag;
          const auto whole = hn::BitCast(Registers<std::int64_t>::Tag{}, x);
          return hn::Min(hn::ConvertTo(tag, whole), hn::Set(tag, 9223372036854774784.0));
        },
        m);
#endif
  }

  MOTE_INLINE Vector<float> normal_float(const Registers<std::uint32_t>& bits) const {
    const Registers<float> u = magnitude(bits);
    Vector<float> z = polynomials_(u);
    const Mask<float> rare = Vector<float>(u) < Vector<float>(kTail);
    if (__builtin_expect(rare.any(), 0)) z = tail(z, bits, generators_.refinement(), rare.bits());
    return signed_as(z, bits);
  }

  MOTE_INLINE Vector<double> normal_double(const Registers<std::uint64_t>& bits) const {
    const Registers<double> u = magnitude(bits);
    Vector<double> z = polynomials_(u.template as<std::uint64_t>());
#if HWY_TARGET <= HWY_AVX3
    const Mask<double> low = Vector<double>(u) < Vector<double>(0x1p55);
    if (__builtin_expect(!low.any(), 1)) return signed_as(z, bits);
    z = select(low, polynomials_.low(u.template as<std::uint64_t>()), z);
#endif
    const Mask<double> rare = Vector<double>(u) < Vector<double>(kTail);
    if (__builtin_expect(rare.any(), 0)) z = tail(z, bits, generators_.refinement(), rare.bits());
    return signed_as(z, bits);
  }

  template <class U>
  static MOTE_INLINE Vector<R> signed_as(const Vector<R>& z, const Registers<U>& bits) {
#if HWY_TARGET <= HWY_AVX3
    if constexpr (std::is_same_v<R, float>) {
      const __m512i value = _mm512_castps_si512(z.parts.r[0].raw);
      return Vector<R>(Registers<R>{{typename Registers<R>::Register{_mm512_castsi512_ps(
          _mm512_ternarylogic_epi32(value, bits.r[0].raw, _mm512_set1_epi32(INT32_MIN), kXorOfAnd))}}});
    } else {
      const __m512i value = _mm512_castpd_si512(z.parts.r[0].raw);
      return Vector<R>(Registers<R>{{typename Registers<R>::Register{_mm512_castsi512_pd(
          _mm512_ternarylogic_epi64(value, bits.r[0].raw, _mm512_set1_epi64(INT64_MIN), kXorOfAnd))}}});
    }
#else
    return Vector<R>(Registers<R>::map(
        [](auto value, auto b) {
          const auto sign = hn::Set(typename Registers<U>::Tag{}, U{1} << (8 * sizeof(U) - 1));
          return hn::Xor(value, hn::BitCast(typename Registers<R>::Tag{}, hn::And(b, sign)));
        },
        z.parts, bits));
#endif
  }

  /// Draws of less than 2^-17 probability, one by one from the quantile itself; signed_as() gives them their sign.
  ///
  template <class U>
  [[gnu::noinline, gnu::const]] static Vector<R> tail(Vector<R> z, Registers<U> bits, Generators::Words refinement,
                                                      std::uint32_t rare) noexcept {
    alignas(64) std::array<R, kWidth<R>> value;
    alignas(64) std::array<U, kWidth<R>> word;
    z.store(value.data());
    bits.store(word.data());
    alignas(64) std::array<std::uint64_t, 8> more;
    refinement.store(more.data());
    for (std::size_t i = 0; i < kWidth<R>; ++i) {
      if ((rare >> i & 1U) == 0) continue;
      if constexpr (std::is_same_v<R, float>) {
        value[i] = std::abs(normal_from_bits(word[i], mixed(more[i % 8] + i / 8)));
      } else {
        value[i] = std::abs(normal_from_bits(word[i]));
      }
    }
    return Vector<R>::load(value.data());
  }

  Generators generators_;
  NormalPolynomials<R> polynomials_;
};

}  // namespace HWY_NAMESPACE
}  // namespace mote::lanes
