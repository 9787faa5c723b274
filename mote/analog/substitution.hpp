#pragma once
/// Substitution: a model's graph with circuits where squares, exponentials and memory were.

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "mote/analog/placement.hpp"

namespace mote::analog {

/// Copies a graph's vertices into another, circuits in the place of some.
///
///   c e^2 in a log likelihood, c < 0:  log gaussian(sqrt(-2 c) e);   exp(c e^2):  gaussian(sqrt(-2 c) e)
///   x_{t-1}:  what analog memory makes of it
class Substitution {
  using Graph = graph::Graph;
  using Id = graph::Id;
  using Op = graph::Op;
  using Vertex = graph::Vertex;

 public:
  Substitution(const Graph& from, Method method, Wanted wanted)
      : from_(from), method_(method), wanted_(wanted), has_square_(from.size(), false) {
    for (Id id = 0; id < from.size(); ++id) has_square_[id] = finds_square(from[id]);
  }

  Id copied(Id id) {
    if (const auto known = done_.find(id); known != done_.end()) return known->second;
    const Vertex v = from_[id];
    Id made = 0;
    if (v.op == Op::kConstant) {
      made = to.constant(v.value);
    } else if (v.op == Op::kInput) {
      made = to.input(v.role, v.index);
      if (v.role == graph::Role::kBefore && memory != nullptr) made = remembered(made, draws + v.index);
    } else if (const auto exponential = analog ? gaussian_of(v) : std::nullopt) {
      made = *exponential;
    } else {
      std::array<Id, 4> args{};
      for (std::size_t k = 0; k < graph::arity(v.op); ++k) args[k] = copied(v.args[k]);
      made = to.operation(v.op, args);
    }
    done_.emplace(id, made);
    return made;
  }

  /// A log likelihood, its squares as circuits.
  Id likelihood(Id id) {
    analog = true;
    return wanted_.gaussian ? terms(id, std::nullopt) : copied(id);
  }

  Graph to;
  const Cells* memory = nullptr;  ///< of x_{t-1}, if it is analog
  std::uint32_t draws = 0;        ///< of the model; those of the memory follow
  bool analog = false;            ///< whether what is copied may become a circuit
  std::map<Id, Part> circuits;

 private:
  std::optional<double> constant(Id id) const {
    return from_.is_constant(id) ? std::optional(from_[id].value) : std::nullopt;
  }
  bool is_square(Id id) const { return from_[id].op == Op::kMultiply && from_[id].args[0] == from_[id].args[1]; }

  /// Whether squares stand in a sum, so that going down its terms is worth while.
  bool finds_square(const Vertex& v) const {
    switch (v.op) {
      case Op::kMultiply:
        return v.args[0] == v.args[1] || has_square_[v.args[0]] || has_square_[v.args[1]];
      case Op::kAdd:
      case Op::kSubtract:
        return has_square_[v.args[0]] || has_square_[v.args[1]];
      case Op::kNegate:
      case Op::kDivide:
        return has_square_[v.args[0]];
      default:
        return false;
    }
  }

  /// A component of x_{t-1} as its memory gives it back: x (1 - leak + error z), z a normal number of its own.
  Id remembered(Id x, std::uint32_t draw) {
    const Id z = to.input(graph::Role::kNormal, draw);
    const Id error = to.operation(Op::kMultiply, {to.constant(memory->memory_error), z});
    const Id kept = to.operation(Op::kAdd, {to.constant(1 - memory->memory_leak), error});
    const Id given_back = to.operation(Op::kMultiply, {x, kept});
    for (const Id id : {z, error, kept, given_back}) circuits.emplace(id, Part::kMemory);
    return given_back;
  }

  Id times(std::optional<Id> factor, Id id) { return factor ? to.operation(Op::kMultiply, {*factor, id}) : id; }
  Id product(std::optional<Id> factor, Id more) {
    if (!factor) return more;
    const bool both = to.is_constant(*factor) && to.is_constant(more);
    return both ? to.constant(to[*factor].value * to[more].value) : to.operation(Op::kMultiply, {*factor, more});
  }

  /// factor times a sum, term by term.
  Id terms(Id id, std::optional<Id> factor) {
    const Vertex v = from_[id];
    if (!has_square_[id]) return times(factor, copied(id));
    if (is_square(id)) return factor ? square(v.args[0], *factor) : copied(id);
    switch (v.op) {
      case Op::kAdd:
      case Op::kSubtract:
        return to.operation(v.op, {terms(v.args[0], factor), terms(v.args[1], factor)});
      case Op::kNegate:
        return terms(v.args[0], product(factor, to.constant(-1)));
      case Op::kDivide:
        return terms(v.args[0], product(factor, inverse(v.args[1])));
      default:
        break;
    }
    const bool first = has_square_[v.args[0]];
    return terms(v.args[first ? 0 : 1], product(factor, copied(v.args[first ? 1 : 0])));
  }

  Id inverse(Id id) {
    if (const auto c = constant(id)) return to.constant(1 / *c);
    return to.operation(Op::kDivide, {to.constant(1), copied(id)});
  }

  /// log of the Gaussian whose exponent is factor e^2.
  Id square(Id e, Id factor) {
    if (!is_negative(factor)) return times(factor, to.operation(Op::kMultiply, {copied(e), copied(e)}));
    const Id x = scaled(e, factor);
    if (method_ == Method::kAllButRandom) return marked(Op::kExp, x, Part::kSquare);
    return to.operation(Op::kLog, {marked(Op::kExp, x, Part::kGaussian)});
  }

  /// Whether a factor is below 0 whatever the state: a constant, or a constant over a square.
  bool is_negative(Id factor) const {
    const Vertex& v = to[factor];
    if (v.op == Op::kConstant) return v.value < 0;
    if (v.op != Op::kDivide || !to.is_constant(v.args[0]) || to[v.args[0]].value >= 0) return false;
    const Vertex& below = to[v.args[1]];
    return below.op == Op::kMultiply && below.args[0] == below.args[1];
  }

  /// sqrt(-2 factor) e, what the circuit takes.
  Id scaled(Id e, Id factor) {
    const Id scale = to.is_constant(factor)
                         ? to.constant(std::sqrt(-2 * to[factor].value))
                         : to.operation(Op::kSqrt, {to.operation(Op::kMultiply, {to.constant(-2), factor})});
    return to.operation(Op::kMultiply, {copied(e), scale});
  }

  /// exp(c e^2) that a model says itself.
  std::optional<Id> gaussian_of(const Vertex& v) {
    if (v.op != Op::kExp || !wanted_.gaussian || method_ == Method::kAllButRandom) return std::nullopt;
    Id id = v.args[0];
    double factor = 1;
    while (!is_square(id)) {
      const Vertex& at = from_[id];
      if (at.op == Op::kNegate) {
        factor = -factor;
        id = at.args[0];
      } else if (at.op == Op::kMultiply && (constant(at.args[0]) || constant(at.args[1]))) {
        const std::size_t side = constant(at.args[0]) ? 0 : 1;
        factor *= *constant(at.args[side]);
        id = at.args[1 - side];
      } else if (at.op == Op::kDivide && constant(at.args[1])) {
        factor /= *constant(at.args[1]);
        id = at.args[0];
      } else {
        return std::nullopt;
      }
    }
    if (!(factor < 0)) return std::nullopt;
    return marked(Op::kExp, scaled(from_[id].args[0], to.constant(factor)), Part::kGaussian);
  }

  Id marked(Op op, Id operand, Part part) {
    const Id id = to.operation(op, {operand});
    circuits.emplace(id, part);
    return id;
  }

  const Graph& from_;
  Method method_;
  Wanted wanted_;
  std::vector<bool> has_square_;  ///< by vertex of `from_`
  std::map<Id, Id> done_;
};

}  // namespace mote::analog
