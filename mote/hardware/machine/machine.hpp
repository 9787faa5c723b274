#pragma once
/// A whole particle filter as a circuit: a filter of the library around a model's pipelines, between streams.

#include <string>
#include <vector>

#include "mote/hardware/machine/architecture.hpp"
#include "mote/hardware/machine/model_circuit.hpp"

namespace mote::hardware {

/// A file of a design.
struct DesignFile {
  std::string name, text;
};

/// How a circuit's registers are reached.
enum class RegisterAccess : std::uint8_t { kPorts, kAxiLite };

/// A circuit of its own: registers, a stream of observations in, a stream of estimates out.
///
///   est_tdata: mean of each state | sum of weights | scale | moves of the chain (architectures with one), low bits
///   first
///
/// error   Refusal (kWrongUse) for more particles than its sums have bits for
class Machine {
 public:
  /// shape   most: the most that registers may be told
  Machine(ModelCircuit model, const Architecture& architecture, const RunRegisters& most, std::uint64_t seed = 1,
          unsigned lanes = 1, const Variant& variant = {}, RegisterAccess access = RegisterAccess::kPorts);

  /// Of the filter, whose registers are ports; and of the module around it where they are on a bus.
  const std::string& name() const { return name_; }
  std::string top_name() const { return access_ == RegisterAccess::kPorts ? name_ : name_ + "_axi"; }
  RegisterAccess access() const { return access_; }
  /// Bits of an address of the registers on a bus: control, steps, and the architecture's, four bytes each.
  int address_bits() const { return 2 + ceil_log2(architecture_->registers.size() + 2); }
  const ModelCircuit& model() const { return model_; }
  const Architecture& architecture() const { return *architecture_; }
  const Formats& formats() const { return model_.arithmetic.formats; }
  const Capacity& capacity() const { return capacity_; }
  std::uint64_t seed() const { return seed_; }
  std::unique_ptr<Golden> golden() const { return architecture_->golden(model_.arithmetic, seed_, capacity_); }
  /// Of its pipeline, from a particle's parent to its weight.
  unsigned stages() const;

  /// Bits of what is written to the particle memory at once: a particle a lane.
  int particle_bits() const;
  /// Bits of an observation and of an estimate on their streams: whole bytes.
  int observation_bits() const;
  int estimate_bits() const;
  /// The parts of an estimate, low bits first.
  std::vector<Field> estimate_fields() const;
  /// The ports of the top module beside clock and reset, and the pins that all of them take.
  std::vector<Port> inputs() const;
  std::vector<Port> outputs() const;
  int pins() const;
  /// What stands on the stream.
  std::vector<std::uint32_t> observation_words(Observed observed) const;
  Estimate estimate_in(const std::uint32_t* words) const;

  /// The filter's SystemVerilog, which seeks tables in a folder (empty, or with its closing slash).
  std::string top(const std::string& folder) const;
  /// The module around it that has the registers on a bus.
  std::string axi_lite() const;
  /// The modules that it is made of: the top module last, before it those that it needs, of the library too.
  std::vector<DesignFile> modules(const std::string& folder) const;
  std::vector<DesignFile> tables() const;
  /// All of them in one: machines of equal texts are the same circuit.
  std::string text() const;
  /// Of the filter's module, without its tables, and those.
  std::vector<Parameter> parameters() const;
  std::vector<Memory> filter_tables() const;
  /// Lines of a data sheet: what the bits of its streams and of its particle memory are.
  std::string sheet() const;

 private:
  std::string name_;
  ModelCircuit model_;
  const Architecture* architecture_;
  Capacity capacity_;
  std::uint64_t seed_;
  RegisterAccess access_;
};

}  // namespace mote::hardware
