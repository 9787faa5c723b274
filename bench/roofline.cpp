/// What this machine's core can do at most: the throughputs behind the roofline in docs/speed.md.
///
/// Operations run on twelve independent vectors of 64 bytes, so that no chain of results sets the pace; each kernel
/// shows after its last lap that it has done what it claims.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include <benchmark/benchmark.h>

namespace mote {
namespace {

using Floats = float __attribute__((vector_size(64)));
using Words = std::uint32_t __attribute__((vector_size(64)));
constexpr std::size_t kChains = 12;
constexpr std::size_t kLaps = 256;

template <class V>
V filled(decltype(V{}[0] + 0) value) {
  return V{} + value;
}

/// The reciprocal of a rate: seconds for one of `count` things an iteration.
benchmark::Counter seconds_each(double count) {
  return {count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

/// Times x = op(x) on vectors of type V; `right(x)` judges a vector that has made the laps from `start`.
template <class V, class Op, class Right>
void time_operation(benchmark::State& state, V start, int operations, Op op, Right right) {
  std::array<V, kChains> chains{};
  for (auto _ : state) {
    chains.fill(start);
    benchmark::DoNotOptimize(chains);  // else equal chains become one
    for (std::size_t lap = 0; lap < kLaps; ++lap)
      for (V& x : chains) op(x);
    benchmark::DoNotOptimize(chains);
  }
  for (const V& x : chains)
    for (std::size_t lane = 0; lane < 16; ++lane)
      if (!right(x[lane], lane)) state.SkipWithError("expected what the operations give, got something else");
  state.counters["per_operation"] = seconds_each(static_cast<double>(kChains * kLaps) * operations);
}

void fused_multiply_add(benchmark::State& state) {
  Floats factor = filled<Floats>(1);
  Floats term = filled<Floats>(1);
  benchmark::DoNotOptimize(factor);
  benchmark::DoNotOptimize(term);
  time_operation(
      state, Floats{}, 1, [=](Floats& x) { x = x * factor + term; },
      [](float x, std::size_t) { return x == static_cast<float>(kLaps); });
}
BENCHMARK(fused_multiply_add);

void divide(benchmark::State& state) {
  Floats divisor = filled<Floats>(1);
  benchmark::DoNotOptimize(divisor);
  time_operation(
      state, filled<Floats>(3), 1, [=](Floats& x) { x = x / divisor; }, [](float x, std::size_t) { return x == 3; });
}
BENCHMARK(divide);

void integer_add(benchmark::State& state) {
  Words term = filled<Words>(1);
  benchmark::DoNotOptimize(term);
  time_operation(
      state, Words{}, 1, [=](Words& x) { x = x + term; }, [](std::uint32_t x, std::size_t) { return x == kLaps; });
}
BENCHMARK(integer_add);

/// Half of them in the multipliers, half in the other units: the most a core issues.
void multiply_add_and_integer_xor(benchmark::State& state) {
  Floats factor = filled<Floats>(1);
  Floats term = filled<Floats>(1);
  Words bits = filled<Words>(0);
  benchmark::DoNotOptimize(factor);
  benchmark::DoNotOptimize(term);
  benchmark::DoNotOptimize(bits);
  time_operation(
      state, Floats{}, 2,
      [=](Floats& x) { x = reinterpret_cast<Floats>(reinterpret_cast<Words>(x * factor + term) ^ bits); },
      [](float x, std::size_t) { return x == static_cast<float>(kLaps); });
}
BENCHMARK(multiply_add_and_integer_xor);

/// Lanes picked by an index from a register.
void permute(benchmark::State& state) {
  Words backwards{15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  benchmark::DoNotOptimize(backwards);
  const Words start{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  static_assert(kLaps % 2 == 0, "an even number of reversals changes nothing");
  time_operation(
      state, start, 1, [=](Words& x) { x = __builtin_shuffle(x, backwards); },
      [](std::uint32_t x, std::size_t lane) { return x == lane; });
}
BENCHMARK(permute);

/// One byte at a place read from a list, as survivors mark their first children.
void scattered_byte_store(benchmark::State& state) {
  constexpr std::size_t kPlaces = 1024;
  std::vector<std::uint32_t> places(kPlaces);
  std::vector<std::uint8_t> flags(2 * kPlaces);
  for (std::size_t k = 0; k < kPlaces; ++k) places[k] = static_cast<std::uint32_t>(2 * k);
  for (auto _ : state) {
    for (const std::uint32_t place : places) flags[place] = 1;
    benchmark::ClobberMemory();
  }
  if (std::accumulate(flags.begin(), flags.end(), std::size_t{0}) != kPlaces)
    state.SkipWithError("expected a mark for every place, got another number");
  state.counters["per_operation"] = seconds_each(kPlaces);
}
BENCHMARK(scattered_byte_store);

/// Memory read and written: as many bytes each way as the argument says.
void copy(benchmark::State& state) {
  const auto bytes = static_cast<std::size_t>(state.range(0));
  std::vector<char> from(bytes, 'x');
  std::vector<char> to(bytes);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  if (from != to) state.SkipWithError("expected a copy, got something else");
  state.counters["per_byte_moved"] = seconds_each(2 * static_cast<double>(bytes));
}
BENCHMARK(copy)->Arg(12 << 10)->Arg(256 << 10)->Arg(4 << 20)->Arg(256 << 20)->ArgName("bytes");

}  // namespace
}  // namespace mote

BENCHMARK_MAIN();
