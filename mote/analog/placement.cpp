#include "mote/analog/placement.hpp"

#include "mote/analog/substitution.hpp"

namespace mote::analog {
namespace {

using graph::Graph;
using graph::Id;
using graph::Op;
using graph::Vertex;

bool is_arctan(const Vertex& v) { return v.op == Op::kAtan || v.op == Op::kAtan2; }

/// Marks what stands between circuits, and where values cross.
class Marking {
 public:
  Marking(Placement& placement, const std::map<Id, Part>& circuits, Method method, Wanted wanted)
      : p_(placement), graph_(placement.recorded.graph), method_(method) {
    p_.parts.assign(graph_.size(), Part::kDigital);
    p_.crossings.assign(graph_.size(), 0);
    p_.against_arctan.assign(graph_.size(), false);
    p_.to_digital.assign(graph_.size(), false);
    p_.behind_arctan.assign(graph_.size(), false);
    for (const auto& [id, part] : circuits) p_.parts[id] = part;
    const std::vector<bool> weighs = graph::reached(graph_, std::vector<Id>{p_.recorded.log_likelihood});
    const std::vector<bool> moves = graph::reached(graph_, p_.recorded.next);
    for (Id id = 0; id < graph_.size(); ++id)
      if (wanted.arctan && is_arctan(graph_[id]) && (weighs[id] || (method != Method::kWeights && moves[id])))
        p_.parts[id] = Part::kArctan;
    if (method == Method::kWeights) {
      between();
    } else {
      everything(weighs, moves);
    }
    behind();
    crossings();
    count();
  }

 private:
  static bool is_circuit(Part part) {
    return part == Part::kArctan || part == Part::kGaussian || part == Part::kSquare;
  }

  /// Method-1: what depends on an arctangent and leads to a Gaussian stays analog.
  void between() {
    std::vector<bool> after(graph_.size(), false);
    std::vector<bool> before(graph_.size(), false);
    for (Id id = 0; id < graph_.size(); ++id)
      for (const Id arg : graph_[id].operands())
        if (p_.parts[arg] == Part::kArctan || (after[arg] && !is_circuit(p_.parts[arg]))) after[id] = true;
    for (Id id = static_cast<Id>(graph_.size()); id-- > 0;)
      if (p_.parts[id] == Part::kGaussian || (before[id] && !is_circuit(p_.parts[id])))
        for (const Id arg : graph_[id].operands()) before[arg] = true;
    for (Id id = 0; id < graph_.size(); ++id) {
      if (after[id] && before[id] && p_.parts[id] == Part::kDigital) p_.parts[id] = Part::kCurrents;
      if (p_.parts[id] == Part::kGaussian || (p_.parts[id] == Part::kArctan && !before[id])) p_.to_digital[id] = true;
    }
  }

  /// Method-2 and 3: what a particle's state or draws touch is analog; the weights that choose ancestors are read.
  void everything(const std::vector<bool>& weighs, const std::vector<bool>& moves) {
    std::vector<bool> varies(graph_.size(), false);
    for (Id id = 0; id < graph_.size(); ++id) {
      const Vertex& v = graph_[id];
      if (v.op == Op::kInput && moves[id] && v.role == graph::Role::kNormal && p_.parts[id] == Part::kDigital)
        p_.parts[id] = Part::kSource;
      const bool particle = v.op == Op::kInput && v.role != graph::Role::kColumn && v.role != graph::Role::kSchedule &&
                            v.role != graph::Role::kTime;
      varies[id] = particle;
      for (const Id arg : v.operands()) varies[id] = varies[id] || varies[arg];
      if (p_.parts[id] == Part::kGaussian && weighs[id]) p_.to_digital[id] = true;
      if (v.op != Op::kInput && v.op != Op::kConstant && varies[id] && p_.parts[id] == Part::kDigital &&
          (weighs[id] || moves[id]) && v.op != Op::kLog)
        p_.parts[id] = Part::kCurrents;
    }
  }

  /// Which Gaussians and squares an arctangent's error reaches.
  void behind() {
    std::vector<bool> after(graph_.size(), false);
    for (Id id = 0; id < graph_.size(); ++id) {
      for (const Id arg : graph_[id].operands())
        after[id] = after[id] || p_.parts[arg] == Part::kArctan || (after[arg] && !is_circuit(p_.parts[arg]));
      p_.behind_arctan[id] = after[id] && (p_.parts[id] == Part::kGaussian || p_.parts[id] == Part::kSquare);
    }
  }

  void crossings() {
    for (Id id = 0; id < graph_.size(); ++id) {
      const Vertex& v = graph_[id];
      if (p_.parts[id] != Part::kCurrents && p_.parts[id] != Part::kGaussian) continue;
      bool arctan = false;
      for (std::size_t k = 0; k < graph::arity(v.op); ++k) {
        const Part part = p_.parts[v.args[k]];
        arctan = arctan || part == Part::kArctan;
        const bool input = graph_[v.args[k]].op == Op::kInput && graph_[v.args[k]].role != graph::Role::kColumn;
        const bool stays = method_ != Method::kWeights && input;
        if (part == Part::kDigital && !graph_.is_constant(v.args[k]) && !stays)
          p_.crossings[id] = static_cast<std::uint8_t>(p_.crossings[id] | (1U << k));
      }
      p_.against_arctan[id] = arctan && (v.op == Op::kAdd || v.op == Op::kSubtract) && p_.crossings[id] != 0;
    }
  }

  void count() {
    for (const Part part : p_.parts) {
      p_.arctans += part == Part::kArctan ? 1 : 0;
      p_.gaussians += part == Part::kGaussian || part == Part::kSquare ? 1 : 0;
    }
  }

  Placement& p_;
  const Graph& graph_;
  Method method_;
};

}  // namespace

std::optional<double> inverse_sigma(const Placement& placement, Id id) {
  const Graph& graph = placement.recorded.graph;
  const Vertex& operand = graph[graph[id].args[0]];
  if (operand.op != Op::kMultiply) return std::nullopt;
  for (const Id arg : operand.operands())
    if (graph.is_constant(arg)) return std::abs(graph[arg].value);
  return std::nullopt;
}

Placement placed(const graph::Recorded& recorded, Method method, Wanted wanted, const Cells& cells) {
  Placement placement;
  Substitution copy(recorded.graph, method, wanted);
  graph::Recorded& made = placement.recorded;
  made = recorded;
  for (Id& id : made.initial) id = copy.copied(id);
  if (method != Method::kWeights) {
    copy.analog = true;
    copy.memory = &cells;
    copy.draws = static_cast<std::uint32_t>(made.draws.size());
    made.draws.insert(made.draws.end(), made.states.size(), true);
  }
  for (Id& id : made.next) id = copy.copied(id);
  made.log_likelihood = copy.likelihood(recorded.log_likelihood);
  made.log_transition.reset();
  made.proposed.clear();
  made.log_ratio.reset();
  made.graph = std::move(copy.to);
  Marking(placement, copy.circuits, method, wanted);
  return placement;
}

Wanted functions_of(const graph::Recorded& recorded, Method method) {
  const Placement all = placed(recorded, method, {}, {});
  return {all.arctans > 0, all.gaussians > 0 && method != Method::kAllButRandom};
}

}  // namespace mote::analog
