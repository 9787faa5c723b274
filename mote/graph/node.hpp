#pragma once
/// Node: the number type that records. A model's lines run on it leave their arithmetic in a graph.

#include "mote/base/numbers.hpp"
#include "mote/graph/evaluate.hpp"
#include "mote/graph/graph.hpp"

namespace mote::graph {

/// A vertex of a graph, or a constant that no graph has seen yet.
///
/// A number type that models accept: it has the arithmetic of model/model.hpp. Constants are combined at once, in
/// double, as the model would combine them; one enters the graph where it meets a vertex.
class Node {
 public:
  Node() = default;
  explicit Node(double constant) : constant_(constant) {}
  Node(Graph& graph, Id id) : graph_(&graph), id_(id) {}
  /// A constant that follows t in the way that the mark stands for: so does what is computed from it.
  static Node following_t(double constant, std::uint64_t mark) {
    Node node(constant);
    node.mark_ = mark;
    return node;
  }

  bool is_constant() const { return graph_ == nullptr; }
  double constant() const { return constant_; }
  /// The vertex, in the graph.
  Id id_in(Graph& graph) const {
    if (graph_ != nullptr) return id_;
    return mark_ == 0 ? graph.constant(constant_) : graph.constant_of_step(constant_, mark_);
  }

  friend Node operator+(const Node& a, const Node& b) { return made(Op::kAdd, a, b); }
  friend Node operator-(const Node& a, const Node& b) { return made(Op::kSubtract, a, b); }
  friend Node operator*(const Node& a, const Node& b) { return made(Op::kMultiply, a, b); }
  friend Node operator/(const Node& a, const Node& b) { return made(Op::kDivide, a, b); }
  friend Node operator-(const Node& a) { return made(Op::kNegate, a); }
  friend Node abs(const Node& a) { return made(Op::kAbs, a); }
  friend Node floor(const Node& a) { return made(Op::kFloor, a); }
  friend Node sqrt(const Node& a) { return made(Op::kSqrt, a); }
  friend Node exp(const Node& a) { return made(Op::kExp, a); }
  friend Node log(const Node& a) { return made(Op::kLog, a); }
  friend Node sin(const Node& a) { return made(Op::kSin, a); }
  friend Node cos(const Node& a) { return made(Op::kCos, a); }
  friend Node tan(const Node& a) { return made(Op::kTan, a); }
  friend Node atan(const Node& a) { return made(Op::kAtan, a); }
  friend Node atan2(const Node& a, const Node& b) { return made(Op::kAtan2, a, b); }

  /// a < b, as select() takes it.
  struct Condition;
  friend Condition less(const Node& a, const Node& b);
  friend Node select(const Condition& condition, const Node& a, const Node& b);

 private:
  template <class... N>
  static Node made(Op op, const N&... nodes) {
    Graph* graph = nullptr;
    ((graph = nodes.graph_ == nullptr ? graph : nodes.graph_), ...);
    if (graph == nullptr)
      return following_t(apply<double>(op, {nodes.constant_...}), mark_of(op, {nodes.constant_...}, {nodes.mark_...}));
    return {*graph, graph->operation(op, {nodes.id_in(*graph)...})};
  }

  Graph* graph_ = nullptr;
  Id id_ = 0;
  double constant_ = 0;
  std::uint64_t mark_ = 0;  ///< of a constant that follows t
};

struct Node::Condition {
  Node a, b;
};

inline Node::Condition less(const Node& a, const Node& b) { return {a, b}; }
inline Node select(const Node::Condition& condition, const Node& a, const Node& b) {
  return Node::made(Op::kSelect, condition.a, condition.b, a, b);
}

}  // namespace mote::graph
