#pragma once
/// Recording: a model's lines, run on Node, become one graph.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mote/graph/node.hpp"
#include "mote/graph/simplify.hpp"
#include "mote/model/model.hpp"

namespace mote::graph {

/// A model as a graph: what each of its functions gives, and what the inputs are called.
///
/// Draws are inputs, numbered in the order in which the model takes them; a model's parameters are constants. Numbers
/// that a model computes in double from t alone (a cosine of t) are inputs of the role kSchedule, which schedule(t)
/// gives. The likelihood is that of one row with everything seen.
struct Recorded {
  Graph graph;
  std::vector<Id> initial;           ///< (D,), x_0 from kPriorNormal and kPriorUniform
  std::vector<Id> next;              ///< (D,), x_t from kBefore, kSchedule, kNormal and kUniform
  Id log_likelihood = 0;             ///< from kState, kColumn and kSchedule
  std::optional<Id> log_transition;  ///< from kState, kBefore and kSchedule
  std::vector<Id> proposed;          ///< (D,), x_t by a proposal from kColumn too, if one was recorded; else empty
  std::optional<Id> log_ratio;       ///< log p(x_t | x_{t-1}) / g(x_t | x_{t-1}, y_t) of that proposal
  std::vector<Quantity> states;      ///< by the index of kState and kBefore
  std::vector<Column> columns;       ///< by the index of kColumn
  std::vector<bool> prior_draws;     ///< by the index of kPriorNormal, kPriorUniform: whether it is normal
  std::vector<bool> draws;           ///< likewise for moves
  std::vector<bool> proposal_draws;  ///< likewise for proposals, whose inputs are kNormal and kUniform as well
  std::function<std::vector<double>(Step)> schedule;  ///< by the index of kSchedule

  /// initial, next, log_likelihood and log_transition one after the other.
  std::vector<Id> outputs() const;
  /// What a filter computes: initial, next and log_likelihood.
  std::vector<Id> filter_outputs() const;
  /// What an input is called: "x", "x before", "y", "normal 0".
  std::string name_of(const Vertex& input) const;
};

/// What one pass over a model's lines leaves: a trace, with its constants apart.
struct Trace {
  Graph graph{Constants::kApart};
  std::vector<Id> outputs;
  bool has_transition = false;
  std::vector<bool> prior_draws, draws, proposal_draws;
};

/// A recording from the traces of one model at several steps; `trace(t)` makes one.
///
/// error   std::logic_error if the model does other operations at other steps
Recorded recorded(const std::function<Trace(Step)>& trace, std::vector<Quantity> states, std::vector<Column> columns,
                  Identities identities);

/// Draws that are inputs of a graph.
class InputDraw {
 public:
  InputDraw(Graph& graph, Role normal, Role uniform, std::vector<bool>& taken)
      : graph_(&graph), normal_(normal), uniform_(uniform), taken_(&taken) {}

  Node normal() { return take(normal_, true); }
  Node uniform() { return take(uniform_, false); }

 private:
  Node take(Role role, bool normal) {
    taken_->push_back(normal);
    return {*graph_, graph_->input(role, static_cast<std::uint32_t>(taken_->size() - 1))};
  }

  Graph* graph_;
  Role normal_, uniform_;
  std::vector<bool>* taken_;
};

/// The model's lines at step t on Node.
template <Model M>
Trace trace(const M& model, Step t) {
  Trace trace;
  Graph& graph = trace.graph;
  const auto inputs = [&](Role role, auto& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = Node(graph, graph.input(role, static_cast<std::uint32_t>(i)));
  };
  const auto output = [&](const Node& node) { trace.outputs.push_back(node.id_in(graph)); };
  auto x = blank_state<Node>(model);
  auto before = blank_state<Node>(model);
  const std::size_t width = model.columns().size();
  Row<Node> row{std::vector<Node>(width), std::vector<bool>(width, true)};
  inputs(Role::kState, x);
  inputs(Role::kBefore, before);
  inputs(Role::kColumn, row.values);
  InputDraw prior(graph, Role::kPriorNormal, Role::kPriorUniform, trace.prior_draws);
  InputDraw move(graph, Role::kNormal, Role::kUniform, trace.draws);
  for (const Node& node : model.template initial<Node>(prior)) output(node);
  for (const Node& node : model.template next<Node>(t, before, move)) output(node);
  output(model.template log_likelihood<Node>(t, x, row));
  if constexpr (HasTransition<M>) {
    trace.has_transition = model.density() != Density::kNone;
    if (trace.has_transition) output(model.template log_transition<Node>(t, x, before));
  }
  return trace;
}

/// The model's lines at step t with those of a proposal, for one row with everything seen.
template <class G, Model M>
Trace trace_with(const M& model, Step t) {
  Trace made = trace(model, t);
  Graph& graph = made.graph;
  auto x = blank_state<Node>(model);
  auto before = blank_state<Node>(model);
  for (std::size_t d = 0; d < x.size(); ++d) {
    x[d] = Node(graph, graph.input(Role::kState, static_cast<std::uint32_t>(d)));
    before[d] = Node(graph, graph.input(Role::kBefore, static_cast<std::uint32_t>(d)));
  }
  std::vector<Node> seen;
  for (std::size_t j = 0; j < model.columns().size(); ++j)
    seen.emplace_back(graph, graph.input(Role::kColumn, static_cast<std::uint32_t>(j)));
  const Row<Node> row = Row<Node>::of(seen);
  const Rows<Node> rows(&row, 1);
  const G proposal = make_proposal<G>(model);
  InputDraw draw(graph, Role::kNormal, Role::kUniform, made.proposal_draws);
  for (const Node& node : proposal.template propose<Node>(model, t, before, rows, draw))
    made.outputs.push_back(node.id_in(graph));
  const Node ratio = model.template log_transition<Node>(t, x, before) -
                     proposal.template log_density<Node>(model, t, x, before, rows);
  made.outputs.push_back(ratio.id_in(graph));
  return made;
}

/// Records a model.
///
/// error   std::logic_error if it does other operations at other steps
/// cost    a few evaluations of the model; schedule(t) one more
template <Model M>
Recorded record(const M& model, Identities identities = Identities::kExact) {
  return recorded([model](Step t) { return trace(model, t); }, model.states(), model.columns(), identities);
}

/// Records a model with one of its proposals.
///
/// error, cost   as record()
template <class G, Model M>
Recorded record_with(const M& model) {
  return recorded([model](Step t) { return trace_with<G>(model, t); }, model.states(), model.columns(),
                  Identities::kExact);
}

}  // namespace mote::graph
