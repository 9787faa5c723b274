#include "mote/hardware/compound.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mote/hardware/c_call.hpp"

namespace mote::hardware {
namespace {

std::string wire_name(const Wire& wire) { return "w" + std::to_string(wire.node) + "_" + std::to_string(wire.port); }

std::string declaration(const std::string& name, int width) {
  return "  logic [" + std::to_string(width - 1) + ":0] " + name + ";\n";
}

std::string instance_name(std::size_t node) { return "u" + std::to_string(node); }

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

Wire Compound::append(const Circuit& circuit, Twin twin, const std::vector<Wire>& operands) {
  int start = 0;
  for (const Wire& wire : operands) start = std::max(start, nodes_[wire.node].ready);
  nodes_.push_back({circuit, std::move(twin), operands, start + circuit.latency});
  return {nodes_.size() - 1, 0};
}

Wire Compound::input(const std::string& name, const Format& format) {
  nodes_.push_back({{"", {}, {}, {port(name, format)}}, nullptr, {}});
  inputs_.push_back(nodes_.size() - 1);
  return {nodes_.size() - 1, 0};
}

Wire Compound::standing(const std::string& name, const Format& format) {
  const Wire wire = input(name, format);
  nodes_[wire.node].stands = true;
  return wire;
}

Wire Compound::constant(const Format& format, Word word) {
  nodes_.push_back({{"", {}, {}, {port("", format)}}, nullptr, {}, 0, true, true, word});
  return {nodes_.size() - 1, 0};
}

void Compound::output(const std::string& name, const Format& format, Wire wire) {
  outputs_.push_back({port(name, format), wire});
}

int Compound::latency() const {
  int latest = 0;
  for (const Output& output : outputs_) latest = std::max(latest, nodes_[output.wire.node].ready);
  return latest;
}

void Compound::compute(Columns in, Results out) const {
  const std::size_t rows = out[0].size();
  std::vector<std::vector<std::vector<Word>>> made(nodes_.size());
  std::vector<std::vector<std::span<const Word>>> columns(nodes_.size());
  std::size_t next = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    if (node.twin == nullptr && !node.fixed) {
      columns[n] = {in[next++]};
      continue;
    }
    made[n].assign(node.circuit.outputs.size(), std::vector<Word>(rows, node.word));
    if (!node.fixed) {
      std::vector<std::span<const Word>> operands;
      for (const Wire& wire : node.operands) operands.push_back(columns[wire.node][wire.port]);
      const std::vector<std::span<Word>> results(made[n].begin(), made[n].end());
      node.twin(operands, results);
    }
    columns[n].assign(made[n].begin(), made[n].end());
  }
  for (std::size_t o = 0; o < outputs_.size(); ++o)
    std::copy_n(columns[outputs_[o].wire.node][outputs_[o].wire.port].begin(), rows, out[o].begin());
}

std::string Compound::text() const {
  Writer writer;
  std::map<std::pair<std::size_t, std::size_t>, bool> used;
  const auto read = [&](const Wire& wire, int clock) {
    const Node& from = nodes_[wire.node];
    used[{wire.node, wire.port}] = true;
    return writer.delayed(wire, from.circuit.outputs[wire.port].width, from.stands ? 0 : clock - from.ready);
  };
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
    } else {
      std::vector<std::pair<std::string, std::string>> connections{{"clk_i", "clk_i"}};
      for (std::size_t p = 0; p < circuit.inputs.size(); ++p)
        connections.emplace_back(circuit.inputs[p].name, read(node.operands[p], node.ready - circuit.latency));
      for (std::size_t p = 0; p < circuit.outputs.size(); ++p)
        connections.emplace_back(circuit.outputs[p].name, wire_name({n, p}));
      Circuit inner = circuit;
      for (const Memory& memory : circuit.memories)
        inner.parameters.push_back({memory.parameter, table_name(n, memory)});
      inner.memories.clear();
      writer.body += instantiation(inner, instance_name(n), "", connections);
    }
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
  std::size_t table = 0;
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
      body += c_call(node.circuit, table, in, out);
      table += node.circuit.memories.size();
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
  std::string tables;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    for (const Memory& memory : nodes_[n].circuit.memories) {
      tables += (tables.empty() ? "" : ",\n") + ("    parameter " + table_name(n, memory)) + " = \"table.hex\"";
      whole.memories.push_back({table_name(n, memory), memory.width, memory.words});
    }
    const auto& inner = nodes_[n].circuit.sources;
    whole.sources.insert(whole.sources.end(), inner.begin(), inner.end());
  }
  const std::string parameters = tables.empty() ? "" : " #(\n" + tables + "\n)";
  const std::string sheet = "// " + name_ + ": latency " + std::to_string(whole.latency) + ", one row a clock.\n";
  whole.sources.push_back({name_,
                           sheet + "module " + name_ + parameters + " (\n" + ports + "\n);\n" + text() + "endmodule\n",
                           c_function()});
  return whole;
}

}  // namespace mote::hardware
