/// xsimd or Highway: the figures behind docs/decisions/0004-vector-library.md.
///
/// The models' own lines on 1024 particles whose normal numbers are made already, once in vectors of xsimd with its
/// functions, once in mote's, which are built on Highway. Both must agree before the clock starts.

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <xsimd/xsimd.hpp>

#include "mote/lanes/functions.hpp"
#include "mote/lanes/ready_draws.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

/// A vector of xsimd with the face that models expect.
struct Batch {
  using Number = float;
  using Raw = xsimd::batch<float>;
  static constexpr std::size_t kLanes = Raw::size;
  Raw v;

  Batch() = default;
  Batch(Raw raw) : v(raw) {}  // NOLINT(google-explicit-constructor): results of xsimd's functions
  template <class T>
  requires std::is_arithmetic_v<T>
  explicit Batch(T all) : v(static_cast<float>(all)) {}
  static Batch load(const float* from) { return Raw::load_unaligned(from); }
  void store(float* to) const { v.store_unaligned(to); }

  friend Batch operator+(const Batch& a, const Batch& b) { return a.v + b.v; }
  friend Batch operator-(const Batch& a, const Batch& b) { return a.v - b.v; }
  friend Batch operator*(const Batch& a, const Batch& b) { return a.v * b.v; }
  friend Batch operator/(const Batch& a, const Batch& b) { return a.v / b.v; }
  friend Batch sqrt(const Batch& a) { return xsimd::sqrt(a.v); }
  friend Batch log(const Batch& a) { return xsimd::log(a.v); }
  friend Batch sin(const Batch& a) { return xsimd::sin(a.v); }
  friend Batch cos(const Batch& a) { return xsimd::cos(a.v); }
  friend Batch floor(const Batch& a) { return xsimd::floor(a.v); }
  friend Batch atan2(const Batch& y, const Batch& x) { return xsimd::atan2(y.v, x.v); }
};

constexpr std::size_t kMostDraws = 3;

/// 1024 particles before and after a step, and their log likelihoods.
template <class M>
struct Block {
  static constexpr std::size_t kD = std::tuple_size_v<StateOf<M, double>>;
  std::array<std::array<float, kBlock>, kD> before{}, after{};
  std::array<float, kBlock> logs{};
  std::vector<float> normals = std::vector<float>(kMostDraws * kBlock);

  Block() {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (auto& column : before)
      for (float& x : column) x = 0.3F * normal(random);
    for (float& z : normals) z = normal(random);
  }

  template <class V>
  [[gnu::flatten, gnu::noinline]] void step(const M& model, const Row<V>& row) {
    const M here = model;
    for (std::size_t j = 0; j < kBlock; j += V::kLanes) {
      lanes::ReadyDraw<V> draw(normals.data(), j);
      StateOf<M, V> x{};
      for (std::size_t d = 0; d < kD; ++d) x[d] = V::load(before[d].data() + j);
      x = here.template next<V>(3, x, draw);
      for (std::size_t d = 0; d < kD; ++d) x[d].store(after[d].data() + j);
      here.template log_likelihood<V>(3, x, row).store(logs.data() + j);
    }
  }
};

template <class M, class V>
void measure(benchmark::State& state, const M& model) {
  Block<M> block;
  Block<M> judge;
  const Row<V> row = Row<V>::of({V(0.4)});
  block.template step<V>(model, row);
  judge.template step<lanes::Vector<float>>(model, Row<lanes::Vector<float>>::of({lanes::Vector<float>(0.4)}));
  for (std::size_t i = 0; i < kBlock; ++i)
    if (!(std::abs(block.logs[i] - judge.logs[i]) < 1e-3F * (1 + std::abs(judge.logs[i])))) {
      state.SkipWithError("the two libraries do not agree");
      return;
    }
  for (auto unused : state) {
    block.template step<V>(model, row);
    benchmark::ClobberMemory();
  }
  state.counters["ns_per_particle"] = benchmark::Counter(
      static_cast<double>(kBlock) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void growth_xsimd(benchmark::State& state) { measure<Ungm<1>, Batch>(state, {}); }
void growth_highway(benchmark::State& state) { measure<Ungm<1>, lanes::Vector<float>>(state, {}); }
void doa_xsimd(benchmark::State& state) { measure<Doa, Batch>(state, {}); }
void doa_highway(benchmark::State& state) { measure<Doa, lanes::Vector<float>>(state, {}); }
BENCHMARK(growth_xsimd);
BENCHMARK(growth_highway);
BENCHMARK(doa_xsimd);
BENCHMARK(doa_highway);

}  // namespace
}  // namespace mote

BENCHMARK_MAIN();
