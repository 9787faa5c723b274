#include "mote/graph/text/affine.hpp"

#include <set>

namespace mote::graph {
namespace {

/// rest + factor z of draw `draw`; without a draw, rest alone.
struct Form {
  Node rest, factor;
  std::optional<std::uint32_t> draw;
};

/// Forms of all vertices; empty where a vertex has none.
class Forms {
 public:
  explicit Forms(Graph& graph) : graph_(graph), forms_(graph.size()) {
    const auto size = static_cast<Id>(graph.size());
    for (Id id = 0; id < size; ++id) forms_[id] = form_of(id);
  }

  const std::optional<Form>& of(Id id) const { return forms_[id]; }

 private:
  std::optional<Form> form_of(Id id) {
    const Vertex v = graph_[id];
    const Node itself(graph_, id);
    if (v.op == Op::kConstant) return Form{Node(v.value), Node(0), {}};
    if (v.op == Op::kInput) {
      if (v.role == Role::kNormal) return Form{Node(0), Node(1), v.index};
      if (v.role == Role::kUniform) return std::nullopt;
      return Form{itself, Node(0), {}};
    }
    bool drawn = false;
    for (const Id arg : v.operands()) {
      if (!forms_[arg]) return std::nullopt;
      drawn = drawn || forms_[arg]->draw.has_value();
    }
    if (!drawn) return Form{itself, Node(0), {}};
    return combined(v, *forms_[v.args[0]], *forms_[v.args[1]]);
  }

  static std::optional<Form> combined(const Vertex& v, const Form& a, const Form& b) {
    switch (v.op) {
      case Op::kNegate:
        return Form{-a.rest, -a.factor, a.draw};
      case Op::kAdd:
      case Op::kSubtract: {
        if (a.draw && b.draw && *a.draw != *b.draw) return std::nullopt;
        const bool adds = v.op == Op::kAdd;
        return Form{adds ? a.rest + b.rest : a.rest - b.rest, adds ? a.factor + b.factor : a.factor - b.factor,
                    a.draw ? a.draw : b.draw};
      }
      case Op::kMultiply:
        if (a.draw && b.draw) return std::nullopt;
        return a.draw ? Form{a.rest * b.rest, a.factor * b.rest, a.draw}
                      : Form{a.rest * b.rest, a.rest * b.factor, b.draw};
      case Op::kDivide:
        if (b.draw) return std::nullopt;
        return Form{a.rest / b.rest, a.factor / b.rest, a.draw};
      default:
        return std::nullopt;
    }
  }

  Graph& graph_;
  std::vector<std::optional<Form>> forms_;
};

}  // namespace

std::optional<std::vector<Affine>> affine_in_own_noise(Graph& graph, const std::vector<Node>& expressions) {
  std::vector<Id> ids;
  for (const Node& node : expressions) ids.push_back(node.id_in(graph));
  const Forms forms(graph);
  std::set<std::uint32_t> taken;
  std::vector<Affine> all;
  for (const Id id : ids) {
    const std::optional<Form>& form = forms.of(id);
    if (!form || !form->draw || !taken.insert(*form->draw).second) return std::nullopt;
    if (form->factor.is_constant() && form->factor.constant() == 0) return std::nullopt;
    all.push_back({form->rest, form->factor});
  }
  return all;
}

}  // namespace mote::graph
