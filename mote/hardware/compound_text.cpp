#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "mote/hardware/c_call.hpp"
#include "mote/hardware/compound.hpp"

namespace mote::hardware {
namespace {

std::string wire_name(const Wire& wire) { return "w" + std::to_string(wire.node) + "_" + std::to_string(wire.port); }

std::string declaration(const std::string& name, int width) {
  return "  logic [" + std::to_string(width - 1) + ":0] " + name + ";\n";
}

/// What takers of an instance choose with: the clock of their row.
std::string phase_text(int interval) {
  const std::string bits = std::to_string(ceil_log2(static_cast<std::uint64_t>(interval)));
  const std::string last = bits + "'d" + std::to_string(interval - 1);
  return "  logic [" + bits + "-1:0] phase_q;\n  always_ff @(posedge clk_i)\n    phase_q <= enters_i ? " + bits +
         "'d1 : phase_q == " + last + " ? '0 : phase_q + " + bits + "'d1;\n";
}

/// A word by phase; those of phases that nobody has are as the last.
std::string chosen_text(const std::string& name, int interval, const std::vector<std::pair<int, std::string>>& words) {
  const bool same =
      std::all_of(words.begin(), words.end(), [&](const auto& one) { return one.second == words.front().second; });
  if (same) return "  assign " + name + " = " + words.front().second + ";\n";
  const std::string bits = std::to_string(ceil_log2(static_cast<std::uint64_t>(interval)));
  std::string text = "  always_comb\n    case (phase_q)\n";
  for (std::size_t k = 0; k + 1 < words.size(); ++k)
    text += "      " + bits + "'d" + std::to_string(words[k].first) + ": " + name + " = " + words[k].second + ";\n";
  return text + "      default: " + name + " = " + words.back().second + ";\n    endcase\n";
}

/// A word in as many bits as an instance has for it.
std::string widened(const std::string& word, const Port& port, int width) {
  if (port.width == width) return word;
  return std::to_string(width) + "'(" + (port.sign ? "$signed(" + word + ")" : word) + ")";
}

/// The name of the parameter by which the file of a table comes in from outside.
std::string table_name(std::size_t node, const Memory& memory) { return "U" + std::to_string(node) + memory.parameter; }

}  // namespace

/// By node, the one that its tables are called after: the first that takes turns at its instance.
std::vector<std::size_t> Compound::owners() const {
  std::vector<std::size_t> owners(nodes_.size());
  std::iota(owners.begin(), owners.end(), std::size_t{0});
  for (const Turns::Instance& one : turns_.instances())
    for (const std::size_t node : one.taker)
      if (node != Turns::Instance::kNobody) owners[node] = *std::min_element(one.taker.begin(), one.taker.end());
  return owners;
}

/// The body of a compound's module: wires, with delays where a reader comes later than the writer is ready, operators,
/// and instances at which they take turns.
class Compound::Text {
 public:
  explicit Text(const Compound& of) : of_(of), in_turn_(of.nodes_.size()) {
    for (const Turns::Instance& one : of_.turns_.instances())
      for (const std::size_t node : one.taker)
        if (one.takers() > 1 && node != Turns::Instance::kNobody) in_turn_[node] = true;
  }

  std::string written() {
    if (of_.turns_.any()) body_ += phase_text(of_.interval());
    for (std::size_t n = 0; n < of_.nodes_.size(); ++n) {
      for (std::size_t p = 0; p < of_.nodes_[n].circuit.outputs.size(); ++p)
        body_ += declaration(wire_name({n, p}), of_.nodes_[n].circuit.outputs[p].width);
      write_node(n);
    }
    for (std::size_t k = 0; k < of_.turns_.instances().size(); ++k)
      if (of_.turns_.instances()[k].takers() > 1) write_instance(k);
    for (const Output& output : of_.outputs_)
      body_ += "  assign " + output.port.name + " = " + read(output.wire, of_.latency()) + ";\n";
    for (std::size_t n = 0; n < of_.nodes_.size(); ++n)
      for (std::size_t p = 0; p < of_.nodes_[n].circuit.outputs.size(); ++p)
        if (!used_.contains({n, p})) write_unused(wire_name({n, p}));
    return body_;
  }

 private:
  using Connections = std::vector<std::pair<std::string, std::string>>;

  void write_node(std::size_t n) {
    const Node& node = of_.nodes_[n];
    const std::vector<Port>& outputs = node.circuit.outputs;
    if (node.fixed) {
      const auto bits = static_cast<std::uint64_t>(node.word) & (~std::uint64_t{0} >> (64 - outputs[0].width));
      body_ += "  assign " + wire_name({n, 0}) + " = " + std::to_string(outputs[0].width) + "'d" +
               std::to_string(bits) + ";\n";
    } else if (node.twin == nullptr) {
      body_ += "  assign " + wire_name({n, 0}) + " = " + outputs[0].name + ";\n";
    } else if (node.circuit.module.empty()) {
      for (std::size_t p = 0; p < outputs.size(); ++p)
        body_ += "  assign " + wire_name({n, p}) + " = " + read(node.operands[p], node.ready) + ";\n";
    } else if (!in_turn_[n]) {
      Connections connections{{"clk_i", "clk_i"}};
      for (std::size_t p = 0; p < node.circuit.inputs.size(); ++p)
        connections.emplace_back(node.circuit.inputs[p].name, operand(n, p));
      for (std::size_t p = 0; p < outputs.size(); ++p) connections.emplace_back(outputs[p].name, wire_name({n, p}));
      instantiate(n, node.circuit, connections);
    }
  }

  void write_instance(std::size_t k) {
    const Turns::Instance& one = of_.turns_.instances()[k];
    const auto own = [&](const char* kind, std::size_t p) {
      return kind + std::to_string(k) + "_" + std::to_string(p);
    };
    Connections connections{{"clk_i", "clk_i"}};
    for (std::size_t p = 0; p < one.circuit.inputs.size(); ++p) {
      const Port& port = one.circuit.inputs[p];
      std::vector<std::pair<int, std::string>> words;
      for (int phase = 0; phase < of_.interval(); ++phase)
        if (const std::size_t n = one.taker[static_cast<std::size_t>(phase)]; n != Turns::Instance::kNobody)
          words.emplace_back(phase, widened(operand(n, p), of_.nodes_[n].circuit.inputs[p], port.width));
      body_ += declaration(own("a", p), port.width) + chosen_text(own("a", p), of_.interval(), words);
      connections.emplace_back(port.name, own("a", p));
    }
    for (std::size_t p = 0; p < one.circuit.outputs.size(); ++p) {
      body_ += declaration(own("y", p), one.circuit.outputs[p].width);
      write_unused(own("y", p));
      for (const std::size_t n : one.taker)
        if (n != Turns::Instance::kNobody)
          body_ += "  assign " + wire_name({n, p}) + " = " + own("y", p) + "[" +
                   std::to_string(of_.nodes_[n].circuit.outputs[p].width - 1) + ":0];\n";
      connections.emplace_back(one.circuit.outputs[p].name, own("y", p));
    }
    instantiate(*std::min_element(one.taker.begin(), one.taker.end()), one.circuit, connections);
  }

  void write_unused(const std::string& name) {
    body_ += "  logic unused_" + name + ";\n  assign unused_" + name + " = ^" + name + ";\n";
  }

  /// Tables come in by parameters that are called after a node.
  void instantiate(std::size_t owner, const Circuit& circuit, const Connections& connections) {
    Circuit inner = circuit;
    for (const Memory& memory : circuit.memories)
      inner.parameters.push_back({memory.parameter, table_name(owner, memory)});
    inner.memories.clear();
    body_ += instantiation(inner, "u" + std::to_string(owner), "", connections);
  }

  std::string operand(std::size_t node, std::size_t p) {
    const Node& of = of_.nodes_[node];
    return read(of.operands[p], of.ready - of.circuit.latency);
  }

  /// The name of a wire as it is in a clock.
  std::string read(const Wire& wire, int clock) {
    const Node& from = of_.nodes_[wire.node];
    used_.insert({wire.node, wire.port});
    const int clocks = from.stands ? 0 : clock - from.ready;
    if (clocks == 0) return wire_name(wire);
    std::string name = wire_name(wire) + "_d" + std::to_string(clocks);
    const int width = from.circuit.outputs[wire.port].width;
    if (delays_.insert(name).second)
      body_ += declaration(name, width) + "  mote_delay #(.Width(" + std::to_string(width) + "), .Depth(" +
               std::to_string(clocks) + ")) " + name + "_u (.clk_i(clk_i), .d_i(" + wire_name(wire) + "), .d_o(" +
               name + "));\n";
    return name;
  }

  const Compound& of_;
  std::vector<bool> in_turn_;  ///< by node
  std::set<std::pair<std::size_t, std::size_t>> used_;
  std::set<std::string> delays_;
  std::string body_;
};

/// The twin in C:  void NAME(tables, inputs, outputs), where each operator is called in turn (c_call.hpp).
std::string Compound::c_function() const {
  std::string head = "static void " + name_ + "(const mote_entry *const *tables";
  std::string body = "  (void)tables;\n";
  const std::vector<std::size_t> owner = owners();
  std::vector<std::size_t> table(nodes_.size());  // the place of a node's first
  std::size_t tables = 0;
  for (const std::size_t n : inputs_) head += ", int64_t " + wire_name({n, 0});
  for (const Output& output : outputs_) head += ", int64_t *" + output.port.name;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    if (node.fixed) {
      body += "  const int64_t " + wire_name({n, 0}) + " = INT64_C(" + std::to_string(node.word) + ");\n";
    } else if (node.twin != nullptr) {
      std::vector<std::string> in, out;
      for (const Wire& wire : node.operands) in.push_back(wire_name(wire));
      for (std::size_t p = 0; p < node.circuit.outputs.size(); ++p) out.push_back(wire_name({n, p}));
      if (owner[n] == n) table[n] = std::exchange(tables, tables + node.circuit.memories.size());
      if (node.circuit.module.empty())
        for (std::size_t p = 0; p < out.size(); ++p) body += "  const int64_t " + out[p] + " = " + in[p] + ";\n";
      else
        body += c_call(node.circuit, table[owner[n]], in, out);
    }
    if (node.twin == nullptr) body += "  (void)" + wire_name({n, 0}) + ";\n";
  }
  for (const Output& output : outputs_) body += "  *" + output.port.name + " = " + wire_name(output.wire) + ";\n";
  return head + ") {\n" + body + "}\n";
}

Circuit Compound::circuit() const {
  Circuit whole{name_, {}, {}, {}, latency()};
  std::string ports = "    input logic clk_i";
  const auto declare = [&](const char* direction, const Port& port) {
    ports += ",\n    " + std::string(direction) + " logic [" + std::to_string(port.width - 1) + ":0] " + port.name;
  };
  for (const std::size_t n : inputs_) {
    whole.inputs.push_back(nodes_[n].circuit.outputs[0]);
    declare("input", whole.inputs.back());
  }
  for (const Output& output : outputs_) {
    whole.outputs.push_back(output.port);
    declare("output", output.port);
  }
  if (turns_.any()) {
    whole.interval = interval();
    ports += ",\n    input logic enters_i";
  }
  std::string tables;
  const std::vector<std::size_t> owner = owners();
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (owner[n] != n) continue;
    for (const Memory& memory : nodes_[n].circuit.memories) {
      tables += (tables.empty() ? "" : ",\n") + ("    parameter " + table_name(n, memory)) + " = \"table.hex\"";
      whole.memories.push_back({table_name(n, memory), memory.width, memory.words});
    }
    const auto& inner = nodes_[n].circuit.sources;
    whole.sources.insert(whole.sources.end(), inner.begin(), inner.end());
  }
  const std::string parameters = tables.empty() ? "" : " #(\n" + tables + "\n)";
  const std::string sheet = "// " + name_ + ": latency " + std::to_string(whole.latency) + ", one row " +
                            (whole.interval == 1 ? "a clock" : "in " + std::to_string(whole.interval) + " clocks") +
                            ".\n";
  whole.sources.push_back(
      {name_,
       sheet + "module " + name_ + parameters + " (\n" + ports + "\n);\n" + Text(*this).written() + "endmodule\n",
       c_function()});
  return whole;
}

}  // namespace mote::hardware
