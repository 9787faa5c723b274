#include "mote/app/circuits/simulation.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "mote/app/circuits/instances.hpp"
#include "mote/app/files/output.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

constexpr Step kMostSteps = 65535;  // the circuit's register has 16 bits

Row<double> unseen_row(const std::vector<Column>& columns) {
  Row<double> row;
  for (const Column& column : columns) {
    row.values.push_back(column.input ? column.fallback : 0);
    row.present.push_back(column.input);
  }
  return row;
}

void refuse_crowded(const ObservedStep& step, const std::string& where) {
  if (step.rows.size() > 1)
    throw Refusal(ExitCode::kBadData, {where, fmt::format("t = {}", step.t), "one row a step, which a circuit takes",
                                       std::to_string(step.rows.size()), "Merge them, or use mote run."});
}

EstimateRow row_of(const FilterCircuit& circuit, const CircuitDesign& design, Step t, bool seen,
                   const hardware::Estimate& estimate) {
  const hardware::Datapath& path = circuit.datapath;
  const std::uint64_t offered = design.architecture->offered(design.registers, circuit.machine->capacity());
  const std::uint64_t decided = design.architecture->decided(design.registers, circuit.machine->capacity());
  EstimateRow row{t, {}, {}, {}};
  for (const double mean : path.means(estimate.mean)) row.states.push_back({mean, kNaN});
  const double octaves = hardware::log2_evidence(estimate, path.arithmetic.formats, offered) + path.constant;
  row.report.log_evidence = seen ? octaves * std::numbers::ln2 : 0;
  row.report.ess = kNaN;
  if (design.architecture->chain && decided > 0)
    row.report.acceptance = static_cast<double>(estimate.accepted) / static_cast<double>(decided);
  return row;
}

RunRecord record_of(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                    const std::vector<hardware::Estimate>& estimates) {
  RunRecord record;
  record.states = circuit.recorded.states;
  record.plan.particles = design.registers.particles;
  record.predicted_steps = estimates.size();
  for (const ObservedStep& step : recording.steps)
    if (const auto k = static_cast<std::size_t>(step.t - 1); k < estimates.size())
      record.rows.push_back(row_of(circuit, design, step.t, !step.rows.empty(), estimates[k]));
  return record;
}

}  // namespace

std::vector<std::vector<std::int64_t>> observed_by(const FilterCircuit& circuit, const Recording& recording,
                                                   const std::string& where) {
  const Step last = recording.steps.back().t;
  if (last > kMostSteps)
    throw Refusal(ExitCode::kBadData, {where, "column \"t\"", fmt::format("at most {}, a run of a circuit", kMostSteps),
                                       std::to_string(last), "Split the recording."});
  std::vector<Row<double>> rows(static_cast<std::size_t>(last), unseen_row(circuit.recorded.columns));
  for (const ObservedStep& step : recording.steps) {
    refuse_crowded(step, where);
    if (!step.rows.empty()) rows[static_cast<std::size_t>(step.t - 1)] = step.rows.front();
  }
  std::vector<std::vector<std::int64_t>> observed;
  for (Row<double>& row : rows) {
    for (std::size_t j = 0; j < row.values.size(); ++j)
      if (!row.present[j]) row.values[j] = 0;
    const Step t = static_cast<Step>(observed.size() + 1);
    observed.push_back(circuit.datapath.observe(row, circuit.recorded.schedule(t)));
  }
  return observed;
}

namespace {

/// One of a design's instances and what it sees: `run(machine, observed)` gives its estimates.
template <class RunOne>
RunRecord run_of_instances(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                           const std::string& where, const RunOne& run) {
  std::vector<RunRecord> records;
  for (unsigned i = 0; i < design.instances; ++i) {
    const Recording seen = instance_of(circuit.recorded.columns.size(), design, recording, i);
    records.push_back(record_of(circuit, design, seen, run(i, observed_by(circuit, seen, where))));
  }
  return design.instances == 1 ? records.front() : side_by_side(records, circuit.states);
}

}  // namespace

Simulators simulators_of(const FilterCircuit& circuit, const CircuitDesign& design, bool counts_changes) {
  Simulators all;
  for (unsigned i = 0; i < design.instances; ++i)
    all.push_back(std::make_unique<hardware::Simulator>(circuit.instance(i), counts_changes));
  return all;
}

CircuitSimulation simulated_run(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                                const std::string& where, const Simulators& simulators) {
  std::vector<hardware::Agreement> agreements;
  hardware::Activity activity;
  const auto simulate = [&](unsigned i, const std::vector<std::vector<std::int64_t>>& observed) {
    const hardware::Machine& machine = circuit.instance(i);
    const hardware::CircuitRun run = simulators[i]->run(design.registers, observed);
    activity = run.activity;
    agreements.push_back(hardware::agreement(run, *machine.golden(), design.registers, observed));
    return run.estimates;
  };
  RunRecord record = run_of_instances(circuit, design, recording, where, simulate);
  return {side_by_side(agreements), activity, std::move(record)};
}

namespace {

/// The golden models' run: what each instance gives, and the cycles of the slowest.
std::pair<RunRecord, std::uint64_t> golden_outcome(const FilterCircuit& circuit, const CircuitDesign& design,
                                                   const Recording& recording, const std::string& where) {
  std::uint64_t cycles = 0;
  RunRecord record = run_of_instances(
      circuit, design, recording, where, [&](unsigned i, const std::vector<std::vector<std::int64_t>>& observed) {
        const auto golden = design.architecture->golden(circuit.datapath.arithmetic, seed_of_instance(design.seed, i),
                                                        circuit.machine->capacity());
        golden->start(design.registers);
        std::vector<hardware::Estimate> estimates;
        for (const auto& step : observed) estimates.push_back(golden->step(step));
        cycles = std::max(cycles, golden->cycles());
        return estimates;
      });
  return {std::move(record), cycles};
}

}  // namespace

RunRecord golden_run(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                     const std::string& where) {
  return golden_outcome(circuit, design, recording, where).first;
}

std::uint64_t golden_cycles(const FilterCircuit& circuit, const CircuitDesign& design, const Recording& recording,
                            const std::string& where) {
  return golden_outcome(circuit, design, recording, where).second;
}

std::string circuit_estimates_csv(const RunRecord& record, bool chain) {
  std::string csv = "t";
  for (const Quantity& state : record.states) csv += "," + state.name + "_mean";
  csv += chain ? ",log_evidence,acceptance\n" : ",log_evidence\n";
  for (const EstimateRow& row : record.rows) {
    csv += std::to_string(row.t);
    for (const Moments& m : row.states) csv += "," + exact(m.mean);
    csv += "," + exact(row.report.log_evidence);
    if (chain) csv += "," + exact(row.report.acceptance);
    csv += '\n';
  }
  return csv;
}

}  // namespace mote
