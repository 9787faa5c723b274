#include "mote/graph/graph.hpp"

#include <algorithm>
#include <bit>

namespace mote::graph {
namespace {

struct Fact {
  std::string_view name;
  std::size_t arity;
};

/// By the number of an Op.
constexpr std::array<Fact, 18> kFacts{{{"constant", 0},
                                       {"input", 0},
                                       {"add", 2},
                                       {"subtract", 2},
                                       {"multiply", 2},
                                       {"divide", 2},
                                       {"negate", 1},
                                       {"abs", 1},
                                       {"floor", 1},
                                       {"sqrt", 1},
                                       {"exp", 1},
                                       {"log", 1},
                                       {"sin", 1},
                                       {"cos", 1},
                                       {"tan", 1},
                                       {"atan", 1},
                                       {"atan2", 2},
                                       {"select", 4}}};

}  // namespace

std::size_t arity(Op op) { return kFacts[static_cast<std::size_t>(op)].arity; }
std::string_view name_of(Op op) { return kFacts[static_cast<std::size_t>(op)].name; }

std::uint64_t mark_of(Op op, const std::array<double, 4>& values, const std::array<std::uint64_t, 4>& marks) {
  if (std::all_of(marks.begin(), marks.end(), [](std::uint64_t mark) { return mark == 0; })) return 0;
  std::uint64_t mark = static_cast<std::uint64_t>(op) + kMarkOfTime;
  for (std::size_t k = 0; k < arity(op); ++k)
    mark = (std::rotl(mark, 23) ^ (marks[k] == 0 ? std::bit_cast<std::uint64_t>(values[k]) : marks[k])) *
           0x9E3779B97F4A7C15U;
  return mark | kMarkOfOperation;
}

Id Graph::constant(double value) {
  Vertex vertex;
  vertex.value = value;
  if (constants_ == Constants::kApart) vertex.index = apart_++;
  return interned(vertex);
}

Id Graph::constant_of_step(double value, std::uint64_t mark) {
  Vertex vertex;
  vertex.value = value;
  vertex.role = Role::kSchedule;
  vertex.args = {static_cast<Id>(mark), static_cast<Id>(mark >> 32U)};
  if (constants_ == Constants::kApart) vertex.index = apart_++;
  return interned(vertex);
}

Id Graph::input(Role role, std::uint32_t index) {
  Vertex vertex;
  vertex.op = Op::kInput;
  vertex.role = role;
  vertex.index = index;
  return interned(vertex);
}

Id Graph::operation(Op op, const std::array<Id, 4>& args) {
  Vertex vertex;
  vertex.op = op;
  vertex.args = args;
  return interned(vertex);
}

std::size_t Graph::Hash::operator()(const Key& key) const {
  std::uint64_t sum = 0;
  for (const std::uint64_t word : key) sum = (std::rotl(sum, 23) ^ word) * 0x9E3779B97F4A7C15U;
  return static_cast<std::size_t>(sum ^ (sum >> 32U));
}

Id Graph::interned(const Vertex& v) {
  const Key key{static_cast<std::uint64_t>(v.op) | static_cast<std::uint64_t>(v.role) << 8U |
                    static_cast<std::uint64_t>(v.index) << 32U,
                v.args[0] | static_cast<std::uint64_t>(v.args[1]) << 32U,
                v.args[2] | static_cast<std::uint64_t>(v.args[3]) << 32U, std::bit_cast<std::uint64_t>(v.value)};
  const auto [place, fresh] = known_.try_emplace(key, static_cast<Id>(vertices_.size()));
  if (fresh) vertices_.push_back(v);
  return place->second;
}

std::vector<bool> reached(const Graph& graph, std::span<const Id> outputs) {
  std::vector<bool> reached(graph.size());
  for (const Id id : outputs) reached[id] = true;
  for (std::size_t id = graph.size(); id-- > 0;)
    if (reached[id])
      for (const Id arg : graph[static_cast<Id>(id)].operands()) reached[arg] = true;
  return reached;
}

std::map<std::string, std::size_t> operations(const Graph& graph, std::span<const Id> outputs) {
  std::map<std::string, std::size_t> count;
  const std::vector<bool> used = reached(graph, outputs);
  for (Id id = 0; id < graph.size(); ++id) {
    const Vertex& v = graph[id];
    if (!used[id] || arity(v.op) == 0) continue;
    const bool by_constant = v.op == Op::kMultiply && (graph.is_constant(v.args[0]) || graph.is_constant(v.args[1]));
    ++count[by_constant ? "multiply by constant" : std::string(name_of(v.op))];
  }
  return count;
}

}  // namespace mote::graph
