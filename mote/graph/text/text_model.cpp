#include "mote/graph/text/text_model.hpp"

#include <algorithm>
#include <cmath>

#include "mote/graph/simplify.hpp"
#include "mote/graph/text/affine.hpp"
#include "mote/graph/text/tokens.hpp"

namespace mote::graph {
namespace {

/// log N(e; 0, sd^2), its constants computed once where sd is one.
Node normal_log_density(const Node& e, const Node& sd) {
  const Node variance = sd * sd;
  return e * e * (Node(-0.5) / variance) + Node(-0.5) * log(Node(2 * kPi) * variance);
}

class Builder {
 public:
  Builder(const TextFile& file, const std::vector<double>& parameters) : file_(file) {
    for (std::size_t k = 0; k < parameters.size(); ++k)
      parameters_.emplace(file.parameters[k].name, Node(parameters[k]));
    find_observations();
  }

  TextParts built() {
    build_prior();
    build_next();
    build_observations();
    build_transition();
    return std::move(parts_);
  }

 private:
  Node input(Role role, std::size_t index) { return {graph_, graph_.input(role, static_cast<std::uint32_t>(index))}; }

  Program program(const std::vector<Node>& outputs) {
    std::vector<Id> ids;
    for (const Node& node : outputs) ids.push_back(node.id_in(graph_));
    const Outputs simple = simplified(graph_, ids, Identities::kRounding);
    return {simple.graph, simple.ids};
  }

  /// Parses, and refuses what follows from parameters alone and is no number.
  template <class Parse>
  auto checked(const Source& source, const Parse& parse) {
    const std::size_t before = graph_.size();
    auto result = parse();
    for (Id id = static_cast<Id>(before); id < graph_.size(); ++id)
      if (graph_.is_constant(id) && !std::isfinite(graph_[id].value))
        throw Refusal(ExitCode::kBadData, {source.file + ":" + std::to_string(source.line), source.key,
                                           "parameters that give finite numbers", std::to_string(graph_[id].value),
                                           "Check it for divisions by zero, roots and logarithms."});
    return result;
  }

  void add_states(Vocabulary& vocabulary, Role role) {
    for (std::size_t d = 0; d < file_.states.size(); ++d) vocabulary.names.emplace(file_.states[d].key, input(role, d));
  }
  void name_elsewhere(Vocabulary& vocabulary, const std::string& what) const {
    for (const NamedNumber& column : file_.inputs) vocabulary.elsewhere.emplace(column.name, what);
    for (const std::string& name : observed_) vocabulary.elsewhere.emplace(name, what);
  }
  std::function<Node(bool)> draws(Role normal, Role uniform, std::vector<bool>& taken) {
    return [this, normal, uniform, &taken](bool is_normal) {
      taken.push_back(is_normal);
      return input(is_normal ? normal : uniform, taken.size() - 1);
    };
  }

  void build_prior() {
    Vocabulary vocabulary{parameters_, {}, draws(Role::kPriorNormal, Role::kPriorUniform, parts_.prior_draws)};
    name_elsewhere(vocabulary, "The data's columns are for [observations].");
    for (const Source& state : file_.states) vocabulary.elsewhere.emplace(state.key, "Priors know parameters only.");
    vocabulary.elsewhere.emplace("t", "Priors know parameters only.");
    std::vector<Node> states;
    for (const Source& state : file_.states)
      states.push_back(checked(state, [&] { return parse_expression(state, vocabulary); }));
    parts_.initial = program(states);
  }

  void build_next() {
    Vocabulary vocabulary{parameters_, {}, draws(Role::kNormal, Role::kUniform, parts_.draws)};
    name_elsewhere(vocabulary, "The data's columns are for [observations].");
    add_states(vocabulary, Role::kBefore);
    vocabulary.names.emplace("t", input(Role::kTime, 0));
    for (const Source& noise : file_.noise)
      vocabulary.names.emplace(noise.key, checked(noise, [&] { return parse_expression(noise, vocabulary); }));
    std::vector<Node> outputs;
    for (const Source& next : file_.next) {
      moves_.push_back(checked(next, [&] { return parse_maybe_wrapped(next, vocabulary); }));
      const MaybeWrapped& move = moves_.back();
      outputs.push_back(move.wrapped ? numbers::wrap(move.inner) : move.inner);
      const bool angle = move.wrapped || graph_[move.inner.id_in(graph_)].op == Op::kAtan2;
      parts_.states.push_back({next.key, angle ? "rad" : "", angle});
    }
    parts_.next = program(outputs);
  }

  /// The observations' names: those with a law, then what only log_likelihood speaks of.
  void find_observations() {
    for (const Source& law : file_.observations) observed_.push_back(law.key);
    const auto known = [&](const std::string& name) {
      const auto named = [&](const auto& entry) { return entry.name == name; };
      const auto keyed = [&](const Source& source) { return source.key == name; };
      return std::any_of(file_.inputs.begin(), file_.inputs.end(), named) || parameters_.contains(name) ||
             std::any_of(file_.states.begin(), file_.states.end(), keyed) ||
             std::find(observed_.begin(), observed_.end(), name) != observed_.end();
    };
    for (const Source& source : file_.log_likelihood) {
      const auto tokens = tokens_of(source);
      for (std::size_t k = 0; k + 1 < tokens.size(); ++k)
        if (tokens[k].kind == Token::Kind::kName && tokens[k + 1].text != "(" && is_free_name(tokens[k].text) &&
            !known(tokens[k].text))
          observed_.push_back(tokens[k].text);
    }
    parts_.observed = observed_.size();
  }

  void build_observations() {
    Vocabulary vocabulary{parameters_, {}, {}};
    add_states(vocabulary, Role::kState);
    vocabulary.names.emplace("t", input(Role::kTime, 0));
    for (std::size_t k = 0; k < file_.inputs.size(); ++k)
      vocabulary.names.emplace(file_.inputs[k].name, input(Role::kColumn, observed_.size() + k));
    for (const std::string& name : observed_)
      vocabulary.elsewhere.emplace(name, "The law of an observation does not know what was observed.");
    for (const Source& noise : file_.noise) vocabulary.elsewhere.emplace(noise.key, "Noise is for [next].");
    std::vector<Node> terms;
    std::vector<Node> drawn;
    for (const std::string& name : observed_) parts_.columns.push_back({.name = name, .unit = ""});
    for (std::size_t j = 0; j < file_.observations.size(); ++j) build_law(j, vocabulary, terms, drawn);
    parts_.without_law = drawn.size() == observed_.size() ? "" : observed_[drawn.size()];
    for (const NamedNumber& column : file_.inputs)
      parts_.columns.push_back({.name = column.name, .unit = "", .input = true, .fallback = column.value});
    if (!file_.log_likelihood.empty()) terms = {spoken_likelihood(std::move(vocabulary))};
    parts_.observe = program(drawn);
    for (const Node& term : terms) {
      parts_.laws.push_back(program({term}));
      parts_.needs.push_back(observations_of(term));
    }
    Node sum = terms[0];
    for (std::size_t k = 1; k < terms.size(); ++k) sum = sum + terms[k];
    parts_.whole = program({sum});
  }

  void build_law(std::size_t j, const Vocabulary& vocabulary, std::vector<Node>& terms, std::vector<Node>& drawn) {
    const Source& source = file_.observations[j];
    if (source.text.empty()) return;
    const ParsedLaw law = checked(source, [&] { return parse_law(source, vocabulary); });
    Column& column = parts_.columns[j];
    column.angle = law.angle;
    if (law.angle) column.unit = "rad";
    for (std::size_t d = 0; d < file_.states.size(); ++d)
      if (law.mean.id_in(graph_) == input(Role::kState, d).id_in(graph_)) column.state = file_.states[d].key;
    const Node error = input(Role::kColumn, j) - law.mean;
    terms.push_back(normal_log_density(law.angle ? numbers::wrap(error) : error, law.sd));
    const Node seen = law.mean + law.sd * input(Role::kNormal, drawn.size());
    if (drawn.size() == j) drawn.push_back(law.angle ? numbers::wrap(seen) : seen);
  }

  Node spoken_likelihood(Vocabulary vocabulary) {
    const Source& source = file_.log_likelihood[0];
    for (std::size_t j = 0; j < observed_.size(); ++j) {
      vocabulary.elsewhere.erase(observed_[j]);
      vocabulary.names.emplace(observed_[j], input(Role::kColumn, j));
    }
    const Node spoken = checked(source, [&] { return parse_expression(source, vocabulary); });
    if (observations_of(spoken).empty())
      throw Refusal(ExitCode::kBadData,
                    {source.file + ":" + std::to_string(source.line), source.key,
                     "an expression of at least one observation", "none", "Example: -(y - x)^2/2."});
    return spoken;
  }

  std::vector<std::size_t> observations_of(const Node& node) {
    std::vector<std::size_t> all;
    const std::array<Id, 1> output{node.id_in(graph_)};
    const std::vector<bool> used = reached(graph_, output);
    for (Id id = 0; id < used.size(); ++id) {
      const Vertex& v = graph_[id];
      if (used[id] && v.op == Op::kInput && v.role == Role::kColumn && v.index < observed_.size())
        all.push_back(v.index);
    }
    return all;
  }

  void build_transition() {
    std::vector<Node> ends;
    for (const MaybeWrapped& move : moves_) ends.push_back(move.inner);
    const auto affine = affine_in_own_noise(graph_, ends);
    if (!affine) return;
    Node sum;
    for (std::size_t d = 0; d < moves_.size(); ++d) {
      const Node error = input(Role::kState, d) - (*affine)[d].rest;
      const Node term = normal_log_density(moves_[d].wrapped ? numbers::wrap(error) : error, (*affine)[d].factor);
      sum = d == 0 ? term : sum + term;
    }
    parts_.transition = program({sum});
  }

  const TextFile& file_;
  std::map<std::string, Node> parameters_;
  std::vector<std::string> observed_;
  std::vector<MaybeWrapped> moves_;
  Graph graph_;
  TextParts parts_;
};

}  // namespace

SmallVector<const Program*> TextParts::seen(const std::vector<bool>& present) const {
  SmallVector<const Program*> all;
  for (std::size_t k = 0; k < laws.size(); ++k)
    if (std::all_of(needs[k].begin(), needs[k].end(), [&](std::size_t j) { return present[j]; }))
      all.push_back(&laws[k]);
  if (all.size() == laws.size()) return {&whole};
  return all;
}

TextModel::TextModel(const TextFile& file, const std::vector<double>& parameters)
    : parts_(std::make_shared<const TextParts>(Builder(file, parameters).built())) {}

void TextModel::refuse_without_laws() const {
  if (!parts_->without_law.empty())
    throw Refusal(ExitCode::kWrongUse,
                  {"a model given as text", "observation \"" + parts_->without_law + "\"",
                   "a law that it can be drawn from", "none", "Write normal(mean, sd) or angle(mean, sd)."});
}

}  // namespace mote::graph
