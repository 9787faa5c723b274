#pragma once
/// Co-simulation: circuits side by side in one design, compiled by Verilator and driven from here.

#include <memory>
#include <vector>

#include "mote/base/scratch_folder.hpp"
#include "mote/hardware/circuit.hpp"

namespace mote::hardware {

/// The words of a circuit's ports: one column a port, one row a clock.
using Table = std::vector<std::vector<Word>>;

/// A design of independent circuits that share a clock and a reset, simulated cycle by cycle.
///
/// cost    building: 5 to 60 s of Verilator and compiler; a row: two evaluations of the design
/// error   Refusal (kOutsideTool) when Verilator is missing, warns about a circuit (-Wall) or fails
class Bench {
 public:
  explicit Bench(std::vector<Circuit> circuits);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench(Bench&&) = delete;
  Bench& operator=(const Bench&) = delete;
  Bench& operator=(Bench&&) = delete;

  /// What each circuit answers to each row, from the state after reset; its latency is taken away. One that takes a row
  /// every k clocks sees other words between, which must not matter.
  ///
  /// shape   inputs[c]: the columns of circuit c, all of one length; a circuit without inputs has no columns
  ///         rows: of every column
  std::vector<Table> run(const std::vector<Table>& inputs, std::size_t rows);

 private:
  void build();

  std::vector<Circuit> circuits_;
  ScratchFolder folder_;
  void* library_ = nullptr;
  void (*run_)(const Word* const*, Word* const*, std::size_t) = nullptr;
};

/// The SystemVerilog of a module with the circuits side by side: ports i<c>_<p> and o<c>_<p>, circuit c, port p.
std::string bench_module(const std::string& name, const std::vector<Circuit>& circuits, const std::string& folder);

/// Writes what that module needs into a folder: itself, the library, generated modules, tables.
///
/// shape   folder: with its closing slash
/// error   Refusal (kCannotWrite)
void write_bench(const std::string& folder, const std::string& name, const std::vector<Circuit>& circuits);

/// The words of an operator's twin.
template <Operator O>
Table computed(const O& op, const Table& inputs, std::size_t rows) {
  Table outputs(op.circuit().outputs.size(), std::vector<Word>(rows));
  const std::vector<std::span<const Word>> in(inputs.begin(), inputs.end());
  const std::vector<std::span<Word>> out(outputs.begin(), outputs.end());
  op.compute(in, out);
  return outputs;
}

}  // namespace mote::hardware
