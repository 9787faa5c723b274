#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "mote/hardware/c_call.hpp"
#include "mote/hardware/compound.hpp"

namespace mote::hardware {
namespace {

std::string wire_name(const Wire& wire) { return "w" + std::to_string(wire.node) + "_" + std::to_string(wire.port); }

std::string declaration(const std::string& name, int width) {
  return "  logic [" + std::to_string(width - 1) + ":0] " + name + ";\n";
}

std::string instance_name(std::size_t node) { return "u" + std::to_string(node); }

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

/// The wires of a compound as text, with delays where a reader comes later than the writer is ready.
class Writer {
 public:
  /// The name of the wire `clocks` later.
  std::string delayed(const Wire& wire, int width, int clocks) {
    if (clocks == 0) return wire_name(wire);
    const std::string name = wire_name(wire) + "_d" + std::to_string(clocks);
    if (!std::exchange(delays_[name], true))
      body += declaration(name, width) + "  mote_delay #(.Width(" + std::to_string(width) + "), .Depth(" +
              std::to_string(clocks) + ")) " + name + "_u (.clk_i(clk_i), .d_i(" + wire_name(wire) + "), .d_o(" + name +
              "));\n";
    return name;
  }

  std::string body;

 private:
  std::map<std::string, bool> delays_;
};

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

std::string Compound::text() const {
  Writer writer;
  std::map<std::pair<std::size_t, std::size_t>, bool> used;
  const auto read = [&](const Wire& wire, int clock) {
    const Node& from = nodes_[wire.node];
    used[{wire.node, wire.port}] = true;
    return writer.delayed(wire, from.circuit.outputs[wire.port].width, from.stands ? 0 : clock - from.ready);
  };
  std::vector<bool> in_turn(nodes_.size());
  for (const Turns::Instance& one : turns_.instances())
    for (const std::size_t node : one.taker)
      if (one.takers() > 1 && node != Turns::Instance::kNobody) in_turn[node] = true;
  const auto instance = [&](std::size_t owner, const Circuit& circuit, const auto& connections) {
    Circuit inner = circuit;
    for (const Memory& memory : circuit.memories)
      inner.parameters.push_back({memory.parameter, table_name(owner, memory)});
    inner.memories.clear();
    writer.body += instantiation(inner, instance_name(owner), "", connections);
  };
  if (turns_.any()) writer.body += phase_text(interval());
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    const Circuit& circuit = node.circuit;
    for (std::size_t p = 0; p < circuit.outputs.size(); ++p)
      writer.body += declaration(wire_name({n, p}), circuit.outputs[p].width);
    const std::string width = std::to_string(circuit.outputs[0].width);
    if (node.fixed) {
      const auto bits = static_cast<std::uint64_t>(node.word) & (~std::uint64_t{0} >> (64 - circuit.outputs[0].width));
      writer.body += "  assign " + wire_name({n, 0}) + " = " + width + "'d" + std::to_string(bits) + ";\n";
    } else if (node.twin == nullptr) {
      writer.body += "  assign " + wire_name({n, 0}) + " = " + circuit.outputs[0].name + ";\n";
    } else if (circuit.module.empty()) {
      for (std::size_t p = 0; p < circuit.outputs.size(); ++p)
        writer.body += "  assign " + wire_name({n, p}) + " = " + read(node.operands[p], node.ready) + ";\n";
    } else if (!in_turn[n]) {
      std::vector<std::pair<std::string, std::string>> connections{{"clk_i", "clk_i"}};
      for (std::size_t p = 0; p < circuit.inputs.size(); ++p)
        connections.emplace_back(circuit.inputs[p].name, read(node.operands[p], node.ready - circuit.latency));
      for (std::size_t p = 0; p < circuit.outputs.size(); ++p)
        connections.emplace_back(circuit.outputs[p].name, wire_name({n, p}));
      instance(n, circuit, connections);
    }
  }
  for (std::size_t k = 0; k < turns_.instances().size(); ++k) {
    const Turns::Instance& one = turns_.instances()[k];
    if (one.takers() < 2) continue;
    const auto own = [&](const char* kind, std::size_t p) {
      return std::string(kind) + std::to_string(k) + "_" + std::to_string(p);
    };
    const auto takers = [&](const auto& visit) {
      for (int phase = 0; phase < interval(); ++phase)
        if (const std::size_t n = one.taker[static_cast<std::size_t>(phase)]; n != Turns::Instance::kNobody)
          visit(phase, n);
    };
    std::vector<std::pair<std::string, std::string>> connections{{"clk_i", "clk_i"}};
    for (std::size_t p = 0; p < one.circuit.inputs.size(); ++p) {
      const Port& port = one.circuit.inputs[p];
      std::vector<std::pair<int, std::string>> words;
      takers([&](int phase, std::size_t n) {
        const std::string word = read(nodes_[n].operands[p], nodes_[n].ready - one.circuit.latency);
        words.emplace_back(phase, widened(word, nodes_[n].circuit.inputs[p], port.width));
      });
      writer.body += declaration(own("a", p), port.width) + chosen_text(own("a", p), interval(), words);
      connections.emplace_back(port.name, own("a", p));
    }
    for (std::size_t p = 0; p < one.circuit.outputs.size(); ++p) {
      const Port& port = one.circuit.outputs[p];
      writer.body += declaration(own("y", p), port.width) + "  logic unused_" + own("y", p) + ";\n  assign unused_" +
                     own("y", p) + " = ^" + own("y", p) + ";\n";
      takers([&](int, std::size_t n) {
        writer.body += "  assign " + wire_name({n, p}) + " = " + own("y", p) + "[" +
                       std::to_string(nodes_[n].circuit.outputs[p].width - 1) + ":0];\n";
      });
      connections.emplace_back(port.name, own("y", p));
    }
    instance(*std::min_element(one.taker.begin(), one.taker.end()), one.circuit, connections);
  }
  for (const Output& output : outputs_)
    writer.body += "  assign " + output.port.name + " = " + read(output.wire, latency()) + ";\n";
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    for (std::size_t p = 0; p < nodes_[n].circuit.outputs.size(); ++p)
      if (!used[{n, p}])
        writer.body += "  logic unused_" + wire_name({n, p}) + ";\n  assign unused_" + wire_name({n, p}) + " = ^" +
                       wire_name({n, p}) + ";\n";
  return writer.body;
}

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
  whole.sources.push_back({name_,
                           sheet + "module " + name_ + parameters + " (\n" + ports + "\n);\n" + text() + "endmodule\n",
                           c_function()});
  return whole;
}

}  // namespace mote::hardware
