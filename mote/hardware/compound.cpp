#include "mote/hardware/compound.hpp"

#include <algorithm>

namespace mote::hardware {

Wire Compound::append(const Circuit& circuit, Twin twin, const std::vector<Wire>& operands) {
  int start = 0;
  for (const Wire& wire : operands) start = std::max(start, nodes_[wire.node].ready);
  start = turns_.take(nodes_.size(), circuit, start);
  nodes_.push_back({circuit, std::move(twin), operands, start + circuit.latency});
  return {nodes_.size() - 1, 0};
}

/// The operators of a compound among this one's, so that they take turns with them.
Wire Compound::inlined(const Compound& inner, const std::vector<Wire>& operands) {
  std::vector<Wire> here(inner.nodes_.size());
  const auto wire_here = [&](const Wire& wire) { return Wire{here[wire.node].node, here[wire.node].port + wire.port}; };
  std::size_t next = 0;
  for (std::size_t n = 0; n < inner.nodes_.size(); ++n) {
    const Node& node = inner.nodes_[n];
    std::vector<Wire> from;
    for (const Wire& wire : node.operands) from.push_back(wire_here(wire));
    if (node.fixed) {
      nodes_.push_back(node);
      here[n] = {nodes_.size() - 1, 0};
    } else {
      here[n] = node.twin == nullptr ? operands[next++] : append(node.circuit, node.twin, from);
    }
  }
  std::vector<Port> ports;
  std::vector<Wire> results;
  for (const Output& output : inner.outputs_) {
    ports.push_back(output.port);
    results.push_back(wire_here(output.wire));
  }
  return results.size() == 1 ? results.front() : gathered(ports, results);
}

/// Wires as the outputs of one node.
Wire Compound::gathered(const std::vector<Port>& ports, const std::vector<Wire>& wires) {
  const Circuit together{"", {}, {}, ports};
  const Twin twin = [](Columns in, Results out) {
    for (std::size_t p = 0; p < out.size(); ++p) std::copy(in[p].begin(), in[p].end(), out[p].begin());
  };
  return append(together, twin, wires);
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

}  // namespace mote::hardware
