#pragma once
/// A model of the catalogue as a filter circuit.

#include <memory>
#include <string>
#include <vector>

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
  hardware::Variant variant;
  unsigned instances = 1;          ///< for a model of so many independent copies: a circuit each, side by side
  std::string where = "mote rtl";  ///< who asks for it, for refusals
  std::string proposal = "prior";  ///< of an architecture whose weights are those of pairs
  hardware::RegisterAccess access = hardware::RegisterAccess::kPorts;
  hardware::Multiplier multiplier = hardware::Multiplier::kDsp;  ///< of the model's pipelines and the filter
  int interval = 1;   ///< cycles from a particle to the next, in which costly operators take turns
  int more_bits = 0;  ///< after the point, of all words, than the sensitivities ask for
};

/// A circuit, and what the host knows of its model.
struct FilterCircuit {
  graph::Recorded recorded;
  hardware::Datapath datapath;
  std::shared_ptr<const hardware::Machine> machine;
  std::vector<std::shared_ptr<const hardware::Machine>> others;  ///< further instances, which differ in their seeds
  std::vector<Quantity> states;                                  ///< of the whole model

  const hardware::Machine& instance(std::size_t i) const { return i == 0 ? *machine : *others[i - 1]; }
};

/// A model's pipelines, which filters of several kinds are put around.
struct ModelDatapath {
  graph::Recorded recorded;
  hardware::Datapath datapath;
};

/// The pipelines of a design: they depend on its instances, proposal, more_bits, interval, where tables stand and
/// whether steps overlap. Words are chosen on recordings that the model draws, and on the one that will be played, if
/// any: real inputs and long runs go where those that it draws do not.
///
/// error   Refusal (kWrongUse): the model is not as many copies as instances are asked for, or it cannot be drawn from
///         and nothing is played
/// cost    a second or two
ModelDatapath model_datapath(const std::shared_ptr<const CatalogueModel>& model, const std::string& name,
                             const CircuitDesign& design, const Recording& played = {});

/// The design's filter around pipelines of it.
FilterCircuit filter_circuit(const std::shared_ptr<const CatalogueModel>& model, const std::string& name,
                             const CircuitDesign& design, ModelDatapath pipelines);

/// Makes a model's circuit, both together.
///
/// error   as model_datapath()
/// cost    likewise
FilterCircuit filter_circuit(const std::shared_ptr<const CatalogueModel>& model, const std::string& name,
                             const CircuitDesign& design, const Recording& played = {});

}  // namespace mote
