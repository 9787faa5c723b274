#include "mote/hardware/datapath/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "mote/graph/evaluate.hpp"

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Op;
using graph::Vertex;

constexpr Id kRoot = static_cast<Id>(-1);  // what has several sources

/// By vertex: the nearest one that all its paths to inputs lead through.
std::vector<Id> dominators(const Plan& plan) {
  const graph::Graph& graph = plan.graph;
  const std::vector<bool> host = of_the_host(graph);
  std::vector<Id> above(graph.size(), kRoot);
  const auto meet = [&](Id a, Id b) {
    while (a != b) {
      if (a == kRoot || b == kRoot) return kRoot;
      (a > b ? a : b) = above[std::max(a, b)];
    }
    return a;
  };
  for (Id id = 0; id < graph.size(); ++id) {
    if (host[id]) continue;
    bool first = true;
    for (const Id arg : graph[id].operands()) {
      if (graph.is_constant(arg)) continue;
      above[id] = first ? arg : meet(above[id], arg);
      first = false;
    }
  }
  return above;
}

/// The vertices from a source, itself left out, to a root.
std::vector<Id> cone(const Plan& plan, Id source, Id root) {
  std::set<Id> all{root};
  for (auto place = all.rbegin(); place != all.rend(); ++place)
    for (const Id arg : plan.graph[*place].operands())
      if (arg != source) all.insert(arg);
  return {all.begin(), all.end()};
}

class Search {
 public:
  Search(const Plan& plan, const Precision& precision, const FunctionOptions& options)
      : plan_(plan), precision_(precision), options_(options), above_(dominators(plan)), users_(plan.graph.size()) {
    for (const Part part : kParts) {
      const auto outputs = plan.outputs(part);
      for (const Id id : outputs) users_[id].insert(kRoot);
      for (const Id id : needed(plan.graph, outputs))
        for (const Id arg : plan.graph[id].operands()) users_[arg].insert(id);
    }
  }

  std::map<Id, Fused> found() {
    for (Id root = static_cast<Id>(plan_.graph.size()); root-- > 0;)
      if (!users_[root].empty() && !spared_.contains(root)) consider(root);
    return std::move(fused_);
  }

 private:
  /// What of a cone nobody else uses.
  std::vector<Id> spared_by(Id source, Id root) const {
    const std::vector<Id> all = cone(plan_, source, root);
    std::set<Id> own{root};
    for (auto place = all.rbegin(); place != all.rend(); ++place)
      if (std::all_of(users_[*place].begin(), users_[*place].end(), [&](Id user) { return own.contains(user); }))
        own.insert(*place);
    return {own.begin(), own.end()};
  }

  void consider(Id root) {
    int most = 0;
    for (Id source = above_[root]; source != kRoot; source = above_[source]) {
      if (is_draw(source)) continue;  // its words are a table's already
      const std::vector<Id> own = spared_by(source, root);
      int cost = 0;
      for (const Id id : own) cost += operator_cost(plan_, precision_, id);
      if (cost <= most + kLeastTable) continue;
      const auto unit = table(source, root);
      if (!unit || cost - unit->cost() <= most) continue;
      most = cost - unit->cost();
      fused_.insert_or_assign(root, Fused{source, *unit});
    }
    if (const auto found = fused_.find(root); found != fused_.end())
      for (const Id id : spared_by(found->second.source, root)) spared_.insert(id);
  }

  bool is_draw(Id id) const {
    const Vertex& v = plan_.graph[id];
    return v.op == Op::kInput && v.role != graph::Role::kState && v.role != graph::Role::kBefore;
  }

  std::optional<FunctionTable> table(Id source, Id root) const {
    const auto function = function_between(plan_, source, root);
    const Format& x = precision_.formats[source];
    if (x.width() > kWidest) return {};
    const auto unit = cheapest_table(function, x, precision_.formats[root], folds(function, x), options_.multiplier);
    return unit && options_.logic_tables ? unit->in_logic() : unit;
  }

  /// How a function's table may be folded: by its symmetry, if it has one.
  static std::vector<Fold> folds(const std::function<double(double)>& function, const Format& x) {
    if (!x.sign) return {Fold::kPlain};
    bool odd = true;
    bool even = true;
    for (int k = 1; k <= 64; ++k) {
      const double at = x.value(x.greatest()) * k / 64;
      const double right = function(at);
      const double left = function(-at);
      const double slack = 1e-9 * (std::abs(right) + std::abs(left));
      odd = odd && std::abs(right + left) <= slack;
      even = even && std::abs(right - left) <= slack;
    }
    if (odd) return {Fold::kOdd};
    if (even) return {Fold::kEven};
    return {Fold::kPlain, Fold::kSides};
  }

  static constexpr int kWidest = 20;
  static constexpr int kLeastTable = 40;  ///< no table worth a search is cheaper than that

  const Plan& plan_;
  const Precision& precision_;
  FunctionOptions options_;
  std::vector<Id> above_;
  std::vector<std::set<Id>> users_;
  std::map<Id, Fused> fused_;
  std::set<Id> spared_;
};

}  // namespace

std::function<double(double)> function_between(const Plan& plan, Id source, Id root) {
  const std::vector<Id> order = cone(plan, source, root);
  return [&plan, order, source, root, values = std::vector<double>(plan.graph.size())](double x) mutable {
    values[source] = x;
    std::array<double, 4> operands{};
    for (const Id id : order) {
      const Vertex& v = plan.graph[id];
      for (std::size_t k = 0; k < graph::arity(v.op); ++k) operands[k] = values[v.args[k]];
      values[id] = v.op == Op::kConstant ? v.value : graph::apply<double>(v.op, operands);
    }
    return values[root];
  };
}

int operator_cost(const Plan& plan, const Precision& precision, Id id) {
  const Vertex& v = plan.graph[id];
  const int width = precision.formats[id].width();
  const auto operand = [&](std::size_t k) { return precision.formats[v.args[k]].width(); };
  const auto cost = [](int luts, int blocks, int clocks) { return luts + blocks * kLutsOfDsp + clocks * kLutsOfClock; };
  switch (v.op) {
    case Op::kConstant:
    case Op::kInput:
    case Op::kFloor:
      return 0;
    case Op::kMultiply: {
      const bool constant = plan.graph.is_constant(v.args[0]) || plan.graph.is_constant(v.args[1]);
      if (constant) return cost(2 * width, 0, 3);
      const int blocks =
          ((std::max(operand(0), operand(1)) + 24) / 25) * ((std::min(operand(0), operand(1)) + 17) / 18);
      return cost(width, blocks, 3);
    }
    case Op::kDivide:
      return cost(5 * (operand(0) + operand(1)) + 2 * width, 3, 20);
    case Op::kSqrt:
    case Op::kExp:
    case Op::kLog:
      return cost(5 * operand(0) + 2 * width, 2, 16);
    case Op::kSin:
    case Op::kCos:
      return cost(3 * operand(0) + 4 * width, 3, 16);
    case Op::kTan:
      return cost(8 * operand(0) + 2 * width, 4, 24);
    case Op::kAtan:
      return cost(2 * operand(0), 2, 10);
    case Op::kAtan2:
      return cost(8 * operand(0), 5, 24);
    default:
      return cost(2 * width, 0, 1);
  }
}

std::map<Id, Fused> fused(const Plan& plan, const Precision& precision, const FunctionOptions& options) {
  return Search(plan, precision, options).found();
}

}  // namespace mote::hardware
