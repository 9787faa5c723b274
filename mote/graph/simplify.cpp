#include "mote/graph/simplify.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "mote/graph/evaluate.hpp"

namespace mote::graph {
namespace {

/// Whether 1 / c is exact, so that x / c and x (1 / c) are the same number.
bool has_exact_inverse(double c) {
  int exponent = 0;
  return std::isnormal(c) && std::isnormal(1 / c) && std::abs(std::frexp(c, &exponent)) == 0.5;
}

/// Adds operations to a graph in their simplest form.
class Simplifier {
 public:
  explicit Simplifier(Identities identities) : identities_(identities) {}

  Id operation(Op op, const std::array<Id, 4>& a) {
    if (const auto folded = constant(op, a)) return graph_.constant(*folded);
    switch (op) {
      case Op::kAdd:
        return sum(a[0], a[1]);
      case Op::kSubtract:
        return difference(a[0], a[1]);
      case Op::kMultiply:
        return product(a[0], a[1]);
      case Op::kDivide:
        return quotient(a[0], a[1]);
      case Op::kNegate:
        return negative(a[0]);
      case Op::kAbs:
        return absolute(a[0]);
      case Op::kFloor:
        return graph_[a[0]].op == Op::kFloor ? a[0] : graph_.operation(op, {a[0]});
      case Op::kAtan2:
        return graph_.operation(op, {a[0], a[1]});
      case Op::kSelect:
        return selection(a);
      default:
        return graph_.operation(op, {a[0]});
    }
  }

  Graph& graph() { return graph_; }

 private:
  bool is(Id id, double value) const { return graph_.is_constant(id) && graph_[id].value == value; }
  std::optional<Id> negated(Id id) const {
    return graph_[id].op == Op::kNegate ? std::optional(graph_[id].args[0]) : std::nullopt;
  }
  Id ordered(Op op, Id a, Id b) {
    if (b < a) std::swap(a, b);
    return graph_.operation(op, {a, b});
  }

  std::optional<double> constant(Op op, const std::array<Id, 4>& a) const {
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < arity(op); ++k) {
      if (!graph_.is_constant(a[k])) return std::nullopt;
      values[k] = graph_[a[k]].value;
    }
    return apply<double>(op, values);
  }

  Id sum(Id a, Id b) {
    if (is(a, 0)) return b;
    if (is(b, 0)) return a;
    if (const auto y = negated(b)) return difference(a, *y);
    if (const auto x = negated(a)) return difference(b, *x);
    return ordered(Op::kAdd, a, b);
  }
  Id difference(Id a, Id b) {
    if (is(b, 0)) return a;
    if (is(a, 0)) return negative(b);
    if (const auto y = negated(b)) return sum(a, *y);
    return graph_.operation(Op::kSubtract, {a, b});
  }
  Id product(Id a, Id b) {
    if (graph_.is_constant(a)) std::swap(a, b);
    if (is(b, 1)) return a;
    if (is(b, -1)) return negative(a);
    const auto x = negated(a);
    const auto y = negated(b);
    if (x && y) return product(*x, *y);
    if (x && graph_.is_constant(b)) return product(*x, graph_.constant(-graph_[b].value));
    return ordered(Op::kMultiply, a, b);
  }
  Id quotient(Id a, Id b) {
    if (is(b, 1)) return a;
    const bool inverts =
        graph_.is_constant(b) &&
        (has_exact_inverse(graph_[b].value) || (identities_ == Identities::kRounding &&
                                                std::isnormal(graph_[b].value) && std::isnormal(1 / graph_[b].value)));
    if (inverts) return product(a, graph_.constant(1 / graph_[b].value));
    return graph_.operation(Op::kDivide, {a, b});
  }
  Id negative(Id a) {
    if (const auto x = negated(a)) return *x;
    const Vertex v = graph_[a];
    if (v.op == Op::kSubtract) return difference(v.args[1], v.args[0]);
    return graph_.operation(Op::kNegate, {a});
  }
  Id absolute(Id a) {
    if (const auto x = negated(a)) return absolute(*x);
    const Vertex& v = graph_[a];
    if (v.op == Op::kAbs || (v.op == Op::kMultiply && v.args[0] == v.args[1])) return a;
    return graph_.operation(Op::kAbs, {a});
  }
  Id selection(const std::array<Id, 4>& a) {
    if (a[2] == a[3]) return a[2];
    if (graph_.is_constant(a[0]) && graph_.is_constant(a[1]))
      return graph_[a[0]].value < graph_[a[1]].value ? a[2] : a[3];
    return graph_.operation(Op::kSelect, {a[0], a[1], a[2], a[3]});
  }

  Identities identities_;
  Graph graph_;
};

/// The graph anew, vertex by vertex: keep(vertex, its operands in the new graph) adds it and says where it is.
template <class Keep>
std::vector<Id> rebuilt(const Graph& graph, std::span<const Id> outputs, const Keep& keep) {
  const std::vector<bool> used = reached(graph, outputs);
  std::vector<Id> now(graph.size());
  for (Id id = 0; id < graph.size(); ++id) {
    if (!used[id]) continue;
    std::array<Id, 4> args{};
    for (std::size_t k = 0; k < arity(graph[id].op); ++k) args[k] = now[graph[id].args[k]];
    now[id] = keep(graph[id], args);
  }
  std::vector<Id> ids;
  for (const Id id : outputs) ids.push_back(now[id]);
  return ids;
}

Id leaf(Graph& graph, const Vertex& v) {
  return v.op == Op::kConstant ? graph.constant(v.value) : graph.input(v.role, v.index);
}

}  // namespace

Outputs simplified(const Graph& graph, std::span<const Id> outputs, Identities identities) {
  Simplifier simple(identities);
  const auto ids = rebuilt(graph, outputs, [&](const Vertex& v, const std::array<Id, 4>& args) {
    return arity(v.op) == 0 ? leaf(simple.graph(), v) : simple.operation(v.op, args);
  });
  Outputs result;  // without what the identities have made useless
  result.ids = rebuilt(simple.graph(), ids, [&](const Vertex& v, const std::array<Id, 4>& args) {
    return arity(v.op) == 0 ? leaf(result.graph, v) : result.graph.operation(v.op, args);
  });
  return result;
}

}  // namespace mote::graph
