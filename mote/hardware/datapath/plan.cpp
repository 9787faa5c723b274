#include "mote/hardware/datapath/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace mote::hardware {
namespace {

using graph::Graph;
using graph::Id;
using graph::Op;
using graph::Role;
using graph::Vertex;

/// A vertex times a number.
struct Scaled {
  Id id;
  double factor;
};

/// Rewrites the log likelihood as the plan has it.
class Weigher {
 public:
  Weigher(const graph::Recorded& recorded, Graph& graph, Plan& plan)
      : recorded_(recorded), graph_(graph), plan_(plan), host_(of_the_host(graph)) {}

  /// The log weight of a pair of state and parent, and the move that proposes it: the model's own where something is
  /// unseen.
  Id with_proposal(Id log_weight, std::vector<Id>& next) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t j = 0; j < plan_.columns; ++j)
      if (!recorded_.columns[j].input) all.push_back(j);
    const Id ratio = masked(times(*recorded_.log_ratio, std::numbers::log2e), all);
    for (std::size_t d = 0; d < next.size(); ++d) next[d] = masked(recorded_.proposed[d], all, next[d]);
    return add(log_weight, ratio);
  }

  Id log_weight(Id log_likelihood) {
    collect(log_likelihood, std::numbers::log2e);
    std::optional<Id> plus;
    std::optional<Id> minus;
    while (!terms_.empty()) {
      const double factor = terms_.front().factor;
      std::vector<Id> group;
      std::erase_if(terms_, [&](const Scaled& term) {
        const bool same = term.factor == factor;
        if (same) group.push_back(term.id);
        return same;
      });
      const bool within = squares(group);
      const bool turned = within && factor < 0 && differences(group);
      const Id sum = within ? sum_of(group, std::sqrt(std::abs(factor)), turned) : times(sum_of(group, 1), factor);
      std::optional<Id>& side = within && factor < 0 && !turned ? minus : plus;
      side = side ? add(*side, sum) : sum;
    }
    if (!minus) return plus ? *plus : graph_.constant(0);
    return plus ? graph_.operation(Op::kSubtract, {*plus, *minus}) : graph_.operation(Op::kNegate, {*minus});
  }

 private:
  Id add(Id a, Id b) { return graph_.operation(Op::kAdd, {a, b}); }
  Id times(Id a, double c) { return c == 1 ? a : graph_.operation(Op::kMultiply, {a, graph_.constant(c)}); }
  bool is_host(Id id) const { return id < host_.size() && host_[id]; }

  /// The other operand of a product with a constant.
  std::optional<Scaled> by_constant(Id id) const {
    const Vertex& v = graph_[id];
    if (v.op != Op::kMultiply) return {};
    if (graph_.is_constant(v.args[0])) return Scaled{v.args[1], graph_[v.args[0]].value};
    if (graph_.is_constant(v.args[1])) return Scaled{v.args[0], graph_[v.args[1]].value};
    return {};
  }

  /// The terms of factor * id; what does not depend on the state is left out.
  void collect(Id id, double factor) {
    const Vertex v = graph_[id];
    if (v.op == Op::kConstant) {
      plan_.constant += factor * v.value;
    } else if (is_host(id)) {
      return;
    } else if (v.op == Op::kAdd || v.op == Op::kSubtract) {
      collect(v.args[0], factor);
      collect(v.args[1], v.op == Op::kAdd ? factor : -factor);
    } else if (v.op == Op::kNegate) {
      collect(v.args[0], -factor);
    } else if (const auto product = by_constant(id)) {
      collect(product->id, factor * product->factor);
    } else {
      terms_.push_back({id, factor});
    }
  }

  /// The observations that a vertex depends on.
  std::vector<std::uint32_t> needs(Id id) const {
    std::set<std::uint32_t> all;
    for (const Id at : needed(graph_, std::span(&id, 1)))
      if (const Vertex& v = graph_[at];
          v.op == Op::kInput && v.role == Role::kColumn && v.index < plan_.columns && !recorded_.columns[v.index].input)
        all.insert(v.index);
    return {all.begin(), all.end()};
  }

  /// term where everything it reads was seen, else 0.
  Id masked(Id term, const std::vector<std::uint32_t>& needs) {
    return needs.empty() ? term : masked(term, needs, graph_.constant(0));
  }
  Id masked(Id term, const std::vector<std::uint32_t>& needs, Id otherwise) {
    auto place = std::find(plan_.seen.begin(), plan_.seen.end(), needs);
    if (place == plan_.seen.end()) place = plan_.seen.insert(place, needs);
    const auto bit = static_cast<std::uint32_t>(place - plan_.seen.begin());
    const Id seen = graph_.input(Role::kColumn, plan_.columns + bit);
    return graph_.operation(Op::kSelect, {seen, graph_.constant(0.5), otherwise, term});
  }

  /// Whether all terms are squares of what takes up a factor.
  bool squares(const std::vector<Id>& terms) const {
    return std::all_of(terms.begin(), terms.end(), [&](Id id) {
      return graph_[id].op == Op::kMultiply && graph_[id].args[0] == graph_[id].args[1] && scales(graph_[id].args[0]);
    });
  }
  /// Whether all terms are squares of differences, whose negatives (a - b) (b - a) cost nothing.
  bool differences(const std::vector<Id>& terms) const {
    return std::all_of(terms.begin(), terms.end(),
                       [&](Id id) { return graph_[graph_[id].args[0]].op == Op::kSubtract; });
  }
  /// The sum of the terms, each only where it was seen; squares of `root` times their sides, negative ones if
  /// `turned`.
  Id sum_of(const std::vector<Id>& terms, double root, bool turned = false) {
    std::optional<Id> sum;
    for (const Id term : terms) {
      Id inner = term;
      if (root != 1 || turned) {
        const Id side = scaled(graph_[term].args[0], root);
        const Vertex v = graph_[side];
        inner = graph_.operation(Op::kMultiply, {side, turned ? graph_.operation(v.op, {v.args[1], v.args[0]}) : side});
      }
      const Id part = masked(inner, needs(term));
      sum = sum ? add(*sum, part) : part;
    }
    return *sum;
  }

  /// Whether a factor costs nothing: it goes into constants and into what the host computes.
  bool scales(Id id) const {
    const Vertex& v = graph_[id];
    if (v.op == Op::kConstant || is_host(id) || by_constant(id)) return true;
    if (v.op == Op::kAdd || v.op == Op::kSubtract) return scales(v.args[0]) && scales(v.args[1]);
    return v.op == Op::kNegate && scales(v.args[0]);
  }
  Id scaled(Id id, double factor) {
    const Vertex v = graph_[id];
    if (v.op == Op::kConstant) return graph_.constant(v.value * factor);
    if (is_host(id)) return times(id, factor);
    if (const auto product = by_constant(id)) return times(product->id, product->factor * factor);
    if (v.op == Op::kNegate) return graph_.operation(v.op, {scaled(v.args[0], factor)});
    const Id left = scaled(v.args[0], factor);
    return graph_.operation(v.op, {left, scaled(v.args[1], factor)});
  }

  const graph::Recorded& recorded_;
  Graph& graph_;
  Plan& plan_;
  std::vector<bool> host_;
  std::vector<Scaled> terms_;
};

/// The vertices of the host that others use, or that are results.
std::vector<Id> fields_of(const Plan& plan) {
  const std::vector<bool> host = of_the_host(plan.graph);
  std::set<Id> fields;
  for (const Part part : kParts) {
    const std::vector<Id> outputs = plan.outputs(part);
    for (const Id id : outputs)
      if (host[id]) fields.insert(id);
    for (const Id id : needed(plan.graph, outputs))
      for (const Id arg : plan.graph[id].operands())
        if (host[arg] && !host[id]) fields.insert(arg);
  }
  return {fields.begin(), fields.end()};
}

}  // namespace

int Plan::seen_bit(Id id) const {
  const Vertex& v = graph[id];
  const bool bit = v.op == Op::kInput && v.role == Role::kColumn && v.index >= columns;
  return bit ? static_cast<int>(v.index - columns) : -1;
}

std::vector<Id> Plan::outputs(Part part) const {
  if (part == Part::kInitial) return initial;
  if (part == Part::kNext) return next;
  return {log_weight};
}

std::vector<bool> of_the_host(const Graph& graph) {
  std::vector<bool> host(graph.size());
  for (Id id = 0; id < graph.size(); ++id) {
    const Vertex& v = graph[id];
    if (v.op == Op::kInput) host[id] = v.role == Role::kColumn || v.role == Role::kSchedule || v.role == Role::kTime;
    bool all = true;
    bool any = false;
    for (const Id arg : v.operands()) {
      all = all && (host[arg] || graph.is_constant(arg));
      any = any || host[arg];
    }
    if (graph::arity(v.op) > 0) host[id] = all && any;
  }
  return host;
}

std::vector<Id> needed(const Graph& graph, std::span<const Id> outputs) {
  const std::vector<bool> used = graph::reached(graph, outputs);
  std::vector<Id> all;
  for (Id id = 0; id < graph.size(); ++id)
    if (used[id]) all.push_back(id);
  return all;
}

Plan plan_of(const graph::Recorded& recorded) {
  Plan plan;
  plan.columns = static_cast<std::uint32_t>(recorded.columns.size());
  Graph graph = recorded.graph;
  std::vector<Id> outputs = recorded.initial;
  std::vector<Id> next = recorded.next;
  Weigher weigher(recorded, graph, plan);
  Id log_weight = weigher.log_weight(recorded.log_likelihood);
  if (recorded.log_ratio) log_weight = weigher.with_proposal(log_weight, next);
  outputs.insert(outputs.end(), next.begin(), next.end());
  outputs.push_back(log_weight);
  graph::Outputs simple = graph::simplified(graph, outputs, graph::Identities::kRounding);
  const auto dims = static_cast<std::ptrdiff_t>(recorded.states.size());
  plan.graph = std::move(simple.graph);
  plan.initial.assign(simple.ids.begin(), simple.ids.begin() + dims);
  plan.next.assign(simple.ids.begin() + dims, simple.ids.begin() + 2 * dims);
  plan.log_weight = simple.ids.back();
  plan.fields = fields_of(plan);
  return plan;
}

}  // namespace mote::hardware
