#pragma once
/// A recording as a model: filters that take models run the graph, in an arithmetic of its own.

#include <memory>
#include <utility>

#include "mote/graph/drawn.hpp"
#include "mote/graph/fixed.hpp"
#include "mote/graph/interval.hpp"
#include "mote/graph/record.hpp"

namespace mote::graph {

/// Double.
struct PlainArithmetic {
  using Number = double;

  static double number(Id, double value) { return value; }
  static double value(Id, double number) { return number; }
  static double compute(Id, const Vertex& vertex, const std::array<double, 4>& operands) {
    return apply<double>(vertex.op, operands);
  }
};

/// Double, and what every vertex has been.
class WatchedArithmetic {
 public:
  using Number = double;

  explicit WatchedArithmetic(const Graph& graph) : seen_(graph.size(), {kInfinity, -kInfinity}) {}

  double number(Id id, double value) { return watch(id, value); }
  static double value(Id, double number) { return number; }
  double compute(Id id, const Vertex& vertex, const std::array<double, 4>& operands) {
    return watch(id, apply<double>(vertex.op, operands));
  }
  /// The least and the largest value of every vertex; low above high where it never had one.
  const std::vector<Interval>& seen() const { return seen_; }

 private:
  double watch(Id id, double value) {
    Interval& seen = seen_[id];
    if (value < seen.low) seen.low = value;
    if (value > seen.high) seen.high = value;
    return value;
  }
  std::vector<Interval> seen_;
};

/// A recorded model whose every operation is done by an arithmetic A.
///
///   A::Number number(id, double)                an input or constant, as vertex id has it
///   A::Number compute(id, vertex, operands)     an operation
///   double value(id, A::Number)                 an output
///
/// A row with a value missing weighs nothing: a recording is that of whole rows.
///
/// shape   double only; copies share the arithmetic: one thread at a time
/// cost    O(vertices) a call
template <class A>
class Replayed {
 public:
  template <class S>
  using State = SmallVector<S>;

  Replayed(const Recorded& recorded, std::shared_ptr<A> arithmetic)
      : shared_(std::make_shared<Shared>(recorded, std::move(arithmetic))) {}

  std::vector<Quantity> states() const { return shared_->recorded.states; }
  std::vector<Column> columns() const { return shared_->recorded.columns; }

  template <class S, class D>
  State<S> initial(D& draw) const {
    const auto numbers = drawn<double>(shared_->recorded.prior_draws, draw);
    return shared_->run(shared_->initial, shared_->recorded.initial, [&](const Vertex& v) { return numbers[v.index]; });
  }
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    const auto numbers = drawn<double>(shared_->recorded.draws, draw);
    shared_->go_to(t);
    return shared_->run(shared_->next, shared_->recorded.next, [&](const Vertex& v) {
      return v.role == Role::kBefore     ? before[v.index]
             : v.role == Role::kSchedule ? shared_->schedule[v.index]
                                         : numbers[v.index];
    });
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    for (std::size_t j = 0; j < y.values.size(); ++j)
      if (!y.seen(j)) return 0;
    shared_->go_to(t);
    return shared_->run(shared_->weigh, {shared_->recorded.log_likelihood}, [&](const Vertex& v) {
      return v.role == Role::kState ? x[v.index] : v.role == Role::kSchedule ? shared_->schedule[v.index] : y[v.index];
    })[0];
  }

 private:
  struct Shared {
    Shared(const Recorded& r, std::shared_ptr<A> a)
        : recorded(r),
          arithmetic(std::move(a)),
          values(r.graph.size()),
          initial(needed(r.initial)),
          next(needed(r.next)),
          weigh(needed({r.log_likelihood})) {}

    std::vector<Id> needed(const std::vector<Id>& outputs) const {
      const std::vector<bool> used = reached(recorded.graph, outputs);
      std::vector<Id> all;
      for (Id id = 0; id < used.size(); ++id)
        if (used[id]) all.push_back(id);
      return all;
    }
    void go_to(Step t) {
      if (t == step) return;
      schedule = recorded.schedule(t);
      step = t;
    }
    template <class Input>
    State<double> run(const std::vector<Id>& order, const std::vector<Id>& outputs, const Input& input) {
      std::array<typename A::Number, 4> operands{};
      for (const Id id : order) {
        const Vertex& v = recorded.graph[id];
        if (arity(v.op) == 0) {
          values[id] = arithmetic->number(id, v.op == Op::kConstant ? v.value : input(v));
        } else {
          for (std::size_t k = 0; k < arity(v.op); ++k) operands[k] = values[v.args[k]];
          values[id] = arithmetic->compute(id, v, operands);
        }
      }
      State<double> out;
      for (const Id id : outputs) out.push_back(arithmetic->value(id, values[id]));
      return out;
    }

    Recorded recorded;
    std::shared_ptr<A> arithmetic;
    std::vector<typename A::Number> values;
    std::vector<Id> initial, next, weigh;  ///< what each function computes, in order
    std::vector<double> schedule;
    Step step = -1;
  };

  std::shared_ptr<Shared> shared_;
};

}  // namespace mote::graph
