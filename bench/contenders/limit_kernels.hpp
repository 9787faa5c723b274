#pragma once
/// The bootstrap filter of the growth model fused by hand for AVX-512: how fast this machine could be.
///
/// What makes it fast: normal numbers by a table of polynomials (no logarithm, no cosine), a reciprocal with a Newton
/// step, exp2 by a polynomial and a scale, weights scanned 16 at a time in registers about a double position per chunk,
/// survivors compressed and expanded without a gather, no search for the largest weight: where the sum underflows, a
/// cold pass weighs again.
///
/// Passes over N numbers of the state's type R and of float: propagate reads the parents, writes states and weights;
/// resample reads both, writes the children, and writes, reads and clears a flag of one byte: 4 R + 8 + 3 bytes.
///
/// Included by limit_float.cpp and limit_double.cpp alone, which are compiled for AVX-512; everything here has internal
/// linkage and calls no template of the standard library, so that none of its code can serve another machine.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <immintrin.h>

#include "bench/contenders/contender.hpp"

namespace mote::contenders {
namespace {

inline constexpr std::size_t kLanes = 16;    // floats of a vector
inline constexpr std::size_t kChunk = 1024;  // particles between two double positions
inline constexpr double kTooMany = 65000;    // children of a chunk whose places do not fit into 16 bits
inline constexpr double kLeastWeight = 1e-25;

#define MOTE_LIMIT_INLINE inline __attribute__((always_inline))

/// Memory for whole vectors, zeroed, freed with its owner.
template <class T>
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { std::free(memory_); }  // NOLINT(cppcoreguidelines-no-malloc)

  void make(std::size_t count) {
    std::free(memory_);  // NOLINT(cppcoreguidelines-no-malloc)
    const std::size_t bytes = (count * sizeof(T) + 4095) / 4096 * 4096;
    memory_ = static_cast<T*>(std::aligned_alloc(4096, bytes));
    if (memory_ == nullptr) std::abort();
    std::memset(memory_, 0, bytes);
  }
  T* data() { return memory_; }
  T& operator[](std::size_t i) { return memory_[i]; }

 private:
  T* memory_ = nullptr;
};

template <class T>
T smaller(T a, T b) {
  return b < a ? b : a;
}
template <class T>
T larger(T a, T b) {
  return a < b ? b : a;
}

// ---- normal numbers ----

/// z >= 0 with Phi(-z) = p, for 0 < p <= 1/2: Acklam's rational approximation and two steps of Halley.
inline double upper_quantile(double p) {
  double x = 0;
  if (p < 0.02425) {
    const double q = std::sqrt(-2 * std::log(p));
    const double above =
        ((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838) * q - 2.549732539343734) * q +
         4.374664141464968) *
            q +
        2.938163982698783;
    const double below =
        (((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996) * q + 3.754408661907416) * q + 1;
    x = above / below;
  } else {
    const double q = p - 0.5;
    const double r = q * q;
    const double above = (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
                            1.383577518672690e+02) *
                               r -
                           3.066479806614716e+01) *
                              r +
                          2.506628277459239) *
                         q;
    const double below = ((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
                           6.680131188771972e+01) *
                              r -
                          1.328068155288572e+01) *
                             r +
                         1;
    x = above / below;
  }
  for (int round = 0; round < 2; ++round) {
    const double excess = 0.5 * std::erfc(-x / std::sqrt(2.0)) - p;
    const double u = excess * std::sqrt(2 * 3.14159265358979323846) * std::exp(x * x / 2);
    x -= u / (1 + x * u / 2);
  }
  return -x;
}

inline constexpr int kDegree = 5;

/// The normal quantile as one polynomial for each binary exponent of p: coefficients by degree and exponent.
struct NormalTable {
  alignas(64) float coefficients[kDegree + 1][kLanes];

  NormalTable() {
    for (int piece = 0; piece < static_cast<int>(kLanes); ++piece) fit(142 + piece);
  }

 private:
  /// Fits the piece p = v 2^(exponent - 159), 1 <= v < 2, through Chebyshev's points, by Gauss-Jordan elimination.
  void fit(int exponent) {
    double rows[kDegree + 1][kDegree + 2];
    for (int i = 0; i <= kDegree; ++i) {
      const double offset = 0.5 * std::cos(3.14159265358979323846 * (i + 0.5) / (kDegree + 1));  // v - 1.5
      double power = 1;
      for (int j = 0; j <= kDegree; ++j, power *= offset) rows[i][j] = power;
      rows[i][kDegree + 1] = upper_quantile(std::ldexp(1.5 + offset, exponent - 159));
    }
    for (int i = 0; i <= kDegree; ++i) eliminate(rows, i);
    for (int j = 0; j <= kDegree; ++j)
      coefficients[j][exponent & 15] = static_cast<float>(rows[j][kDegree + 1] / rows[j][j]);
  }

  static void eliminate(double (&rows)[kDegree + 1][kDegree + 2], int i) {
    int pivot = i;
    for (int r = i + 1; r <= kDegree; ++r)
      if (std::fabs(rows[r][i]) > std::fabs(rows[pivot][i])) pivot = r;
    for (int c = 0; c <= kDegree + 1; ++c) {
      const double kept = rows[i][c];
      rows[i][c] = rows[pivot][c];
      rows[pivot][c] = kept;
    }
    for (int r = 0; r <= kDegree; ++r) {
      if (r == i) continue;
      const double factor = rows[r][i] / rows[i][i];
      for (int c = i; c <= kDegree + 1; ++c) rows[r][c] -= factor * rows[i][c];
    }
  }
};

/// Scatters a seed over 64 bits.
struct SplitMix {
  std::uint64_t state;
  std::uint64_t next() {
    state += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }
  /// In (0, 1).
  double uniform() { return (static_cast<double>(next() >> 12U) + 0.5) * 0x1p-52; }
};

/// Sixteen xoshiro128+ side by side.
struct Generator {
  __m512i s0, s1, s2, s3;

  explicit Generator(std::uint64_t seed) {
    SplitMix source{seed};
    alignas(64) std::uint32_t words[4 * kLanes];
    for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(source.next() >> 16U);
    s0 = _mm512_load_si512(words);
    s1 = _mm512_load_si512(words + kLanes);
    s2 = _mm512_load_si512(words + 2 * kLanes);
    s3 = _mm512_load_si512(words + 3 * kLanes);
  }

  MOTE_LIMIT_INLINE __m512i next() {
    const __m512i word = _mm512_add_epi32(s0, s3);
    const __m512i shifted = _mm512_slli_epi32(s1, 9);
    s2 = _mm512_xor_si512(s2, s0);
    s3 = _mm512_xor_si512(s3, s1);
    s1 = _mm512_xor_si512(s1, s2);
    s0 = _mm512_xor_si512(s0, s3);
    s2 = _mm512_xor_si512(s2, shifted);
    s3 = _mm512_rol_epi32(s3, 11);
    return word;
  }
};

/// The table in registers.
struct LoadedTable {
  __m512 degree[kDegree + 1];
  explicit LoadedTable(const NormalTable& table) {
    for (int j = 0; j <= kDegree; ++j) degree[j] = _mm512_load_ps(table.coefficients[j]);
  }
};

/// The lanes below the table's first piece, once in 65536 draws, one by one.
__attribute__((noinline)) inline __m512 with_tails(__m512 normals, __m512i magnitudes, __mmask16 tails) {
  alignas(64) float z[kLanes];
  alignas(64) std::uint32_t m[kLanes];
  _mm512_store_ps(z, normals);
  _mm512_store_si512(m, magnitudes);
  for (unsigned i = 0; i < kLanes; ++i)
    if (((tails >> i) & 1U) != 0) z[i] = static_cast<float>(upper_quantile((m[i] + 0.5) * 0x1p-32));
  return _mm512_load_ps(z);
}

/// Sixteen standard normal numbers from 32 bits each: 31 for the magnitude by the quantile function, one for the sign.
MOTE_LIMIT_INLINE __m512 normal(Generator& generator, const LoadedTable& table) {
  const __m512i word = generator.next();
  const __m512i magnitude = _mm512_and_si512(word, _mm512_set1_epi32(0x7fffffff));
  const __m512i bits = _mm512_castps_si512(_mm512_cvt_roundepi32_ps(magnitude, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC));
  const __m512i piece = _mm512_srli_epi32(bits, 23);
  const __m512i mantissa =  // (bits & A) | B
      _mm512_ternarylogic_epi32(bits, _mm512_set1_epi32(0x7fffff), _mm512_set1_epi32(0x3f800000), 0xEA);
  const __m512 offset = _mm512_sub_ps(_mm512_castsi512_ps(mantissa), _mm512_set1_ps(1.5F));
  __m512 z = _mm512_permutexvar_ps(piece, table.degree[kDegree]);
  for (int j = kDegree - 1; j >= 0; --j) z = _mm512_fmadd_ps(z, offset, _mm512_permutexvar_ps(piece, table.degree[j]));
  const __mmask16 tails = _mm512_cmplt_epi32_mask(magnitude, _mm512_set1_epi32(1 << 15));
  if (__builtin_expect(tails != 0, 0)) z = with_tails(z, magnitude, tails);
  const __m512i sign = _mm512_set1_epi32(static_cast<int>(0x80000000U));
  return _mm512_castsi512_ps(_mm512_ternarylogic_epi32(_mm512_castps_si512(z), word, sign, 0x78));  // z ^ (word & sign)
}

// ---- the model ----

MOTE_LIMIT_INLINE __m512 moved(__m512 x, __m512 push, __m512 z) {
  const __m512 below = _mm512_fmadd_ps(x, x, _mm512_set1_ps(1));
  __m512 inverse = _mm512_rcp14_ps(below);
  inverse = _mm512_mul_ps(inverse, _mm512_fnmadd_ps(below, inverse, _mm512_set1_ps(2)));
  const __m512 slope = _mm512_fmadd_ps(_mm512_set1_ps(25), inverse, _mm512_set1_ps(0.5F));
  return _mm512_fmadd_ps(z, _mm512_set1_ps(3.16227766F), _mm512_fmadd_ps(x, slope, push));
}

MOTE_LIMIT_INLINE __m512d moved(__m512d x, __m512d push, __m512d z) {
  const __m512d one = _mm512_set1_pd(1);
  const __m512d below = _mm512_fmadd_pd(x, x, one);
  __m512d inverse = _mm512_rcp14_pd(below);
  for (int round = 0; round < 2; ++round)
    inverse = _mm512_fmadd_pd(inverse, _mm512_fnmadd_pd(below, inverse, one), inverse);
  const __m512d slope = _mm512_fmadd_pd(_mm512_set1_pd(25), inverse, _mm512_set1_pd(0.5));
  return _mm512_fmadd_pd(z, _mm512_set1_pd(3.1622776601683795), _mm512_fmadd_pd(x, slope, push));
}

/// exp(-(y - x^2 / 20)^2 / 2) as 2 to a power, its fraction by a polynomial of degree 5.
MOTE_LIMIT_INLINE __m512 weight(__m512 x, __m512 y) {
  __m512 error = _mm512_fnmadd_ps(_mm512_mul_ps(x, _mm512_set1_ps(0.05F)), x, y);
  error = _mm512_mul_ps(error, error);
  const __m512 power = _mm512_mul_ps(error, _mm512_set1_ps(-0.72134752F));
  const __m512 fraction = _mm512_reduce_ps(power, 0);
  __m512 p = _mm512_set1_ps(1.33908e-3F);
  for (const float coefficient : {9.6184373e-3F, 5.5503324e-2F, 2.4022651e-1F, 6.9314718e-1F, 1.0F})
    p = _mm512_fmadd_ps(p, fraction, _mm512_set1_ps(coefficient));
  return _mm512_scalef_ps(p, _mm512_sub_ps(power, fraction));
}

/// The same in double, by Taylor's polynomial of degree 11.
MOTE_LIMIT_INLINE __m512d weight(__m512d x, __m512d y) {
  __m512d error = _mm512_fnmadd_pd(_mm512_mul_pd(x, _mm512_set1_pd(0.05)), x, y);
  error = _mm512_mul_pd(error, error);
  const __m512d power = _mm512_mul_pd(error, _mm512_set1_pd(-0.72134752044448170));
  const __m512d fraction = _mm512_reduce_pd(power, 0);
  double coefficients[12] = {1};
  for (int k = 1; k < 12; ++k) coefficients[k] = coefficients[k - 1] * 0.693147180559945309417 / k;
  __m512d p = _mm512_set1_pd(coefficients[11]);
  for (int k = 10; k >= 0; --k) p = _mm512_fmadd_pd(p, fraction, _mm512_set1_pd(coefficients[k]));
  return _mm512_scalef_pd(p, _mm512_sub_pd(power, fraction));
}

// ---- what depends on the type of the states ----

MOTE_LIMIT_INLINE __m512d low_half(__m512 v) { return _mm512_cvtps_pd(_mm512_castps512_ps256(v)); }
MOTE_LIMIT_INLINE __m512d high_half(__m512 v) { return _mm512_cvtps_pd(_mm512_extractf32x8_ps(v, 1)); }

/// x = scale z for 16 particles.
MOTE_LIMIT_INLINE void store_scaled(float* x, double scale, __m512 z) {
  _mm512_store_ps(x, _mm512_mul_ps(z, _mm512_set1_ps(static_cast<float>(scale))));
}
MOTE_LIMIT_INLINE void store_scaled(double* x, double scale, __m512 z) {
  _mm512_store_pd(x, _mm512_mul_pd(low_half(z), _mm512_set1_pd(scale)));
  _mm512_store_pd(x + 8, _mm512_mul_pd(high_half(z), _mm512_set1_pd(scale)));
}

/// Sums of w and w x over a chunk.
template <class R>
struct Sums;

template <>
struct Sums<float> {
  __m512 push, observation;
  __m512 weights = _mm512_setzero_ps(), moments = _mm512_setzero_ps();

  Sums(double c, double y)
      : push(_mm512_set1_ps(static_cast<float>(c))), observation(_mm512_set1_ps(static_cast<float>(y))) {}
  /// Moves and weighs 16 particles, of which the mask's count.
  MOTE_LIMIT_INLINE void step(const float* parents, __m512 z, float* x, float* w, __mmask16 counted) {
    const __m512 state = moved(_mm512_load_ps(parents), push, z);
    const __m512 weighed = _mm512_maskz_mov_ps(counted, weight(state, observation));
    _mm512_store_ps(x, state);
    _mm512_store_ps(w, weighed);
    weights = _mm512_add_ps(weights, weighed);
    moments = _mm512_fmadd_ps(weighed, state, moments);
  }
  double weight_sum() const { return static_cast<double>(_mm512_reduce_add_ps(weights)); }
  double moment_sum() const { return static_cast<double>(_mm512_reduce_add_ps(moments)); }
};

template <>
struct Sums<double> {
  __m512d push, observation;
  __m512d weights = _mm512_setzero_pd(), moments = _mm512_setzero_pd();

  Sums(double c, double y) : push(_mm512_set1_pd(c)), observation(_mm512_set1_pd(y)) {}
  MOTE_LIMIT_INLINE void step(const double* parents, __m512 z, double* x, float* w, __mmask16 counted) {
    half(parents, low_half(z), x, w, static_cast<__mmask8>(counted & 255U));
    half(parents + 8, high_half(z), x + 8, w + 8, static_cast<__mmask8>(counted >> 8U));
  }
  MOTE_LIMIT_INLINE void half(const double* parents, __m512d z, double* x, float* w, __mmask8 counted) {
    const __m512d state = moved(_mm512_load_pd(parents), push, z);
    const __m512d weighed = _mm512_maskz_mov_pd(counted, weight(state, observation));
    _mm512_store_pd(x, state);
    _mm256_store_ps(w, _mm512_cvtpd_ps(weighed));
    weights = _mm512_add_pd(weights, weighed);
    moments = _mm512_fmadd_pd(weighed, state, moments);
  }
  double weight_sum() const { return _mm512_reduce_add_pd(weights); }
  double moment_sum() const { return _mm512_reduce_add_pd(moments); }
};

/// Writes the survivors among 16 states one after the other.
MOTE_LIMIT_INLINE void compress(float* to, __mmask16 survives, const float* x) {
  _mm512_storeu_ps(to, _mm512_maskz_compress_ps(survives, _mm512_load_ps(x)));
}
MOTE_LIMIT_INLINE void compress(double* to, __mmask16 survives, const double* x) {
  const auto low = static_cast<__mmask8>(survives & 255U);
  _mm512_storeu_pd(to, _mm512_maskz_compress_pd(low, _mm512_load_pd(x)));
  _mm512_storeu_pd(to + _mm_popcnt_u32(low),
                   _mm512_maskz_compress_pd(static_cast<__mmask8>(survives >> 8U), _mm512_load_pd(x + 8)));
}

/// Writes 16 children: a mark begins the next survivor; a mark on the first moves the load instead.
MOTE_LIMIT_INLINE const float* expand(float* to, const float* survivor, unsigned marks) {
  const __m512i up_to = _mm512_set_epi32(0xfffe, 0x7ffe, 0x3ffe, 0x1ffe, 0xffe, 0x7fe, 0x3fe, 0x1fe, 0xfe, 0x7e, 0x3e,
                                         0x1e, 0xe, 6, 2, 0);
  const __m512i place = _mm512_popcnt_epi32(_mm512_and_si512(_mm512_set1_epi32(static_cast<int>(marks)), up_to));
  _mm512_store_ps(to, _mm512_permutexvar_ps(place, _mm512_loadu_ps(survivor + (marks & 1U))));
  return survivor + _mm_popcnt_u32(marks);
}
MOTE_LIMIT_INLINE const double* expand(double* to, const double* survivor, unsigned marks) {
  const __m512i up_to = _mm512_set_epi64(0xfe, 0x7e, 0x3e, 0x1e, 0xe, 6, 2, 0);
  for (int part = 0; part < 2; ++part, marks >>= 8U) {
    const unsigned eight = marks & 255U;
    const __m512i place = _mm512_popcnt_epi64(_mm512_and_si512(_mm512_set1_epi64(eight), up_to));
    _mm512_store_pd(to + 8 * part, _mm512_permutexvar_pd(place, _mm512_loadu_pd(survivor + (eight & 1U))));
    survivor += _mm_popcnt_u32(eight);
  }
  return survivor;
}

// ---- the scan of the weights ----

template <int kCount>
MOTE_LIMIT_INLINE __m512 shifted_up(__m512 v) {
  return _mm512_castsi512_ps(
      _mm512_alignr_epi32(_mm512_castps_si512(v), _mm512_setzero_si512(), static_cast<int>(kLanes) - kCount));
}

/// One past the last child of each of 16 particles in turn, from their cumulative weights.
struct Scan {
  __m512 scale, rest;
  __m512i base, last;
  __m512 carry = _mm512_setzero_ps();

  /// `position` is that of the chunk's beginning: children before it, as a real number.
  Scan(double children_per_weight, double position, std::size_t particles)
      : scale(_mm512_set1_ps(static_cast<float>(children_per_weight))),
        rest(_mm512_set1_ps(static_cast<float>(position - std::floor(position)))),
        base(_mm512_set1_epi32(static_cast<int>(std::floor(position)))),
        last(_mm512_set1_epi32(static_cast<int>(particles))) {}

  MOTE_LIMIT_INLINE __m512i ends(const float* weights) {
    __m512 sums = _mm512_load_ps(weights);
    sums = _mm512_add_ps(sums, shifted_up<1>(sums));
    sums = _mm512_add_ps(sums, shifted_up<2>(sums));
    sums = _mm512_add_ps(sums, shifted_up<4>(sums));
    sums = _mm512_add_ps(sums, shifted_up<8>(sums));
    const __m512 through = _mm512_add_ps(sums, carry);
    carry = _mm512_add_ps(carry, _mm512_permutexvar_ps(_mm512_set1_epi32(15), sums));
    const __m512i above =
        _mm512_cvt_roundps_epi32(_mm512_fmadd_ps(through, scale, rest), _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
    return _mm512_min_epi32(_mm512_add_epi32(base, above), last);
  }
  double weight() const { return static_cast<double>(_mm512_cvtss_f32(carry)); }
};

inline int top_lane(__m512i v) {
  return _mm_cvtsi128_si32(_mm512_castsi512_si128(_mm512_permutexvar_epi32(_mm512_set1_epi32(15), v)));
}

template <class R>
class Limit final : public Contender {
 public:
  void prepare(std::size_t particles, std::uint64_t seed) override {
    if (particles != particles_) make_room(particles);
    random_ = SplitMix{seed};
    generator_ = Generator(random_.next());
    const LoadedTable table(table_);
    for (std::size_t j = 0; j < particles_; j += kLanes)
      store_scaled(&children_[j], std::sqrt(5.0), normal(generator_, table));
  }

  void run(std::span<const double> observations, std::span<double> means) override {
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040);  // subnormal weights are zero: some processors take 150 cycles for one
    for (std::size_t t = 0; t < observations.size(); ++t) {
      Totals totals = propagate(8 * std::cos(1.2 * static_cast<double>(t)), observations[t]);
      if (__builtin_expect(!(totals.weight > kLeastWeight), 0)) totals = weigh_again(observations[t]);
      means[t] = totals.moment / totals.weight;
      resample(totals.weight, random_.uniform());
    }
    _mm_setcsr(before);
  }

 private:
  struct Totals {
    double weight = 0, moment = 0;
  };

  void make_room(std::size_t particles) {
    particles_ = particles;
    const std::size_t room = particles + 2 * kChunk + 128;
    states_.make(room);
    weights_.make(room);
    children_.make(room);
    survivors_.make(room + 2 * kChunk);
    starts_.make(2 * kChunk + 64);
    flags_.make(room);
  }

  /// New states and weights from the children of the step before.
  Totals propagate(double push, double observation) {
    Totals totals;
    Generator generator = generator_;  // copies stay in registers
    const LoadedTable table(table_);
    for (std::size_t begin = 0; begin < particles_; begin += kChunk) {
      const std::size_t end = smaller(particles_, begin + kChunk);
      Sums<R> sums(push, observation);
      std::size_t j = begin;
      for (; j + kLanes <= end; j += kLanes)
        sums.step(&children_[j], normal(generator, table), &states_[j], &weights_[j], 0xFFFF);
      if (j < end)
        sums.step(&children_[j], normal(generator, table), &states_[j], &weights_[j],
                  static_cast<__mmask16>((1U << (end - j)) - 1));
      totals.weight += sums.weight_sum();
      totals.moment += sums.moment_sum();
    }
    generator_ = generator;
    return totals;
  }

  /// All weights underflowed: the same about the largest.
  __attribute__((noinline)) Totals weigh_again(double observation) {
    const auto log_weight = [&](std::size_t i) {
      const auto x = static_cast<double>(states_[i]);
      const double error = observation - x * x / 20;
      return -error * error / 2;
    };
    double largest = log_weight(0);
    for (std::size_t i = 1; i < particles_; ++i) largest = larger(largest, log_weight(i));
    Totals totals;
    for (std::size_t i = 0; i < particles_; ++i) {
      weights_[i] = static_cast<float>(std::exp(log_weight(i) - largest));
      totals.weight += static_cast<double>(weights_[i]);
      totals.moment += static_cast<double>(weights_[i]) * static_cast<double>(states_[i]);
    }
    return totals;
  }

  /// Systematic children of the states, chunk by chunk: survivors are listed, then written as often as they have
  /// children.
  void resample(double total, double uniform) {
    const double children_per_weight = static_cast<double>(particles_) / total;
    double position = -uniform;
    int reached = 0;          // children given so far
    std::size_t written = 0;  // children written so far
    std::size_t at = 0;       // the survivor whose children are written
    std::size_t listed = 1;   // survivors; the first is a placeholder that has no child
    for (std::size_t begin = 0; begin < particles_; begin += kChunk) {
      const std::size_t end = smaller(particles_, begin + kChunk);
      Scan scan(children_per_weight, position, particles_);
      const int before = reached;
      const std::size_t found = list_survivors(scan, begin, end, before, &survivors_[listed], reached);
      if (reached - before > kTooMany)
        flag_widely(Scan(children_per_weight, position, particles_), begin, end, before);
      else
        flag(before, found);
      if (end == particles_) reached = static_cast<int>(particles_);
      position += children_per_weight * scan.weight();
      listed += found;
      const std::size_t ready = end == particles_ ? (particles_ + kLanes - 1) / kLanes * kLanes
                                                  : static_cast<std::size_t>(reached) / kLanes * kLanes;
      at = write_children(written, ready, at);
      written = larger(written, ready);
      if (at > kChunk) {
        std::memmove(survivors_.data(), &survivors_[at], (listed - at) * sizeof(R));
        listed -= at;
        at = 0;
      }
    }
  }

  /// Appends the chunk's survivors to `list` and the places of their first children, counted from `before`; returns how
  /// many there are, leaves one past the chunk's last child in `reached`.
  MOTE_LIMIT_INLINE std::size_t list_survivors(Scan& scan, std::size_t begin, std::size_t end, int before, R* list,
                                               int& reached) {
    __m512i previous = _mm512_set1_epi32(before);
    const __m512i origin = _mm512_set1_epi32(before);
    std::size_t found = 0;
    for (std::size_t j = begin; j < end; j += kLanes) {
      const __m512i ends = scan.ends(&weights_[j]);
      const __m512i begins = _mm512_alignr_epi32(ends, previous, 15);
      previous = ends;
      if (__builtin_expect(_mm512_cmplt_epi32_mask(ends, begins) != 0, 0)) {
        previous = _mm512_set1_epi32(list_unordered(begins, ends, j, before, list, found));
        continue;
      }
      const __mmask16 survives = _mm512_cmplt_epi32_mask(begins, ends);
      const __m512i places = _mm512_maskz_compress_epi32(survives, _mm512_sub_epi32(begins, origin));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(&starts_[found]), _mm512_cvtepi32_epi16(places));
      compress(list + found, survives, &states_[j]);
      found += static_cast<std::size_t>(_mm_popcnt_u32(survives));
    }
    reached = smaller(top_lane(previous), static_cast<int>(particles_));
    return found;
  }

  /// The rare vector whose cumulative weights step back by a rounding: one by one, held monotone.
  __attribute__((noinline)) int list_unordered(__m512i begins, __m512i ends, std::size_t j, int before, R* list,
                                               std::size_t& found) {
    alignas(64) int end_of[kLanes];
    _mm512_store_si512(end_of, ends);
    int reached = _mm_cvtsi128_si32(_mm512_castsi512_si128(begins));
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (end_of[i] > reached) {
        starts_[found] = static_cast<std::uint16_t>(reached - before);
        list[found++] = states_[j + i];
      }
      reached = larger(reached, end_of[i]);
    }
    return reached;
  }

  /// Marks the first children of the chunk's survivors; stores of one 64-bit load keep the load port free.
  MOTE_LIMIT_INLINE void flag(int before, std::size_t found) {
    std::uint8_t* const flags = &flags_[static_cast<std::size_t>(before)];
    const std::uint16_t* const starts = starts_.data();
    std::size_t k = 0;
    for (; k + 4 <= found; k += 4) {
      std::uint64_t four = 0;
      std::memcpy(&four, starts + k, sizeof four);
      flags[four & 0xFFFFU] = 1;
      flags[(four >> 16U) & 0xFFFFU] = 1;
      flags[(four >> 32U) & 0xFFFFU] = 1;
      flags[four >> 48U] = 1;
    }
    for (; k < found; ++k) flags[starts[k]] = 1;
  }

  /// The same for a chunk whose children do not fit into 16 bits: its weights are scanned again.
  __attribute__((noinline)) void flag_widely(Scan scan, std::size_t begin, std::size_t end, int before) {
    int reached = before;
    for (std::size_t j = begin; j < end; j += kLanes) {
      alignas(64) int end_of[kLanes];
      _mm512_store_si512(end_of, scan.ends(&weights_[j]));
      for (const int past : end_of)
        if (past > reached) {
          flags_[static_cast<std::size_t>(reached)] = 1;
          reached = past;
        }
    }
  }

  /// Writes children [from, to), clears their marks; returns the survivor whose children come next.
  MOTE_LIMIT_INLINE std::size_t write_children(std::size_t from, std::size_t to, std::size_t at) {
    const R* survivor = &survivors_[at];
    for (; from < to; from += kLanes) {
      auto* const sixteen = reinterpret_cast<__m128i*>(&flags_[from]);
      const auto marks =
          static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpgt_epi8(_mm_load_si128(sixteen), _mm_setzero_si128())));
      _mm_store_si128(sixteen, _mm_setzero_si128());
      survivor = expand(&children_[from], survivor, marks);
    }
    return static_cast<std::size_t>(survivor - survivors_.data());
  }

  std::size_t particles_ = 0;
  NormalTable table_;
  SplitMix random_{0};
  Generator generator_{0};
  Buffer<R> states_, children_, survivors_;
  Buffer<float> weights_;
  Buffer<std::uint16_t> starts_;
  Buffer<std::uint8_t> flags_;
};

}  // namespace
}  // namespace mote::contenders
