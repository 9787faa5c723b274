#pragma once
/// Instances: a model that is independent copies of another, filtered by as many circuits of that one side by side.

#include "mote/app/circuits/circuit.hpp"
#include "mote/engine/run_record.hpp"
#include "mote/hardware/machine/cost.hpp"
#include "mote/hardware/machine/simulator.hpp"

namespace mote {

/// The model that one of a design's instances filters: a copy of the whole, or with one instance the whole.
///
/// error   Refusal (kWrongUse): the model is not so many copies
std::shared_ptr<const CatalogueModel> model_of_instance(const std::shared_ptr<const CatalogueModel>& model,
                                                        const std::string& name, const CircuitDesign& design);

/// What an instance sees of a recording: of each row its own columns, so many.
Recording instance_of(std::size_t columns, const CircuitDesign& design, const Recording& recording,
                      std::size_t instance);

/// The seed of an instance's generators: the first one's is the design's.
std::uint64_t seed_of_instance(std::uint64_t seed, unsigned instance);

/// Runs of all instances as one of the whole: states side by side, evidences added, the mean acceptance.
RunRecord side_by_side(const std::vector<RunRecord>& records, const std::vector<Quantity>& states);

/// Words of all, the cycles of the slowest: they start together, and each goes at its own pace.
hardware::Agreement side_by_side(const std::vector<hardware::Agreement>& all);

/// What so many of a circuit take.
hardware::Cost times(unsigned instances, hardware::Cost cost);

/// The SystemVerilog of a module with all instances, their streams abreast: <circuit>_x<instances>.
std::string module_of_instances(const hardware::Machine& machine, unsigned instances);

/// What plays a recording to that module: `kept` writes to the particle memory by each, `most_cycles` at most.
std::string testbench_of_instances(const hardware::Machine& machine, const CircuitDesign& design, std::size_t steps,
                                   std::size_t kept, std::uint64_t most_cycles);

}  // namespace mote
