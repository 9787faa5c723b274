#pragma once
/// A recording as a model: filters that take models run the graph, in an arithmetic of its own.

#include <memory>
#include <utility>

#include "mote/graph/drawn.hpp"
#include "mote/graph/fixed.hpp"
#include "mote/graph/interval.hpp"
#include "mote/graph/record.hpp"
#include "mote/graph/tape.hpp"

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

/// Where the inputs of a recorded function are read; what it does not read may be left out.
struct InputValues {
  const double* state = nullptr;     ///< kState
  const double* before = nullptr;    ///< kBefore
  const double* row = nullptr;       ///< kColumn
  const double* schedule = nullptr;  ///< kSchedule
  const double* draws = nullptr;     ///< the four roles of draws, by number

  double operator()(const Vertex& input) const {
    switch (input.role) {
      case Role::kState:
        return state[input.index];
      case Role::kBefore:
        return before[input.index];
      case Role::kColumn:
        return row[input.index];
      case Role::kSchedule:
        return schedule[input.index];
      default:
        return draws[input.index];
    }
  }
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
    return shared_->run(shared_->initial, shared_->recorded.initial, {.draws = numbers.data()});
  }
  template <class S, class D>
  State<S> next(Step t, const State<S>& before, D& draw) const {
    const auto numbers = drawn<double>(shared_->recorded.draws, draw);
    return shared_->run(shared_->next, shared_->recorded.next,
                        {.before = before.data(), .schedule = schedule(t), .draws = numbers.data()});
  }
  template <class S>
  S log_likelihood(Step t, const State<S>& x, const Row<S>& y) const {
    if (!is_whole(y)) return 0;
    return shared_->run(shared_->weigh, {shared_->recorded.log_likelihood},
                        {.state = x.data(), .row = y.values.data(), .schedule = schedule(t)})[0];
  }

 protected:
  const Recorded& recorded() const { return shared_->recorded; }
  A& arithmetic() const { return *shared_->arithmetic; }
  /// Numbers that the model computes from t alone, by the index of kSchedule.
  const double* schedule(Step t) const {
    if (t != shared_->step) shared_->schedule = shared_->recorded.schedule(t);
    shared_->step = t;
    return shared_->schedule.data();
  }
  template <class S>
  static bool is_whole(const Row<S>& y) {
    for (std::size_t j = 0; j < y.values.size(); ++j)
      if (!y.seen(j)) return false;
    return true;
  }

 private:
  using OneByOne = Tape<typename A::Number>;

  struct Shared {
    Shared(const Recorded& r, std::shared_ptr<A> a)
        : recorded(r),
          arithmetic(std::move(a)),
          initial(r.graph, r.initial),
          next(r.graph, r.next),
          weigh(r.graph, {r.log_likelihood}) {}

    /// The arithmetic on columns of one.
    struct One {
      A& a;
      const InputValues& inputs;

      void take(Id id, const Vertex& v, typename A::Number* out, std::size_t) const {
        *out = a.number(id, v.op == Op::kConstant ? v.value : inputs(v));
      }
      void compute(Id id, const Vertex& v, const typename OneByOne::Columns& operands, std::size_t,
                   typename A::Number* out) const {
        *out = a.compute(id, v, {*operands[0], *operands[1], *operands[2], *operands[3]});
      }
    };
    State<double> run(OneByOne& tape, const std::vector<Id>& outputs, const InputValues& inputs) {
      tape.run(One{*arithmetic, inputs});
      State<double> out;
      for (std::size_t k = 0; k < outputs.size(); ++k) out.push_back(arithmetic->value(outputs[k], *tape.output(k)));
      return out;
    }

    Recorded recorded;
    std::shared_ptr<A> arithmetic;
    OneByOne initial, next, weigh;
    std::vector<double> schedule;
    Step step = -1;
  };

  std::shared_ptr<Shared> shared_;
};

}  // namespace mote::graph
