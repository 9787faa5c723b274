#include "mote/graph/record.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <stdexcept>

namespace mote::graph {
namespace {

/// Steps at which a model has to do the same operations.
constexpr std::array<Step, 4> kProbes{1, 2, 3, 7};

/// Steps at which constants without a mark are looked at, from 1 on: what follows t only later on is found by those far
/// away.
constexpr Step kLastLook = 65535, kEveryStepTo = 256;
constexpr Step look_after(Step t) { return t < kEveryStepTo ? t + 1 : t + t / 16; }

/// The constants of a trace, by vertex; where traces differ in more, they are not of one model.
bool same_operations(const Graph& a, const Graph& b) {
  return std::equal(a.vertices().begin(), a.vertices().end(), b.vertices().begin(), b.vertices().end(),
                    [](const Vertex& u, const Vertex& v) {
                      return u.op == v.op && u.args == v.args && u.role == v.role && u.index == v.index;
                    });
}

bool same_number(double a, double b) { return a == b || (a != a && b != b); }

[[noreturn]] void refuse_change(Step t) {
  throw std::logic_error("record: the model does other operations at t = " + std::to_string(t) + " than at t = 1");
}

/// The constants of a model's traces: (looks,) of (vertices,), up to where it does other operations.
std::vector<std::vector<double>> constants_of(const std::function<Trace(Step)>& trace, const Trace& first) {
  std::vector<std::vector<double>> looks;
  for (Step t = 1; t <= kLastLook; t = look_after(t)) {
    const Trace now = trace(t);
    if (!same_operations(now.graph, first.graph)) break;
    std::vector<double>& values = looks.emplace_back();
    for (const Vertex& v : now.graph.vertices()) values.push_back(v.value);
  }
  return looks;
}

/// Which constants follow t, and the places of each number of the schedule in the trace. One with a mark does, whatever
/// it is at the looks; one that the model computes in double does where it differs between them. Those are one number
/// that have one mark and are equal at all looks.
struct Schedule {
  std::map<Id, std::uint32_t> number;  ///< by vertex of the trace
  std::vector<Id> places;              ///< by number, one of its vertices

  Schedule(const Graph& trace, const std::vector<std::vector<double>>& looks) {
    std::map<std::vector<std::uint64_t>, std::uint32_t> known;  // by the mark and the bits of all values
    for (Id id = 0; id < trace.size(); ++id) {
      const Vertex& v = trace[id];
      if (!follows_t(v) && std::all_of(looks.begin(), looks.end(),
                                       [&](const auto& look) { return same_number(look[id], looks[0][id]); }))
        continue;
      std::vector<std::uint64_t> name{v.args[0], v.args[1]};
      for (const auto& look : looks) name.push_back(std::bit_cast<std::uint64_t>(look[id]));
      const auto [place, fresh] = known.try_emplace(name, static_cast<std::uint32_t>(places.size()));
      if (fresh) places.push_back(id);
      number.emplace(id, place->second);
    }
  }
};

/// The trace with the numbers of the schedule as inputs.
Graph with_schedule(const Graph& trace, const Schedule& schedule, std::vector<Id>& now) {
  Graph graph;
  now.resize(trace.size());
  for (Id id = 0; id < trace.size(); ++id) {
    const Vertex& v = trace[id];
    if (const auto found = schedule.number.find(id); found != schedule.number.end()) {
      now[id] = graph.input(Role::kSchedule, found->second);
    } else if (v.op == Op::kConstant) {
      now[id] = graph.constant(v.value);
    } else if (v.op == Op::kInput) {
      now[id] = graph.input(v.role, v.index);
    } else {
      std::array<Id, 4> args{};
      for (std::size_t k = 0; k < arity(v.op); ++k) args[k] = now[v.args[k]];
      now[id] = graph.operation(v.op, args);
    }
  }
  return graph;
}

/// The schedule at t, read off a new trace that otherwise must be the first one's.
std::vector<double> schedule_at(Step t, const Trace& now, const Trace& first, const Schedule& schedule) {
  if (!same_operations(now.graph, first.graph)) refuse_change(t);
  std::vector<double> values;
  for (const Id place : schedule.places) values.push_back(now.graph[place].value);
  for (Id id = 0; id < first.graph.size(); ++id) {
    const auto found = schedule.number.find(id);
    const double expected = found == schedule.number.end() ? first.graph[id].value : values[found->second];
    if (!same_number(now.graph[id].value, expected)) refuse_change(t);
  }
  return values;
}

}  // namespace

std::vector<Id> Recorded::filter_outputs() const {
  std::vector<Id> all = initial;
  all.insert(all.end(), next.begin(), next.end());
  all.push_back(log_likelihood);
  return all;
}

std::vector<Id> Recorded::outputs() const {
  std::vector<Id> all = filter_outputs();
  if (log_transition) all.push_back(*log_transition);
  return all;
}

std::string Recorded::name_of(const Vertex& input) const {
  const std::string number = std::to_string(input.index);
  switch (input.role) {
    case Role::kState:
      return states[input.index].name;
    case Role::kBefore:
      return states[input.index].name + " before";
    case Role::kColumn:
      return columns[input.index].name;
    case Role::kTime:
      return "t";
    case Role::kSchedule:
      return "schedule " + number;
    case Role::kNormal:
      return "normal " + number;
    case Role::kUniform:
      return "uniform " + number;
    case Role::kPriorNormal:
      return "prior normal " + number;
    case Role::kPriorUniform:
      return "prior uniform " + number;
  }
  return "";
}

Recorded recorded(const std::function<Trace(Step)>& trace, std::vector<Quantity> states, std::vector<Column> columns,
                  Identities identities) {
  const Trace first = trace(kProbes[0]);
  for (const Step t : kProbes)
    if (!same_operations(trace(t).graph, first.graph)) refuse_change(t);
  const Schedule schedule(first.graph, constants_of(trace, first));
  std::vector<Id> now;
  const Graph graph = with_schedule(first.graph, schedule, now);
  std::vector<Id> outputs;
  for (const Id id : first.outputs) outputs.push_back(now[id]);
  Outputs simple = simplified(graph, outputs, identities);

  Recorded made;
  const auto d = static_cast<std::ptrdiff_t>(states.size());
  made.graph = std::move(simple.graph);
  made.initial.assign(simple.ids.begin(), simple.ids.begin() + d);
  made.next.assign(simple.ids.begin() + d, simple.ids.begin() + 2 * d);
  made.log_likelihood = simple.ids[2 * states.size()];
  auto more = simple.ids.begin() + 2 * d + 1;
  if (first.has_transition) made.log_transition = *more++;
  if (more != simple.ids.end()) {
    made.proposed.assign(more, more + d);
    made.log_ratio = more[d];
  }
  made.states = std::move(states);
  made.columns = std::move(columns);
  made.prior_draws = first.prior_draws;
  made.draws = first.draws;
  made.proposal_draws = first.proposal_draws;
  made.schedule = [trace, schedule, first](Step t) { return schedule_at(t, trace(t), first, schedule); };
  return made;
}

}  // namespace mote::graph
