#include "mote/app/circuits/circuit.hpp"

#include <algorithm>
#include <cctype>

namespace mote {
namespace {

/// A name that SystemVerilog takes: "my model.toml" -> "my_model".
std::string identifier(std::string name) {
  name = name.substr(name.find_last_of('/') + 1);
  name = name.substr(0, name.rfind(".toml"));
  for (char& c : name)
    c = std::isalnum(static_cast<unsigned char>(c)) != 0
            ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
            : '_';
  return name;
}

/// What is simulated to choose words by: enough for their ranges.
WordStudyDesign sample_design() {
  WordStudyDesign design;
  design.particles = 200;
  design.recordings = 8;
  return design;
}

hardware::ModelCircuit model_circuit(const std::string& name, const FilterCircuit& circuit) {
  const hardware::Datapath& path = circuit.datapath;
  hardware::ModelCircuit model{name,
                               path.propose.circuit(),
                               path.weigh.circuit(),
                               hardware::propose_connections(path),
                               hardware::weigh_connections(path),
                               {},
                               {},
                               path.arithmetic};
  for (std::size_t d = 0; d < path.states.size(); ++d)
    model.states.push_back({circuit.recorded.states[d].name, path.states[d]});
  for (const hardware::ObservedField& field : path.observed) model.observed.push_back({field.name, field.format});
  return model;
}

}  // namespace

FilterCircuit filter_circuit(const CatalogueModel& model, const std::string& name, const CircuitDesign& design) {
  const WordStudy study(model, sample_design());
  hardware::DatapathOptions options;
  options.prefix = "mote_" + identifier(name);
  FilterCircuit circuit{study.recorded(), hardware::datapath(study.recorded(), study.samples(), options), nullptr};
  circuit.machine = std::make_shared<hardware::Machine>(model_circuit(identifier(name), circuit), *design.architecture,
                                                        design.registers, design.seed, design.lanes, design.access);
  return circuit;
}

}  // namespace mote
