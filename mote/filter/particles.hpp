#pragma once
/// A set of particles, stored by component, and the view of it that estimates are taken from.

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "mote/base/aligned.hpp"
#include "mote/base/archive.hpp"
#include "mote/model/model.hpp"

namespace mote {

/// Index of a particle; sets hold at most 2^28.
using Index = std::uint32_t;
inline constexpr std::size_t kMostParticles = std::size_t{1} << 28U;

/// N particles of D components in the number type R: component d of particle i is at component(d)[i].
///
/// Columns are aligned and filled up to whole blocks of 1024, so that engines read and write them by whole vectors.
template <class R>
class Particles {
 public:
  Particles(std::size_t dimensions, std::size_t count)
      : count_(count), components_(dimensions, AlignedVector<R>(whole_blocks(count))) {}

  std::size_t size() const { return count_; }
  std::size_t dimensions() const { return components_.size(); }
  std::span<R> component(std::size_t d) { return {components_[d].data(), count_}; }
  std::span<const R> component(std::size_t d) const { return {components_[d].data(), count_}; }

  template <class State>
  void read(std::size_t i, State& x) const {
    for (std::size_t d = 0; d < components_.size(); ++d) x[d] = components_[d][i];
  }
  template <class State>
  void write(std::size_t i, const State& x) {
    for (std::size_t d = 0; d < components_.size(); ++d) components_[d][i] = x[d];
  }

  /// Sets particle j to particle ancestors[j] of `source`, for all j.
  void gather(const Particles& source, std::span<const Index> ancestors) {
    for (std::size_t d = 0; d < components_.size(); ++d)
      for (std::size_t j = 0; j < ancestors.size(); ++j) components_[d][j] = source.components_[d][ancestors[j]];
  }

  /// Replaces particles first + j by particles ancestors[j]; scratch of one component.
  void gather(std::span<const Index> ancestors, std::size_t first = 0) {
    scratch_.resize(ancestors.size());
    for (auto& component : components_) {
      for (std::size_t j = 0; j < ancestors.size(); ++j) scratch_[j] = component[ancestors[j]];
      std::copy(scratch_.begin(), scratch_.end(), component.begin() + static_cast<std::ptrdiff_t>(first));
    }
  }

  /// Makes room for (or drops to) `count` particles; those that stay keep their values.
  void resize(std::size_t count) {
    count_ = count;
    for (auto& component : components_) component.resize(whole_blocks(count));
  }

  /// Writes or reads the particles; a set that reads has as many.
  void keep(Archive& archive) {
    for (std::size_t d = 0; d < dimensions(); ++d) archive.fill(component(d));
  }

 private:
  static std::size_t whole_blocks(std::size_t count) { return (count + kBlock - 1) / kBlock * kBlock; }

  std::size_t count_;
  std::vector<AlignedVector<R>> components_;
  std::vector<R> scratch_;
};

/// Weighted particles, whatever their number type: sum_i weights[i] f(x_i) / total estimates E f(x).
struct WeightedSet {
  std::variant<const Particles<double>*, const Particles<float>*> particles;
  std::span<const double> weights;  ///< linear, >= 0, not normalised
  double total;                     ///< their sum, > 0

  std::size_t size() const { return weights.size(); }

  /// Calls visit(particles) with the typed set.
  template <class Visit>
  decltype(auto) visit(Visit&& with) const {
    return std::visit([&](const auto* typed) -> decltype(auto) { return with(*typed); }, particles);
  }
};

}  // namespace mote
