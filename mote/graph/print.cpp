#include "mote/graph/print.hpp"

#include <cstdio>

namespace mote::graph {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// What a vertex is, without its operands.
std::string label(const Recorded& recorded, const Vertex& v) {
  if (v.op == Op::kConstant) return number(v.value);
  if (v.op == Op::kInput) return recorded.name_of(v);
  return std::string(name_of(v.op));
}

struct NamedOutput {
  std::string name;
  Id id;
};

std::vector<NamedOutput> named_outputs(const Recorded& recorded) {
  std::vector<NamedOutput> all;
  for (std::size_t d = 0; d < recorded.states.size(); ++d)
    all.push_back({"initial " + recorded.states[d].name, recorded.initial[d]});
  for (std::size_t d = 0; d < recorded.states.size(); ++d)
    all.push_back({"next " + recorded.states[d].name, recorded.next[d]});
  all.push_back({"log_likelihood", recorded.log_likelihood});
  if (recorded.log_transition) all.push_back({"log_transition", *recorded.log_transition});
  return all;
}

std::string vertex_name(Id id) { return "v" + std::to_string(id); }

}  // namespace

std::string as_text(const Recorded& recorded) {
  std::string text;
  for (Id id = 0; id < recorded.graph.size(); ++id) {
    const Vertex& v = recorded.graph[id];
    text += vertex_name(id) + " = " + label(recorded, v);
    for (const Id arg : v.operands()) text += " " + vertex_name(arg);
    text += "\n";
  }
  for (const NamedOutput& output : named_outputs(recorded)) text += output.name + " = " + vertex_name(output.id) + "\n";
  return text;
}

std::string as_dot(const Recorded& recorded) {
  std::string text = "digraph model {\n  rankdir=LR;\n";
  for (Id id = 0; id < recorded.graph.size(); ++id) {
    const Vertex& v = recorded.graph[id];
    const std::string shape = arity(v.op) == 0 ? "box" : "ellipse";
    text += "  " + vertex_name(id) + " [shape=" + shape + ",label=\"" + label(recorded, v) + "\"];\n";
    for (std::size_t k = 0; k < arity(v.op); ++k)
      text += "  " + vertex_name(v.args[k]) + " -> " + vertex_name(id) + " [label=\"" + std::to_string(k) + "\"];\n";
  }
  std::size_t number = 0;
  for (const NamedOutput& output : named_outputs(recorded)) {
    const std::string name = "out" + std::to_string(number++);
    text += "  " + name + " [shape=doublecircle,label=\"" + output.name + "\"];\n";
    text += "  " + vertex_name(output.id) + " -> " + name + ";\n";
  }
  return text + "}\n";
}

}  // namespace mote::graph
