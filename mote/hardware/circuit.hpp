#pragma once
/// A circuit as its user sees it: the module to instantiate, its parameters, ports, latency and tables.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mote/hardware/format.hpp"

namespace mote::hardware {

/// A data port of a module.
struct Port {
  std::string name;
  int width = 1;
  bool sign = false;  ///< the word that it carries is signed
};

Port port(std::string name, const Format& format);

/// The contents of a table, for $readmemh.
struct Memory {
  std::string parameter;  ///< of the module, which names the file
  int width = 1;          ///< bits of a word, at most 128
  __extension__ std::vector<unsigned __int128> words;

  /// One word a line, hexadecimal.
  std::string text() const;
};

/// A SystemVerilog literal of a parameter.
struct Parameter {
  std::string name;
  std::string value;
};

Parameter parameter(std::string name, int value);
Parameter parameter(std::string name, bool value);
/// A literal of `width` bits.
Parameter parameter(std::string name, int width, std::uint64_t bits);
/// The parameters of an operand: <name>Signed, <name>Width, <name>Fraction.
void append_format(std::vector<Parameter>& parameters, const std::string& name, const Format& format);
/// Nearest and Saturate.
void append_finish(std::vector<Parameter>& parameters, const Finish& finish);

/// A module that was generated for its user: its name, its SystemVerilog, and the C function of the same name.
struct Source {
  std::string name;
  std::string text;
  std::string c;
};

/// Whether an operator is worth what it costs to choose operands for it, where several take turns at one instance.
enum class Sharing : std::uint8_t {
  kNever,
  kAlike,   ///< with operators of the same parameters and tables
  kWidened  ///< with any of its module and latency: its parameters are widths, of which the largest serve all
};

/// An instance to be. Every module has the clock clk_i; one word a clock goes in and, `latency` clocks later, out.
struct Circuit {
  std::string module;
  std::vector<Parameter> parameters;
  std::vector<Port> inputs;
  std::vector<Port> outputs;
  int latency = 0;
  bool reset = false;  ///< it has state, and rst_ni sets it to its beginning
  std::vector<Memory> memories = {};
  std::vector<Source> sources = {};  ///< modules that it needs beside the library's
  Sharing sharing = Sharing::kNever;
  int interval = 1;  ///< clocks from one word to the next; above 1, enters_i is 1 when one goes in
};

/// The name of the file of an instance's table: <instance>.<parameter>.hex, in lower case.
std::string memory_file(const std::string& instance, const Memory& memory);

/// The SystemVerilog that instantiates a circuit: port p is connected to connect(p), tables are sought in `folder`.
///
/// shape   folder: empty, or with its closing slash
std::string instantiation(const Circuit& circuit, const std::string& instance, const std::string& folder,
                          const std::vector<std::pair<std::string, std::string>>& connections);

/// The operands of a twin, one column a port, of one length.
using Columns = std::span<const std::span<const Word>>;
/// Where a twin writes, one column a port.
using Results = std::span<const std::span<Word>>;

/// Computes a column from one, two or three.
///
/// cost    O(rows), no allocation; `function` is inlined
template <class Function>
void each(std::span<const Word> a, std::span<Word> y, Function function) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = function(a[i]);
}
template <class Function>
void each(std::span<const Word> a, std::span<const Word> b, std::span<Word> y, Function function) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = function(a[i], b[i]);
}

/// What every operator offers: its circuit, and its golden twin, which gives the circuit's bits for whole columns.
template <class O>
concept Operator = requires(const O& op, Columns in, Results out) {
  { op.circuit() } -> std::same_as<Circuit>;
  op.compute(in, out);
};

}  // namespace mote::hardware
