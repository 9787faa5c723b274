#pragma once
/// A filter in another arithmetic that is led by the double filter.

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "mote/filter/estimate.hpp"
#include "mote/graph/replay.hpp"

namespace mote {

/// A recorded model whose every particle has a companion: the same draws and ancestors in an arithmetic A.
///
///   state = (x_1 .. x_D in double, x_1 .. x_D in A);   weights are the double particle's
///
/// cost    two evaluations of the graph a call
template <class A>
class Accompanied {
 public:
  template <class S>
  using State = SmallVector<S>;

  Accompanied(const graph::Recorded& recorded, std::shared_ptr<A> arithmetic)
      : plain_(recorded, std::make_shared<graph::PlainArithmetic>()), other_(recorded, std::move(arithmetic)) {}

  std::vector<Quantity> states() const {
    std::vector<Quantity> both = plain_.states();
    const std::vector<Quantity> again = both;
    both.insert(both.end(), again.begin(), again.end());
    return both;
  }
  std::vector<Column> columns() const { return plain_.columns(); }

  template <class S, class D>
  State<S> initial(D& draw) const {
    Tape<D> tape(draw);
    const State<S> own = plain_.template initial<S>(tape);
    tape.rewind();
    return joined(own, other_.template initial<S>(tape));
  }
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    Tape<D> tape(draw);
    const State<S> own = plain_.template next<S>(t, half(before, 0), tape);
    tape.rewind();
    return joined(own, other_.template next<S>(t, half(before, before.size() / 2), tape));
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    return plain_.template log_likelihood<S>(t, half(x, 0), y);
  }

  /// The companions' weights: (N,), those of their particles by the ratio of likelihoods.
  std::vector<double> weights_of_other(Step t, Rows<double> rows, const WeightedSet& set) const {
    const std::size_t states = plain_.states().size();
    const Particles<double>& x = *std::get<const Particles<double>*>(set.particles);
    std::vector<double> weights(set.weights.begin(), set.weights.end());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] <= 0) continue;
      State<double> own, other;
      for (std::size_t d = 0; d < states; ++d) {
        own.push_back(x.component(d)[i]);
        other.push_back(x.component(states + d)[i]);
      }
      double difference = 0;
      for (const Row<double>& row : rows)
        difference +=
            other_.template log_likelihood<double>(t, other, row) - plain_.template log_likelihood<double>(t, own, row);
      weights[i] *= std::exp(difference);
    }
    return weights;
  }

 private:
  /// Draws that can be had once more.
  template <class D>
  class Tape {
   public:
    explicit Tape(D& draw) : draw_(&draw) {}
    double normal() {
      return next([&] { return draw_->normal(); });
    }
    double uniform() {
      return next([&] { return draw_->uniform(); });
    }
    void rewind() { at_ = 0; }

   private:
    template <class F>
    double next(const F& drawn) {
      if (at_ == numbers_.size()) numbers_.push_back(drawn());
      return numbers_[at_++];
    }
    D* draw_;
    SmallVector<double> numbers_;
    std::size_t at_ = 0;
  };

  template <class S>
  static State<S> half(const State<S>& both, std::size_t first) {
    State<S> one;
    for (std::size_t d = first; d < first + both.size() / 2; ++d) one.push_back(both[d]);
    return one;
  }
  template <class S>
  static State<S> joined(State<S> own, const State<S>& other) {
    for (const S& x : other) own.push_back(x);
    return own;
  }

  graph::Replayed<graph::PlainArithmetic> plain_;
  graph::Replayed<A> other_;
};

}  // namespace mote
