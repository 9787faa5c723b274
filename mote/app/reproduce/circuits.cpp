#include "mote/app/reproduce/circuits.hpp"

#include <algorithm>
#include <future>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/circuits/instances.hpp"
#include "mote/app/commands/rtl_options.hpp"
#include "mote/engine/latency.hpp"
#include "mote/hardware/newer_yosys.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::reproduce {
namespace {

/// What is found once of every circuit, whatever item it stands in: equal texts are the same circuit, and who asks for
/// the same waits for the first.
template <class Found>
class Once {
 public:
  Found of(const std::string& text, const std::function<Found()>& find) {
    std::shared_future<Found> found;
    {
      const std::lock_guard lock(mutex_);
      std::shared_future<Found>& place = all_[text];
      if (!place.valid()) place = std::async(std::launch::deferred, find).share();
      found = place;
    }
    return found.get();
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_future<Found>> all_;
};

}  // namespace

CircuitBench::CircuitBench(const Run& run, const Job& job) : where_(run.where), job_(job) {
  const Arguments arguments = arguments_from(run.where, circuit_options(), run.options);
  design_ = circuit_design_from(arguments);
  family_ = family_from(arguments);
}

Tools CircuitBench::needed(const Comparison& c) const {
  const auto is = [&](std::initializer_list<std::string_view> keys) {
    return std::find(keys.begin(), keys.end(), c.key) != keys.end();
  };
  const bool timed = is({"milliseconds", "uj_per_step"});
  const bool found = family_ && c.mhz == 0;
  return {timed || is({"cycles", "mismatches", "step_cycles_over_law"}),
          found && (timed || is({"lut", "ff", "dsp", "bram18", "fmax_mhz", "power_mw"})), found && is({"sta_ns"})};
}

std::string CircuitBench::missing(const Comparison& c) const {
  const Tools tools = needed(c);
  for (const auto& [tool, takes] : {std::pair{"verilator", tools.simulation}, {"yosys", tools.synthesis}})
    if (takes && !hardware::on_path(tool))
      return fmt::format("there is no {0}. Install it: apt-get install {0}.", tool);
  if (tools.sta && !hardware::NewerYosys::found())
    return fmt::format("there is no Yosys that has sta. Install it: {}.", hardware::kInstallNewerYosys);
  return "";
}

std::vector<std::function<void()>> CircuitBench::errands(const Tools& tools, const Recording& recording) {
  std::vector<std::function<void()>> all;
  if (tools.simulation || tools.synthesis || tools.sta) circuit();  // which all of them share
  if (tools.sta) all.emplace_back([this] { sta(); });
  if (tools.synthesis) all.emplace_back([this] { cost(); });
  if (tools.simulation) all.emplace_back([this, &recording] { simulation(recording); });
  return all;
}

const FilterCircuit& CircuitBench::circuit() {
  if (!circuit_) circuit_ = filter_circuit(job_.model, job_.model_name, design_);
  return *circuit_;
}

RunRecord CircuitBench::record(const Recording& recording, std::uint64_t seed_offset) {
  CircuitDesign design = design_;
  design.seed += seed_offset;
  return golden_run(circuit(), design, recording, where_);
}

double CircuitBench::step_cycles(const Recording& recording) {
  const auto all = static_cast<double>(simulation(recording).agreement.cycles);
  const auto observed =
      observed_by(circuit(), instance_of(circuit().recorded.columns.size(), design_, recording, 0), where_);
  simulators_.front()->reset();
  const auto first = static_cast<double>(simulators_.front()->run(design_.registers, {observed.front()}).cycles);
  return (all - first) / static_cast<double>(observed.size() - 1);
}

double CircuitBench::law_cycles() {
  const hardware::ImhLanes lanes = design_.architecture->fed(circuit().machine->capacity());
  const hardware::ImhLatency latency(circuit().machine->formats(), lanes);
  const StageLatencies latencies{static_cast<double>(latency.propose), static_cast<double>(latency.weigh)};
  const auto turn = static_cast<double>(latency.interval);
  return lanes.folded ? paired_time(design_.registers.draws + design_.registers.burn_in, lanes.count,
                                    {1, 1, 1.0 / lanes.count}, latencies)
                      : sequential_time(lanes.rows(design_.registers), {turn, turn, 1}, latencies);
}

const CircuitSimulation& CircuitBench::simulation(const Recording& recording) {
  if (!simulation_) {
    simulators_ = simulators_of(circuit(), design_);
    simulation_ = simulated_run(circuit(), design_, recording, where_, simulators_);
  }
  return *simulation_;
}

hardware::Cost CircuitBench::cost() {
  static Once<hardware::Cost> costs;
  const hardware::Machine& machine = *circuit().machine;
  return times(design_.instances, costs.of(machine.text() + std::to_string(static_cast<int>(*family_)),
                                           [&] { return hardware::cost_of(machine, *family_, {}, false); }));
}

double CircuitBench::sta() {
  static Once<double> times;
  const hardware::Machine& machine = *circuit().machine;
  return times.of(machine.text(), [&] { return hardware::sta_ns(machine).value_or(kNaN); });
}

double CircuitBench::figure(const Comparison& c, const Recording& recording) {
  if (c.key == "step_cycles_over_law") return step_cycles(recording) / law_cycles();
  if (c.key == "golden_cycles") return static_cast<double>(golden_cycles(circuit(), design_, recording, where_));
  const Tools tools = needed(c);
  if (tools.sta) return sta();
  CircuitReport found{job_.model_name, "", design_, {}, {}, {}};
  if (tools.simulation) found.simulation = simulation(recording);
  if (c.mhz > 0) return static_cast<double>(found.simulation->agreement.cycles) / (1000 * c.mhz);
  if (tools.synthesis) found.cost = cost();
  const nlohmann::json value = circuit_json(circuit(), found)[c.key];
  return value.is_number() ? value.get<double>() : kNaN;
}

}  // namespace mote::reproduce
