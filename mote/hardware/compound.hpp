#pragma once
/// Operators made of operators: a pipeline whose paths are balanced by delays, as SystemVerilog and as a golden twin.

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "mote/hardware/circuit.hpp"
#include "mote/hardware/turns.hpp"

namespace mote::hardware {

/// A wire of a compound: the output `port` of one of its operators.
struct Wire {
  std::size_t node = 0;
  std::size_t port = 0;
};

/// A pipeline under construction, and an operator once its outputs are named.
///
/// Every operator starts as soon as its last operand is there; earlier operands wait in delays, which wires share. So
/// is the latency from inputs to outputs the same on all paths, and one row a clock goes through. With an interval of k
/// clocks from row to row, costly operators take turns (turns.hpp), also those of compounds within; enters_i tells when
/// a row goes in, and rows that are under way together have gone in a multiple of k clocks apart. The twin is the same.
///
/// cost    the twin: one pass over the columns for each operator
class Compound {
 public:
  /// shape   name: of the SystemVerilog module, so unique in a design
  explicit Compound(std::string name, int interval = 1) : name_(std::move(name)), turns_(interval) {}

  int interval() const { return turns_.interval(); }

  Wire input(const std::string& name, const Format& format);
  /// An input that stands still while rows go through, so that it waits in no delay; a twin has a column for it, too.
  Wire standing(const std::string& name, const Format& format);
  /// A number that never changes, as a word of a format.
  Wire constant(const Format& format, Word word);
  /// An operator's output wires are those of its circuit, in order; the first is returned.
  template <Operator O>
  Wire add(const O& op, const std::vector<Wire>& operands) {
    if constexpr (std::is_same_v<O, Compound>)
      if (interval() > 1) return inlined(op, operands);
    return append(
        op.circuit(), [op](Columns in, Results out) { op.compute(in, out); }, operands);
  }
  void output(const std::string& name, const Format& format, Wire wire);
  /// The clock after which a wire is there.
  int ready(const Wire& wire) const { return nodes_[wire.node].ready; }

  void compute(Columns in, Results out) const;
  Circuit circuit() const;

 private:
  using Twin = std::function<void(Columns, Results)>;
  class Text;
  struct Node {
    Circuit circuit;  ///< an input and a constant have no module, one output and no twin; wires gathered have a twin
    Twin twin;
    std::vector<Wire> operands;
    int ready = 0;        ///< the clock after which its outputs are there
    bool stands = false;  ///< never changes, or not while rows go through
    bool fixed = false;   ///< a constant
    Word word = 0;
  };
  struct Output {
    Port port;
    Wire wire;
  };

  Wire append(const Circuit& circuit, Twin twin, const std::vector<Wire>& operands);
  Wire inlined(const Compound& inner, const std::vector<Wire>& operands);
  Wire gathered(const std::vector<Port>& ports, const std::vector<Wire>& wires);
  int latency() const;
  std::vector<std::size_t> owners() const;
  std::string c_function() const;

  std::string name_;
  Turns turns_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace mote::hardware
