/// What a random word costs: the figures behind docs/decisions/0001-random-numbers.md.
///
/// Each contender first shows that its words are the right ones; only then does the clock start.

#include "mote/base/draws.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include <Random123/philox.h>
#include <benchmark/benchmark.h>

namespace mote {
namespace {

using Words8 = std::uint64_t __attribute__((vector_size(64)));
using Words16 = std::uint32_t __attribute__((vector_size(64)));
constexpr std::size_t kLanes8 = 8;
constexpr std::size_t kLanes16 = 16;
constexpr Address kAddress{42, 7, Purpose::kTest, 3, 5};

template <class V>
void rotate(V& x, int k) {
  constexpr int kBits = 8 * static_cast<int>(sizeof(x[0]));
  x = (x << k) | (x >> (kBits - k));
}

/// Eight xoshiro256++ generators side by side.
struct Xoshiro8 {
  std::array<Words8, 4> s;

  void next(Words8& word) {
    word = s[0] + s[3];
    rotate(word, 23);
    word += s[0];
    const Words8 t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    rotate(s[3], 45);
  }
};

/// Sixteen xoshiro128+ generators side by side (32 bits a word; its lowest bits are weak).
struct Xoshiro16 {
  std::array<Words16, 4> s;

  void next(Words16& word) {
    word = s[0] + s[3];
    const Words16 t = s[1] << 9;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    rotate(s[3], 11);
  }
};

/// Sixteen Philox4x32 blocks side by side. The even and the odd 32-bit lanes sit in two vectors of 64-bit lanes, whose
/// upper halves are zero, so that one 64-bit product holds both halves Philox needs.
template <int kRounds>
struct Philox16 {
  using Half = std::array<Words8, 4>;  // words 0..3 of eight blocks

  static void multiply(const Words8& a, std::uint64_t factor, Words8& high, Words8& low) {
    const Words8 product = a * factor;
    high = product >> 32;
    low = product & 0xFFFFFFFFU;
  }

  static void encrypt(Half& c, std::uint64_t key0, std::uint64_t key1) {
    for (int round = 0; round < kRounds; ++round) {
      Words8 high0;
      Words8 low0;
      Words8 high1;
      Words8 low1;
      multiply(c[0], 0xD2511F53U, high0, low0);
      multiply(c[2], 0xCD9E8D57U, high1, low1);
      c[0] = high1 ^ c[1] ^ key0;
      c[2] = high0 ^ c[3] ^ key1;
      c[1] = low1;
      c[3] = low0;
      key0 = (key0 + 0x9E3779B9U) & 0xFFFFFFFFU;
      key1 = (key1 + 0xBB67AE85U) & 0xFFFFFFFFU;
    }
  }
};

constexpr Words8 kFirstEight{0, 1, 2, 3, 4, 5, 6, 7};

/// Eight generators keyed as keyed_generator does it, one after the other.
Xoshiro8 keyed_one_by_one(const Address& address) {
  Xoshiro8 out{};
  for (std::size_t lane = 0; lane < kLanes8; ++lane) {
    const Xoshiro one = keyed_generator(address, static_cast<std::uint32_t>(lane));
    for (std::size_t k = 0; k < 4; ++k) out.s[k][lane] = one.s[k];
  }
  return out;
}

/// The same eight generators, keyed by two vector Philox blocks.
Xoshiro8 keyed_together(const Address& address) {
  const Words8 zero{};
  const std::uint64_t use = static_cast<std::uint32_t>(address.purpose) + (address.stream << 8U);
  Xoshiro8 out{};
  for (std::uint64_t half = 0; half < 2; ++half) {
    Philox16<10>::Half c{zero + address.block, zero + address.step, zero + use, kFirstEight + 8 * half};
    Philox16<10>::encrypt(c, address.seed & 0xFFFFFFFFU, address.seed >> 32U);
    out.s[2 * half] = (c[1] << 32) | c[0];
    out.s[2 * half + 1] = (c[3] << 32) | c[2];
  }
  return out;
}

/// Sixteen xoshiro128+ generators, keyed from the address by two vector Philox blocks.
Xoshiro16 keyed_sixteen(const Address& address) {
  const Xoshiro8 wide = keyed_together(address);
  Xoshiro16 out{};
  for (std::size_t k = 0; k < 4; ++k) out.s[k] = reinterpret_cast<Words16>(wide.s[k]);
  return out;
}

// ---- the answers
// -------------------------------------------------------------------------------------------------------

/// The first words of a block of 1024 particles, in particle order: what every contender for the scheme must reproduce.
std::vector<std::uint64_t> reference_block(const Address& address) {
  std::array<Xoshiro, kLanes8> lanes{};
  for (std::size_t lane = 0; lane < kLanes8; ++lane)
    lanes[lane] = keyed_generator(address, static_cast<std::uint32_t>(lane));
  std::vector<std::uint64_t> words(kBlock);
  for (std::size_t i = 0; i < kBlock; ++i) words[i] = lanes[i % kLanes8].next();
  return words;
}

bool xoshiro_is_right(Xoshiro8 vector) {
  const auto expected = reference_block(kAddress);
  for (std::size_t i = 0; i < kBlock; i += kLanes8) {
    Words8 word;
    vector.next(word);
    for (std::size_t lane = 0; lane < kLanes8; ++lane)
      if (word[lane] != expected[i + lane]) return false;
  }
  return true;
}

/// One xoshiro128+ as Blackman and Vigna print it.
struct ScalarXoshiro128 {
  std::array<std::uint32_t, 4> s;
  std::uint32_t next() {
    const std::uint32_t word = s[0] + s[3];
    const std::uint32_t t = s[1] << 9U;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = std::rotl(s[3], 11);
    return word;
  }
};

bool xoshiro128_is_right() {
  Xoshiro16 vector = keyed_sixteen(kAddress);
  std::array<ScalarXoshiro128, kLanes16> scalar{};
  for (std::size_t lane = 0; lane < kLanes16; ++lane)
    for (std::size_t k = 0; k < 4; ++k) scalar[lane].s[k] = vector.s[k][lane];
  for (int draw = 0; draw < 64; ++draw) {
    Words16 word;
    vector.next(word);
    for (std::size_t lane = 0; lane < kLanes16; ++lane)
      if (word[lane] != scalar[lane].next()) return false;
  }
  return true;
}

template <int kRounds>
bool philox_is_right() {
  const Words8 zero{};
  typename Philox16<kRounds>::Half c{zero + 11U, zero + 22U, zero + 33U, kFirstEight};
  Philox16<kRounds>::encrypt(c, 0xA4093822U, 0x299F31D0U);
  for (std::uint32_t lane = 0; lane < kLanes8; ++lane) {
    const auto expected = r123::Philox4x32_R<kRounds>()({{11, 22, 33, lane}}, {{0xA4093822U, 0x299F31D0U}});
    for (std::size_t k = 0; k < 4; ++k)
      if (c[k][lane] != expected[k]) return false;
  }
  return true;
}

bool answers_are_right() {
  const auto said = [](const char* what, bool right) {
    if (!right)
      std::fprintf(stderr, "bench_draws: %s: expected the words of the reference, got others. Nothing was timed.\n",
                   what);
    return right;
  };
  bool right = said("xoshiro256++ 8x64, keyed one by one", xoshiro_is_right(keyed_one_by_one(kAddress)));
  right &= said("xoshiro256++ 8x64, keyed together", xoshiro_is_right(keyed_together(kAddress)));
  right &= said("xoshiro128+ 16x32", xoshiro128_is_right());
  right &= said("Philox4x32-10 vector", philox_is_right<10>());
  right &= said("Philox4x32-7 vector", philox_is_right<7>());
  return right;
}

// ---- the clock
// ---------------------------------------------------------------------------------------------------------

/// Reports the time of a 64-bit and of a 32-bit number, for `bits` random bits an iteration.
void report(benchmark::State& state, double bits) {
  using benchmark::Counter;
  const auto flags = Counter::kIsIterationInvariantRate | Counter::kInvert;
  state.counters["per_64"] = Counter(bits / 64, flags);
  state.counters["per_32"] = Counter(bits / 32, flags);
}

/// Blocks of 1024 particles with `draws` draws each, keyed anew by `key`; one word a draw.
template <class Key>
void time_vector_block(benchmark::State& state, Key key) {
  const auto steps = static_cast<std::size_t>(state.range(0)) * kBlock * 64 / 512;
  Address address = kAddress;
  Words8 sum{};
  for (auto _ : state) {
    ++address.block;
    auto generators = key(address);
    decltype(+generators.s[0]) word;
    decltype(+generators.s[0]) total{};
    for (std::size_t k = 0; k < steps; ++k) {
      generators.next(word);
      total += word;
    }
    sum += reinterpret_cast<Words8>(total);
  }
  benchmark::DoNotOptimize(sum);
  report(state, static_cast<double>(steps) * 512);
}

void xoshiro256pp_8x64_keyed_together(benchmark::State& state) { time_vector_block(state, keyed_together); }
void xoshiro256pp_8x64_keyed_one_by_one(benchmark::State& state) { time_vector_block(state, keyed_one_by_one); }
void xoshiro128p_16x32(benchmark::State& state) { time_vector_block(state, keyed_sixteen); }
BENCHMARK(xoshiro256pp_8x64_keyed_together)->Arg(1)->Arg(2)->Arg(4)->Arg(1024)->ArgName("draws");
BENCHMARK(xoshiro256pp_8x64_keyed_one_by_one)->Arg(1)->Arg(2)->Arg(4)->ArgName("draws");
BENCHMARK(xoshiro128p_16x32)->Arg(1)->Arg(2)->Arg(4)->Arg(1024)->ArgName("draws");

/// Two blocks at a time: does the chain from step to step or the number of vector units set the pace?
void xoshiro256pp_8x64_two_blocks(benchmark::State& state) {
  Address address = kAddress;
  Words8 sum{};
  for (auto _ : state) {
    Address second = address;
    second.block += 1;
    address.block += 2;
    Xoshiro8 a = keyed_together(second);
    Xoshiro8 b = keyed_together(address);
    for (std::size_t i = 0; i < kBlock; i += kLanes8) {
      Words8 word;
      a.next(word);
      sum += word;
      b.next(word);
      sum += word;
    }
  }
  benchmark::DoNotOptimize(sum);
  report(state, 2 * kBlock * 64);
}
BENCHMARK(xoshiro256pp_8x64_two_blocks);

/// The words written to a buffer in the first cache, as an engine that draws ahead would have them.
void xoshiro256pp_8x64_stored(benchmark::State& state) {
  std::vector<std::uint64_t> buffer(kBlock);
  Address address = kAddress;
  for (auto _ : state) {
    ++address.block;
    Xoshiro8 generators = keyed_together(address);
    for (std::size_t i = 0; i < kBlock; i += kLanes8) {
      Words8 word;
      generators.next(word);
      __builtin_memcpy(&buffer[i], &word, sizeof(word));
    }
    benchmark::DoNotOptimize(buffer.data());
    benchmark::ClobberMemory();
  }
  report(state, kBlock * 64);
}
BENCHMARK(xoshiro256pp_8x64_stored);

/// One Philox block a particle: four 32-bit words.
template <int kRounds>
void philox_vector(benchmark::State& state) {
  const Words8 zero{};
  Words8 sum{};
  std::uint64_t step = 0;
  for (auto _ : state) {
    ++step;
    for (std::uint64_t i = 0; i < kBlock; i += 2 * kLanes8) {
      typename Philox16<kRounds>::Half a{kFirstEight + i, zero + step, zero + 3U, zero};
      typename Philox16<kRounds>::Half b{kFirstEight + i + kLanes8, zero + step, zero + 3U, zero};
      Philox16<kRounds>::encrypt(a, 42, 7);
      Philox16<kRounds>::encrypt(b, 42, 7);
      for (std::size_t k = 0; k < 4; ++k) sum += a[k] + b[k];
    }
  }
  benchmark::DoNotOptimize(sum);
  report(state, kBlock * 128);
}
BENCHMARK(philox_vector<10>);
BENCHMARK(philox_vector<7>);

template <int kRounds>
void philox_scalar(benchmark::State& state) {
  std::uint64_t sum = 0;
  std::uint32_t step = 0;
  for (auto _ : state) {
    ++step;
    for (std::uint32_t i = 0; i < kBlock; ++i) {
      const auto words = r123::Philox4x32_R<kRounds>()({{i, step, 3, 0}}, {{42, 7}});
      sum += words[0] + words[1] + words[2] + words[3];
    }
  }
  benchmark::DoNotOptimize(sum);
  report(state, kBlock * 128);
}
BENCHMARK(philox_scalar<10>);

/// The reference as the library has it: eight scalar generators, particles in order, one word each.
void reference_words(benchmark::State& state) {
  Address address = kAddress;
  std::uint64_t sum = 0;
  for (auto _ : state) {
    ++address.block;
    std::array<Xoshiro, kLanes8> lanes{};
    for (std::size_t lane = 0; lane < kLanes8; ++lane)
      lanes[lane] = keyed_generator(address, static_cast<std::uint32_t>(lane));
    for (std::size_t i = 0; i < kBlock; ++i) sum += lanes[i % kLanes8].next();
  }
  benchmark::DoNotOptimize(sum);
  report(state, kBlock * 64);
}
BENCHMARK(reference_words);

/// A number as a model asks for it from the reference: `draw.normal()` or `draw.uniform()`; a draw is one "64"
/// (double).
template <class R, bool kNormal>
void reference_numbers(benchmark::State& state) {
  Draws draws{42, 0};
  R sum = 0;
  for (auto _ : state) {
    ++draws.step;
    draws.for_each<R>(Purpose::kTest, 0, kBlock,
                      [&](std::size_t, auto& draw) { sum += kNormal ? draw.normal() : draw.uniform(); });
  }
  benchmark::DoNotOptimize(sum);
  report(state, kBlock * 8 * sizeof(R));
}
BENCHMARK(reference_numbers<double, false>)->Name("reference_uniform_double");
BENCHMARK(reference_numbers<double, true>)->Name("reference_normal_double");
BENCHMARK(reference_numbers<float, true>)->Name("reference_normal_float");

void mt19937_64(benchmark::State& state) {
  std::mt19937_64 generator(42);
  std::uint64_t sum = 0;
  for (auto _ : state)
    for (std::size_t i = 0; i < kBlock; ++i) sum += generator();
  benchmark::DoNotOptimize(sum);
  report(state, kBlock * 64);
}
BENCHMARK(mt19937_64);

}  // namespace
}  // namespace mote

int main(int argc, char** argv) {
  if (!mote::answers_are_right()) return 1;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
