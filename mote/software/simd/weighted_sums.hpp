#pragma once
/// Weights of a block of particles from their logarithms, and the sums of weights and states, on vectors.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "mote/lanes/functions.hpp"
#include "mote/software/simd/block_sums.hpp"

namespace mote {
inline namespace HWY_NAMESPACE {

/// Pointers to the D components of something; D = 0: as many as are known at run time.
template <class T, std::size_t kD>
using ColumnPointers = std::conditional_t<kD == 0, std::vector<T*>, std::array<T*, kD>>;

template <class T, std::size_t kD>
ColumnPointers<T, kD> column_pointers(std::size_t dimensions) {
  ColumnPointers<T, kD> all{};
  if constexpr (kD == 0) all.resize(dimensions);
  return all;
}

/// A density as a weight may use it: NaN and +infinity count as zero.
template <class R>
MOTE_INLINE lanes::Vector<R> usable_weights(const lanes::Vector<R>& l) {
  using V = lanes::Vector<R>;
  return lanes::select(l < V(std::numeric_limits<R>::infinity()), l, V(-std::numeric_limits<R>::infinity()));
}

/// Makes the log weights of n particles usable; the largest.
template <class R>
[[gnu::noinline]] R clean_weights(R* logs, std::size_t n) {
  using V = lanes::Vector<R>;
  V most(-std::numeric_limits<R>::infinity());
  for (std::size_t j = 0; j < n; j += V::kLanes) {
    const V l = usable_weights(V::load(logs + j));
    l.store(logs + j);
    most = lanes::max(most, l);
  }
  return lanes::largest(most);
}

/// Sums of one component of a block about its first particle, or about 0 where no spread is asked for.
template <class R>
struct CentredSums {
  using V = lanes::Vector<R>;
  V centre{0}, first{0}, second{0};

  CentredSums() = default;
  MOTE_INLINE CentredSums(const R* states, bool spread)
      : centre(spread && std::isfinite(states[0]) ? states[0] : R(0)) {}

  template <bool kSpread>
  MOTE_INLINE void add(const V& w, const V& states) {
    if constexpr (kSpread) {
      const V offset = states - centre;
      const V moment = w * offset;
      first = first + moment;
      second = lanes::fma(moment, offset, second);
    } else {
      first = lanes::fma(w, states, first);
    }
  }

  ComponentSums sums(const R* states, const R* weights, std::size_t n) const {
    const ComponentSums all{lanes::first(centre), lanes::sum(first), lanes::sum(second)};
    return std::isfinite(all.first + all.second) ? all : careful_sums(all.centre, states, weights, n);
  }

 private:
  /// Leaves out particles without weight, whose states may be anything.
  [[gnu::noinline]] static ComponentSums careful_sums(double centre, const R* states, const R* weights, std::size_t n) {
    ComponentSums all{centre, 0, 0};
    for (std::size_t i = 0; i < n; ++i) {
      if (!(weights[i] > 0)) continue;
      const double offset = static_cast<double>(states[i]) - centre;
      all.first += static_cast<double>(weights[i]) * offset;
      all.second += static_cast<double>(weights[i]) * offset * offset;
    }
    return all;
  }
};

/// Sums of a block's weights and of its first components.
template <class R, std::size_t kComponents>
struct VectorSums {
  lanes::Vector<R> weight{0}, square{0};
  std::array<CentredSums<R>, kComponents> components;
};

/// Sums of a block's weights and components; first the weights themselves, 2^(l log2 e - shift), where kWeighs.
///
/// shape   logs, weights: whole vectors, those behind the n-th particle without weight
template <bool kSpread, bool kWeighs, class R, std::size_t kComponents, class Columns>
[[gnu::flatten, gnu::noinline]] void add_up_weighted(const R* logs, double shift, std::size_t n, R* weights,
                                                     const Columns& x, VectorSums<R, kComponents>& result) {
  using V = lanes::Vector<R>;
  const V to_one(-shift);
  const V log2e(std::numbers::log2e);
  const auto columns = x;
  VectorSums<R, kComponents> all;  // in registers: what is returned lives in memory
  for (std::size_t d = 0; d < kComponents; ++d) all.components[d] = CentredSums<R>(columns[d], kSpread);
  for (std::size_t j = 0; j < n; j += V::kLanes) {
    V w;
    if constexpr (kWeighs) {
      w = lanes::exp2_weight(lanes::fma(V::load(logs + j), log2e, to_one));
      w.store(weights + j);
      lanes::prefetch(weights + j + kBlock);
    } else {
      w = V::load(weights + j);
    }
    all.weight = all.weight + w;
    all.square = lanes::fma(w, w, all.square);
    lanes::unrolled<kComponents>(
        [&](std::size_t d) { all.components[d].template add<kSpread>(w, V::load(columns[d] + j)); });
  }
  result = all;
}

}  // namespace HWY_NAMESPACE
}  // namespace mote
