#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/circuits/circuit.hpp"
#include "mote/app/commands/command.hpp"
#include "mote/app/files/output.hpp"
#include "mote/app/simulated/measurement.hpp"
#include "mote/app/terminal/progress.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

/// A figure over repeats: its median, and from the least to the largest.
struct Spread {
  double median = 0, least = 0, most = 0;
};

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

/// What an engine takes for a particle, in seconds; an engine without stages has all in the first.
struct EngineTimes {
  std::string name;
  bool stages = false;
  Spread propose, weigh, chain;
};

/// A circuit's, in cycles.
struct CircuitTimes {
  std::string arch;
  std::uint64_t propose_latency, weigh_latency;
};

EngineTimes engine_times(const std::string& name, bool stages, const CatalogueModel& model, simulated::Workload work,
                         const Arguments& arguments, int repeats, const std::function<void()>& ran) {
  work.by_stages = stages;
  std::vector<double> times[3];
  for (int k = 0; k < repeats; ++k) {
    const StageTimes t = simulated::measured(model, work, arguments.text("--proposal"), arguments.where()).times;
    for (const auto& [all, one] : {std::pair{&times[0], t.propose}, {&times[1], t.weigh}, {&times[2], t.chain}})
      all->push_back(one);
    ran();
  }
  return {name, stages, spread_of(times[0]), spread_of(times[1]), spread_of(times[2])};
}

CircuitTimes circuit_times(const std::shared_ptr<const CatalogueModel>& model, const std::string& name,
                           std::size_t particles) {
  CircuitDesign design;
  design.where = "mote design measure";
  design.architecture = &hardware::architectures().front();
  design.registers.particles = design.registers.draws = static_cast<std::uint32_t>(particles);
  const FilterCircuit circuit = filter_circuit(model, name, design);
  const hardware::ImhLatency latency(circuit.machine->formats());
  return {std::string(design.architecture->name), latency.propose, latency.weigh};
}

Json spread_json(const Spread& s) { return {{"median", s.median}, {"least", s.least}, {"most", s.most}}; }

Json measure_json(const std::string& model, const std::vector<EngineTimes>& engines,
                  const std::optional<CircuitTimes>& circuit) {
  Json all{{"model", model}, {"engines", Json::object()}, {"circuit", nullptr}};
  for (const EngineTimes& e : engines)
    all["engines"][e.name] =
        e.stages
            ? Json{{"tp_s", spread_json(e.propose)}, {"tw_s", spread_json(e.weigh)}, {"td_s", spread_json(e.chain)}}
            : Json{{"particle_s", spread_json(e.propose)}};
  if (circuit)
    all["circuit"] = {{"arch", circuit->arch},
                      {"kp", circuit->propose_latency},
                      {"kw", circuit->weigh_latency},
                      {"tp", 1},
                      {"tw", 1},
                      {"td", 1}};
  return all;
}

std::string measure_text(const std::vector<EngineTimes>& engines, const std::optional<CircuitTimes>& circuit,
                         const simulated::Workload& work) {
  std::string text =
      fmt::format("{:<10}{:<12}{:>12}{:>12}{:>12}\n", "engine", "a particle", "median ns", "least", "most");
  const auto row = [&](const std::string& engine, const char* stage, const Spread& s) {
    text += fmt::format("{:<10}{:<12}{:>12.4g}{:>12.4g}{:>12.4g}\n", engine, stage, 1e9 * s.median, 1e9 * s.least,
                        1e9 * s.most);
  };
  for (const EngineTimes& e : engines) {
    row(e.name, e.stages ? "T_p" : "step", e.propose);
    if (e.stages) row("", "T_w", e.weigh), row("", "T_d", e.chain);
  }
  if (circuit)
    text += fmt::format("circuit {}: K_p {}, K_w {}, T_p = T_w = T_D = 1 cycle\n", circuit->arch,
                        circuit->propose_latency, circuit->weigh_latency);
  const EngineTimes& staged = engines.front();
  return text + fmt::format("mote design optimise --tp {:.4g} --tw {:.4g} --td {:.4g} -n {}\n", staged.propose.median,
                            staged.weigh.median, staged.chain.median, work.particles);
}

ExitCode run_measure(const Arguments& arguments) {
  const std::string name = arguments.text("MODEL");
  simulated::Workload work;
  work.filter = arguments.choice("--filter", {"imh", "sisr", "auxiliary"}) == 0 ? FilterKind::kImh
                : arguments.text("--filter") == "sisr"                          ? FilterKind::kSisr
                                                                                : FilterKind::kAuxiliary;
  work.particles = static_cast<std::size_t>(arguments.integer("--particles", 1, 1'000'000));
  work.number_bytes = arguments.choice("--precision", {"double", "float"}) == 0 ? 8 : 4;
  const int repeats = static_cast<int>(arguments.integer("--repeats", 1, 1000));
  const std::shared_ptr<const CatalogueModel> model = find_model(name, arguments.where())
                                                          .make(Settings(arguments.where(), arguments.list("--set")),
                                                                frame_header(arguments.integer("--columns", 1, 64)));
  OutputSet outputs;
  Output* json = outputs.open(arguments.text("--json"));
  std::vector<EngineTimes> engines;
  {
    Progress progress("measurements");
    int done = 0;
    const auto ran = [&] { progress.update(static_cast<std::size_t>(++done), static_cast<std::size_t>(2 * repeats)); };
    engines.push_back(engine_times("pipeline", true, *model, work, arguments, repeats, ran));
    if (arguments.text("--proposal") == Prior::kName)
      engines.push_back(engine_times("simd", false, *model, work, arguments, repeats, ran));
  }
  std::optional<CircuitTimes> circuit;
  if (arguments.given("--circuit")) circuit = circuit_times(model, name, std::min<std::size_t>(work.particles, 65536));
  if (json != nullptr) json->write(measure_json(name, engines, circuit).dump(2) + "\n");
  outputs.commit();
  if (!outputs.on_standard_output()) fmt::print("{}", measure_text(engines, circuit, work));
  return ExitCode::kDone;
}

}  // namespace

Command design_measure_command() {
  return {
      "design measure",
      "What a particle takes in each stage, on this machine and as a circuit",
      {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
      {{"--filter", "NAME", "imh", "imh, sisr (T_d: its resampling) or auxiliary", "Work"},
       {"-n,--particles", "N", "1000", "particles, from 1 to 1000000", "Work"},
       {"--proposal", "NAME", "prior", "proposal density of the model (see mote models NAME)", "Work"},
       {"--precision", "TYPE", "double", "float or double", "Work"},
       {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", "Work", true},
       {"--columns", "M", "1", "doa: directions per frame, from 1 to 64", "Work"},
       {"--repeats", "R", "5", "measurements, each the quickest of five runs; their median and range are said", "Work"},
       {"--circuit", "", "", "also the latencies of the model's circuit, --arch imh of mote rtl", "Work"},
       {"--json", "FILE", "", "times as JSON; - is standard output [none]", "Output"}},
      run_measure,
      "Times are the processor's, of one core. Exit codes: 0 done, 2 wrong use, 3 bad data, 6 cannot write."};
}

}  // namespace mote
