#include "mote/app/circuits/circuit.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "mote/app/circuits/instances.hpp"

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
WordStudyDesign sample_design(const CircuitDesign& circuit) {
  WordStudyDesign design;
  design.particles = 200;
  design.recordings = 8;
  design.where = circuit.where;
  design.proposal = circuit.proposal;
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
  for (std::size_t d = 0; d < path.states.size(); ++d) model.states.push_back({path.names[d], path.states[d]});
  for (const hardware::ObservedField& field : path.observed) model.observed.push_back({field.name, field.format});
  return model;
}

}  // namespace

ModelDatapath model_datapath(const std::shared_ptr<const CatalogueModel>& model, const std::string& name,
                             const CircuitDesign& design, const Recording& played) {
  const auto part = model_of_instance(model, name, design);
  WordStudyDesign samples = sample_design(design);
  if (!played.steps.empty())
    for (unsigned i = 0; i < design.instances; ++i)
      samples.given.push_back(instance_of(part->columns().size(), design, played, i));
  const WordStudy study(*part, samples);
  hardware::DatapathOptions options;
  options.prefix = "mote_" + identifier(name);
  options.overlapped = design.variant.overlapped;
  options.more_bits = design.more_bits;
  options.interval = design.interval;
  options.logic_tables = design.variant.logic_tables;
  options.multiplier = design.multiplier;
  return {study.recorded(), hardware::datapath(study.recorded(), study.samples(), options)};
}

FilterCircuit filter_circuit(const std::shared_ptr<const CatalogueModel>& model, const std::string& name,
                             const CircuitDesign& design, ModelDatapath pipelines) {
  FilterCircuit circuit{std::move(pipelines.recorded), std::move(pipelines.datapath), nullptr, {}, model->states()};
  const auto machine = [&](unsigned instance) {
    return std::make_shared<hardware::Machine>(model_circuit(identifier(name), circuit), *design.architecture,
                                               design.registers, seed_of_instance(design.seed, instance), design.lanes,
                                               design.variant, design.access);
  };
  circuit.machine = machine(0);
  for (unsigned i = 1; i < design.instances; ++i) circuit.others.push_back(machine(i));
  return circuit;
}

FilterCircuit filter_circuit(const std::shared_ptr<const CatalogueModel>& model, const std::string& name,
                             const CircuitDesign& design, const Recording& played) {
  return filter_circuit(model, name, design, model_datapath(model, name, design, played));
}

}  // namespace mote
