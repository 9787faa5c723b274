#include "mote/hardware/datapath/datapath.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <span>

#include "mote/graph/evaluate.hpp"
#include "mote/hardware/datapath/directions.hpp"
#include "mote/hardware/datapath/draws.hpp"
#include "mote/hardware/datapath/mapping.hpp"
#include "mote/hardware/random.hpp"

namespace mote::hardware {
namespace {

using graph::Id;
using graph::Op;
using graph::Role;
using graph::Vertex;

std::string numbered(const char* name, std::size_t k) { return name + std::to_string(k) + "_i"; }

/// The words that a particle takes: each has a draw of the move and one of the prior.
std::size_t draw_words(const graph::Recorded& recorded) {
  return std::max({recorded.prior_draws.size(), recorded.draws.size(), recorded.proposal_draws.size()});
}

/// Builds the pipelines of a plan.
class Builder {
 public:
  Builder(const Plan& plan, const graph::Recorded& recorded, const Precision& precision, const DatapathOptions& options)
      : plan_(plan),
        recorded_(recorded),
        precision_(precision),
        options_(options),
        functions_({options.form, options.multiplier, options.interval, options.logic_tables}) {
    if (options.fuse) fused_ = fused(plan, precision, functions_.options());
  }

  Compound propose() {
    Sketch sketch(options_.prefix + "_propose", options_.multiplier, options_.interval);
    Mapping mapping(plan_, precision_, fused_, sketch, functions_, options_.overlapped);
    const Signal first = of_the_step(sketch, "first_i", {false, 1, 0});
    const std::vector<Signal> states = state_ports(sketch, "state");
    give_draws(sketch, mapping);
    give_fields(sketch, mapping);
    mapping.compute(plan_.initial);
    std::vector<Signal> parents;
    for (std::size_t d = 0; d < states.size(); ++d)
      parents.push_back(sketch.select(first, mapping.in(plan_.initial[d], precision_.states[d]), states[d]));
    give_states(mapping, Role::kBefore, parents);
    mapping.compute(plan_.next);
    for (std::size_t d = 0; d < states.size(); ++d)
      sketch.output("state" + std::to_string(d) + "_o", mapping.in(plan_.next[d], precision_.states[d]));
    if (recorded_.log_ratio)
      for (std::size_t d = 0; d < states.size(); ++d) sketch.output("before" + std::to_string(d) + "_o", parents[d]);
    return sketch.done();
  }

  Compound weigh() {
    Sketch sketch(options_.prefix + "_weigh", options_.multiplier, options_.interval);
    Mapping mapping(plan_, precision_, fused_, sketch, functions_, options_.overlapped);
    give_states(mapping, Role::kState, state_ports(sketch, "state"));
    if (recorded_.log_ratio) give_states(mapping, Role::kBefore, state_ports(sketch, "before"));
    give_fields(sketch, mapping);
    mapping.compute({plan_.log_weight});
    sketch.output("log_o", mapping.in(plan_.log_weight, kLogWeight));
    return sketch.done();
  }

 private:
  /// A number that all particles of a step have.
  Signal of_the_step(Sketch& sketch, const std::string& name, const Format& format) const {
    return options_.overlapped ? sketch.input(name, format) : sketch.standing(name, format);
  }
  std::vector<Signal> state_ports(Sketch& sketch, const char* name) const {
    std::vector<Signal> states;
    for (std::size_t d = 0; d < precision_.states.size(); ++d)
      states.push_back(sketch.input(numbered(name, d), precision_.states[d]));
    return states;
  }
  void give_states(Mapping& mapping, Role role, const std::vector<Signal>& states) const {
    for (Id id = 0; id < plan_.graph.size(); ++id)
      if (const Vertex& v = plan_.graph[id]; v.op == Op::kInput && v.role == role) mapping.give(id, states[v.index]);
  }
  void give_fields(Sketch& sketch, Mapping& mapping) const {
    for (std::size_t k = 0; k < plan_.fields.size(); ++k)
      mapping.give(plan_.fields[k], of_the_step(sketch, numbered("obs", k), precision_.formats[plan_.fields[k]]));
  }
  /// A draw, or its product with a constant where nothing else uses it: a table gives either.
  struct ScaledDraw {
    Id id;
    double factor;
  };
  ScaledDraw scaled(Id draw) const {
    std::optional<ScaledDraw> only;
    for (const Part part : {Part::kInitial, Part::kNext}) {
      const auto outputs = plan_.outputs(part);
      if (std::find(outputs.begin(), outputs.end(), draw) != outputs.end()) return {draw, 1};
      for (const Id id : needed(plan_.graph, outputs)) {
        const Vertex& v = plan_.graph[id];
        const auto operands = v.operands();
        if (std::find(operands.begin(), operands.end(), draw) == operands.end()) continue;
        const Id other = v.args[v.args[0] == draw ? 1 : 0];
        if (only || v.op != Op::kMultiply || !plan_.graph.is_constant(other)) return {draw, 1};
        only = ScaledDraw{id, plan_.graph[other].value};
      }
    }
    return only.value_or(ScaledDraw{draw, 1});
  }
  /// Each word is cut into a draw of the move and one of the prior.
  void give_draws(Sketch& sketch, Mapping& mapping) {
    std::vector<Signal> words;
    for (std::size_t k = 0; k < draw_words(recorded_); ++k)
      words.push_back(sketch.input(numbered("word", k), kSignedBits));
    const WordDraws draws(sketch);
    for (Id id = 0; id < plan_.graph.size(); ++id) {
      const Vertex& v = plan_.graph[id];
      if (v.op != Op::kInput) continue;
      const bool prior = v.role == Role::kPriorNormal || v.role == Role::kPriorUniform;
      if (v.role == Role::kNormal || v.role == Role::kPriorNormal) {
        const ScaledDraw draw = scaled(id);
        mapping.give(draw.id, draws.normal(words[v.index], prior, draw.factor, precision_.formats[draw.id]));
      }
      if (v.role == Role::kUniform || v.role == Role::kPriorUniform)
        mapping.give(id, draws.uniform(words[v.index], prior, precision_.formats[id]));
    }
  }

  const Plan& plan_;
  const graph::Recorded& recorded_;
  const Precision& precision_;
  DatapathOptions options_;
  Functions functions_;
  std::map<Id, Fused> fused_;
};

std::vector<ObservedField> fields_of(const Plan& plan, const graph::Recorded& recorded, const Precision& precision) {
  std::vector<ObservedField> fields;
  int at = 0;
  for (const Id id : plan.fields) {
    const Vertex& v = plan.graph[id];
    const int bit = plan.seen_bit(id);
    std::string name = v.op == Op::kInput ? "" : "v" + std::to_string(id);
    if (bit >= 0) {
      for (const std::uint32_t column : plan.seen[static_cast<std::size_t>(bit)])
        name += recorded.columns[column].name + " ";
      name += "seen";
    } else if (v.op == Op::kInput) {
      name = recorded.name_of(v);
    }
    fields.push_back({name, precision.formats[id], at});
    at += precision.formats[id].width();
  }
  return fields;
}

/// Evaluates what the host computes.
std::vector<std::int64_t> computed_fields(const Plan& plan, const std::vector<Format>& formats, const Row<double>& row,
                                          const std::vector<double>& schedule) {
  std::vector<double> values;
  graph::evaluate(
      plan.graph,
      [&](const Vertex& v) {
        if (v.role == Role::kSchedule) return schedule[v.index];
        if (v.role != Role::kColumn) return 0.0;
        if (v.index < plan.columns) return row[v.index];
        const auto& needs = plan.seen[v.index - plan.columns];
        return std::all_of(needs.begin(), needs.end(), [&](std::uint32_t j) { return row.seen(j); }) ? 1.0 : 0.0;
      },
      values);
  std::vector<std::int64_t> words;
  for (std::size_t k = 0; k < plan.fields.size(); ++k) words.push_back(formats[k].nearest(values[plan.fields[k]]));
  return words;
}

/// The columns of a twin's ports, filled one after the other.
class Ports {
 public:
  explicit Ports(std::size_t rows) : rows_(rows) {}
  void standing(std::int64_t word) {
    kept_.emplace_back(rows_, word);
    columns_.emplace_back(kept_.back());
  }
  void column(std::span<const std::int64_t> column) { columns_.emplace_back(column); }
  void random(std::span<const std::uint32_t> words) {
    std::vector<Word>& signed_words = kept_.emplace_back();
    for (const std::uint32_t word : words) signed_words.push_back(signed_bits(word));
    columns_.emplace_back(signed_words);
  }
  Columns all() const { return columns_; }

 private:
  std::size_t rows_;
  std::deque<std::vector<Word>> kept_;
  std::vector<std::span<const Word>> columns_;
};

Arithmetic golden(const Compound& propose, const Compound& weigh, const Formats& formats) {
  Arithmetic all;
  all.formats = formats;
  all.propose = [propose](unsigned t, Observed observed, const Particles& parents, const WordColumns& words,
                          Particles& states) {
    Ports in(states[0].size());
    in.standing(t == 1 ? 1 : 0);
    for (const auto& parent : parents) in.column(parent);
    for (const auto& column : words) in.random(column);
    for (const std::int64_t word : observed) in.standing(word);
    const std::vector<std::span<Word>> out(states.begin(), states.end());
    propose.compute(in.all(), out);
  };
  all.weigh = [weigh](unsigned, Observed observed, const Particles& states, std::span<std::int64_t> log_weights) {
    Ports in(log_weights.size());
    for (const auto& state : states) in.column(state);
    for (const std::int64_t word : observed) in.standing(word);
    weigh.compute(in.all(), std::array{log_weights});
  };
  return all;
}

std::string slice(const std::string& bus, int at, int width) {
  return bus + "[" + std::to_string(at + width - 1) + ":" + std::to_string(at) + "]";
}

/// States one after the other on a bus, and behind them the `carried` parents.
Connections state_connections(const Datapath& datapath, const std::string& bus, const char* end, unsigned carried) {
  Connections all;
  const auto width = static_cast<int>(datapath.arithmetic.formats.value_bits);
  const auto connect = [&](const char* name, std::size_t count) {
    for (std::size_t d = 0; d < count; ++d)
      all.emplace_back(name + std::to_string(d) + end, slice(bus, static_cast<int>(all.size()) * width, width));
  };
  connect("state", datapath.states.size());
  connect("before", carried);
  return all;
}

/// The clock, and what tells of a particle where operators take turns.
Connections clock_of(const Compound& pipeline, const char* valid) {
  Connections all{{"clk_i", "clk_i"}};
  if (pipeline.circuit().interval > 1) all.emplace_back("enters_i", valid);
  return all;
}

void append_fields(Connections& all, const Datapath& datapath, const char* bus) {
  for (std::size_t k = 0; k < datapath.observed.size(); ++k)
    all.emplace_back(numbered("obs", k), slice(bus, datapath.observed[k].at, datapath.observed[k].format.width()));
}

}  // namespace

std::vector<std::int64_t> Datapath::observe(const Row<double>& row, const std::vector<double>& schedule) const {
  return host(row, schedule);
}

std::vector<double> Datapath::means(const std::vector<std::int64_t>& words) const {
  std::vector<double> all;
  for (std::size_t d = 0; d < words.size(); ++d)
    all.push_back(std::ldexp(static_cast<double>(words[d]),
                             -states[d].fraction - static_cast<int>(arithmetic.formats.extra_bits)));
  const std::size_t model = words.size() - 2 * turning.size();
  for (std::size_t k = 0; k < turning.size(); ++k)
    all[turning[k]] = std::atan2(all[model + 2 * k + 1], all[model + 2 * k]);
  all.resize(model);
  return all;
}

Connections propose_connections(const Datapath& datapath) {
  Connections all = clock_of(datapath.propose, "propose_valid");
  all.emplace_back("first_i", "t == 16'd1");
  const Connections in = state_connections(datapath, "parent", "_i", 0);
  const Connections out = state_connections(datapath, "proposed", "_o", datapath.arithmetic.formats.carried);
  all.insert(all.end(), in.begin(), in.end());
  for (unsigned w = 0; w < datapath.arithmetic.formats.draw_words; ++w)
    all.emplace_back(numbered("word", w), "words[" + std::to_string(32 * w) + "+:32]");
  append_fields(all, datapath, "obs");
  all.insert(all.end(), out.begin(), out.end());
  return all;
}

Connections weigh_connections(const Datapath& datapath) {
  Connections all = clock_of(datapath.weigh, "weigh_valid");
  const Connections in = state_connections(datapath, "to_weigh", "_i", datapath.arithmetic.formats.carried);
  all.insert(all.end(), in.begin(), in.end());
  append_fields(all, datapath, "weigh_obs");
  all.emplace_back("log_o", "log_weight");
  return all;
}

Datapath datapath(const graph::Recorded& model, const Samples& samples, const DatapathOptions& options) {
  Datapath made;
  made.turning = turning_states(model, samples);
  const graph::Recorded recorded = with_directions(model, made.turning);
  for (const Quantity& state : recorded.states) made.names.push_back(state.name);
  const Plan plan = plan_of(recorded);
  const Precision precision =
      precision_of(plan, recorded, with_directions(samples, made.turning), options.margin, options.more_bits);
  Builder builder(plan, recorded, precision, options);
  made.propose = builder.propose();
  made.weigh = builder.weigh();
  made.states = precision.states;
  made.observed = fields_of(plan, recorded, precision);
  made.observed_bits = made.observed.empty() ? 0 : made.observed.back().at + made.observed.back().format.width();
  made.constant = plan.constant;
  Formats formats;
  formats.dims = static_cast<unsigned>(precision.states.size());
  formats.value_bits = static_cast<unsigned>(precision.states[0].width());
  formats.carried = recorded.log_ratio ? formats.dims : 0;
  formats.draw_words = static_cast<unsigned>(draw_words(recorded));
  formats.propose_latency = static_cast<unsigned>(made.propose.circuit().latency);
  formats.weigh_latency = static_cast<unsigned>(made.weigh.circuit().latency);
  formats.interval = static_cast<unsigned>(options.interval);
  formats.product_latency = options.multiplier == Multiplier::kLogic ? kLogicProduct : 1;
  made.arithmetic = golden(made.propose, made.weigh, formats);
  std::vector<Format> words;
  for (const ObservedField& field : made.observed) words.push_back(field.format);
  made.host = [plan, words](const Row<double>& row, const std::vector<double>& schedule) {
    return computed_fields(plan, words, row, schedule);
  };
  return made;
}

}  // namespace mote::hardware
