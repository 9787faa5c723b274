#pragma once
/// A model of the catalogue as a filter circuit.

#include <memory>
#include <string>

#include "mote/app/words/study.hpp"
#include "mote/hardware/datapath/datapath.hpp"
#include "mote/hardware/machine/machine.hpp"

namespace mote {

/// What a circuit is made for.
struct CircuitDesign {
  const hardware::Architecture* architecture = nullptr;
  hardware::RunRegisters registers;  ///< of the runs to come; the circuit has room for no more
  std::uint64_t seed = 1;
  unsigned lanes = 1;
  hardware::RegisterAccess access = hardware::RegisterAccess::kPorts;
};

/// A circuit, and what the host knows of its model.
struct FilterCircuit {
  graph::Recorded recorded;
  hardware::Datapath datapath;
  std::shared_ptr<const hardware::Machine> machine;
};

/// Makes a model's circuit; its words are chosen on recordings that the model draws.
///
/// error   Refusal (kWrongUse): no circuit exists for an operation of the model
/// cost    a second or two
FilterCircuit filter_circuit(const CatalogueModel& model, const std::string& name, const CircuitDesign& design);

}  // namespace mote
