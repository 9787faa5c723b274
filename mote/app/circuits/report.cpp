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

}  // namespace

std::optional<double> CircuitReport::milliseconds() const {
  if (!simulation || !cost || !cost->fmax_mhz) return std::nullopt;
  return static_cast<double>(simulation->agreement.cycles) / (1000 * *cost->fmax_mhz);
}

std::vector<report::Fact> circuit_facts(const FilterCircuit& circuit, const CircuitReport& found) {
  const hardware::Machine& machine = *circuit.machine;
  const hardware::Formats& f = machine.formats();
  std::vector<report::Fact> facts{
      {"circuit", fmt::format("{}: {}", machine.name(), machine.architecture().meaning)},
      {"pipeline", fmt::format("{} stages: proposal {}, log weight {}, filter {}", machine.stages(), f.propose_latency,
                               f.weigh_latency, machine.architecture().stages)},
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
    facts.push_back({"device", c->device});
    facts.push_back({"area", fmt::format("{} LUT, {} FF, {} DSP, {} BRAM_18K", c->lut, c->ff, c->dsp, c->bram18)});
    if (c->fmax_mhz) facts.push_back({"clock", fmt::format("{:.1f} MHz", *c->fmax_mhz)});
    if (c->power_mw) facts.push_back({"power", fmt::format("{:.0f} mW, an estimate by resources", *c->power_mw)});
  }
  if (const auto ms = found.milliseconds()) facts.push_back({"time", fmt::format("{:.4g} ms", *ms)});
  return facts;
}

Json circuit_json(const FilterCircuit& circuit, const CircuitReport& found) {
  Json json{{"cycles", nullptr},   {"predicted_cycles", nullptr},
            {"compared", nullptr}, {"mismatches", nullptr},
            {"lut", nullptr},      {"ff", nullptr},
            {"dsp", nullptr},      {"bram18", nullptr},
            {"fmax_mhz", nullptr}, {"device", nullptr},
            {"power_mw", nullptr}};
  if (const auto& s = found.simulation)
    json.update(Json{{"cycles", s->agreement.cycles},
                     {"predicted_cycles", s->agreement.predicted_cycles},
                     {"compared", s->agreement.compared},
                     {"mismatches", s->agreement.mismatches}});
  if (const auto& c = found.cost)
    json.update(Json{{"lut", c->lut},
                     {"ff", c->ff},
                     {"dsp", c->dsp},
                     {"bram18", c->bram18},
                     {"fmax_mhz", or_null(c->fmax_mhz)},
                     {"device", c->device},
                     {"power_mw", or_null(c->power_mw)}});
  json["rmse"] = rmse_json(found);
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
