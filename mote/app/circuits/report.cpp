#include "mote/app/circuits/report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/report/page.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

Json rmse_json(const CircuitReport& found) {
  if (!found.summary) return nullptr;
  Json all = Json::object();
  for (std::size_t d = 0; d < found.summary->rmse.size(); ++d)
    if (!std::isnan(found.summary->rmse[d])) all[found.simulation->record.states[d].name] = found.summary->rmse[d];
  return all;
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

report::Table bits_of(const std::string& title, const std::vector<hardware::Field>& fields) {
  report::Table table{title, {"bits", "format", "what"}};
  int at = 0;
  for (const hardware::Field& field : fields) {
    table.rows.push_back({fmt::format("{}:{}", at + field.format.width() - 1, at), field.format.name(), field.name});
    at += field.format.width();
  }
  return table;
}

const hardware::Activity* counted(const CircuitReport& found) {
  return found.simulation && found.simulation->activity.measured ? &found.simulation->activity : nullptr;
}

std::string power_words(const CircuitReport& found) {
  const hardware::Activity* activity = counted(found);
  const std::string by = activity == nullptr ? "one bit in eight changing"
                                             : fmt::format("{:.1f} % of all bits changing ({:.1f} % of multipliers')",
                                                           100 * activity->fabric, 100 * activity->products);
  return fmt::format("{:.0f} mW, an estimate by resources and {} a clock", *found.cost->power_mw, by);
}

}  // namespace

void append_cost(std::vector<report::Fact>& facts, const hardware::Cost& cost) {
  facts.push_back({"device", cost.device});
  facts.push_back({"area", fmt::format("{} LUT, {} FF, {} DSP, {} BRAM_18K, {} IOB", cost.lut, cost.ff, cost.dsp,
                                       cost.bram18, cost.iob)});
  if (cost.fmax_mhz) facts.push_back({"clock", fmt::format("{:.1f} MHz", *cost.fmax_mhz)});
  if (cost.sta_ns) facts.push_back({"sta", fmt::format("{:.2f} ns of logic by Yosys", *cost.sta_ns)});
  if (!cost.no_sta.empty()) facts.push_back({"sta", "unknown. " + cost.no_sta});
}

std::optional<double> CircuitReport::milliseconds() const {
  if (!simulation || !cost || !cost->fmax_mhz) return std::nullopt;
  return static_cast<double>(simulation->agreement.cycles) / (1000 * *cost->fmax_mhz);
}

std::optional<double> CircuitReport::microjoules_per_step() const {
  const auto ms = milliseconds();
  if (!ms || !cost->power_mw) return std::nullopt;
  return *cost->power_mw * *ms / static_cast<double>(simulation->record.predicted_steps);
}

std::vector<report::Fact> circuit_facts(const FilterCircuit& circuit, const CircuitReport& found) {
  const hardware::Machine& machine = *circuit.machine;
  const hardware::Formats& f = machine.formats();
  std::vector<report::Fact> facts{
      {"circuit", fmt::format("{}: {}", machine.name(), machine.architecture().meaning)},
      {"pipeline", fmt::format("{} stages: proposal {}, log weight {}, filter {}", machine.stages(), f.propose_latency,
                               f.weigh_latency, machine.stages() - f.propose_latency - f.weigh_latency)},
      {"words", fmt::format("states of {} bits, {} random words a particle", f.value_bits, f.draw_words)}};
  if (const auto& s = found.simulation) {
    facts.push_back(
        {"cycles", fmt::format("{} ({} by the golden model)", s->agreement.cycles, s->agreement.predicted_cycles)});
    facts.push_back({"golden model",
                     fmt::format("{} of {} particle words differ", s->agreement.mismatches, s->agreement.compared)});
  }
  const Json rmse = rmse_json(found);
  for (const auto& [state, value] : rmse.items())
    facts.push_back({"rmse " + state, fmt::format("{:.4g}", value.get<double>())});
  if (const auto& c = found.cost) {
    append_cost(facts, *c);
    if (c->power_mw) facts.push_back({"power", power_words(found)});
  }
  if (const auto ms = found.milliseconds()) facts.push_back({"time", fmt::format("{:.4g} ms", *ms)});
  if (const auto uj = found.microjoules_per_step()) facts.push_back({"energy", fmt::format("{:.3g} uJ a step", *uj)});
  return facts;
}

Json cost_json(const std::optional<hardware::Cost>& cost) {
  if (!cost) {
    Json json = Json::object();
    for (const char* key : {"lut", "ff", "dsp", "bram18", "iob", "fmax_mhz", "sta_ns", "device", "power_mw"})
      json[key] = nullptr;
    return json;
  }
  return {{"lut", cost->lut},
          {"ff", cost->ff},
          {"dsp", cost->dsp},
          {"bram18", cost->bram18},
          {"iob", cost->iob},
          {"fmax_mhz", or_null(cost->fmax_mhz)},
          {"sta_ns", or_null(cost->sta_ns)},
          {"device", cost->device},
          {"power_mw", or_null(cost->power_mw)}};
}

Json circuit_json(const FilterCircuit& circuit, const CircuitReport& found) {
  Json json = cost_json(found.cost);
  json.update(Json{{"cycles", nullptr}, {"predicted_cycles", nullptr}, {"compared", nullptr}, {"mismatches", nullptr}});
  if (const auto& s = found.simulation)
    json.update(Json{{"cycles", s->agreement.cycles},
                     {"predicted_cycles", s->agreement.predicted_cycles},
                     {"compared", s->agreement.compared},
                     {"mismatches", s->agreement.mismatches}});
  json["rmse"] = rmse_json(found);
  const hardware::Activity* activity = counted(found);
  json["switching"] = activity == nullptr ? Json(nullptr) : Json(activity->fabric);
  json["uj_per_step"] = or_null(found.microjoules_per_step());
  json["stages"] = circuit.machine->stages();
  json["milliseconds"] = or_null(found.milliseconds());
  return json;
}

std::string circuit_text(const FilterCircuit& circuit, const CircuitReport& found) {
  std::string text;
  for (const report::Fact& fact : circuit_facts(circuit, found))
    text += fmt::format("{:<14}{}\n", fact.name, fact.value);
  return text;
}

std::string circuit_page(const FilterCircuit& circuit, const CircuitReport& found) {
  const hardware::Machine& machine = *circuit.machine;
  report::Page page;
  page.title = machine.name();
  page.command = found.command;
  page.facts = circuit_facts(circuit, found);
  page.tables = {bits_of("observation, obs_tdata_i", machine.model().observed),
                 bits_of("estimate, est_tdata_o", machine.estimate_fields()),
                 bits_of("particle, set_state_o", machine.model().states)};
  return report::html(page);
}

}  // namespace mote
