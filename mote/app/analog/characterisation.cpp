#include "mote/app/analog/characterisation.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/analog/table2.hpp"
#include "mote/base/numbers.hpp"

namespace mote {
namespace {

using namespace analog;
using Json = nlohmann::json;

/// In nA, as it was asked for: without the rounding of a factor 1e-9.
double nanoampere(double ia_a) { return std::round(1e15 * ia_a) / 1e6; }

struct Work {
  Function function;
  Level level;
  double ia_a;
};

std::vector<Work> table_of_work() {
  std::vector<Work> work;
  for (const Printed& printed : table2())
    for (const Level level : {Level::kIdeal, Level::kRealistic})
      for (const double ia_na : printed.ia_na) work.push_back({printed.function, level, 1e-9 * ia_na});
  return work;
}

Json row_json(const Behaviour& circuit) {
  const Behaviour::Facts& facts = circuit.facts();
  Json row{{"ia_na", nanoampere(facts.ia_a)},         {"rms_percent", 100 * facts.rms},
           {"max_percent", 100 * facts.worst},        {"power_uw", 1e6 * facts.power_w},
           {"settling_us", 1e6 * facts.settling_s},   {"rate_khz", 1e-3 / facts.settling_s},
           {"residual_percent", 100 * facts.residual}};
  if (facts.function == Function::kArctan) row["max_deg"] = facts.worst / kDegree;
  return row;
}

Json rows_json(const Characterisation& found, Function function, Level level) {
  Json rows = Json::array();
  for (const Behaviour* circuit : found_circuits(found, function, level)) rows.push_back(row_json(*circuit));
  return rows;
}

/// The least and the most of a figure over the rows, and whether the ideal level's error is below at every I_a.
Json range_json(const Json& rows, const Json& ideal) {
  Json range{{"ideal_better", true}};
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (ideal[k]["rms_percent"] >= rows[k]["rms_percent"]) range["ideal_better"] = false;
  for (const char* key : {"rms_percent", "max_percent", "power_uw", "rate_khz"}) {
    std::vector<double> values;
    for (const Json& row : rows) values.push_back(row[key]);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    range[key] = {{"least", *least}, {"most", *most}};
  }
  return range;
}

Json tracker_json(const Behaviour& circuit) {
  Json row = row_json(circuit);
  const double x = circuit.facts().function == Function::kArctan ? std::tan(kTrueBearing_deg * kDegree) : 0;
  row["noise_percent"] = 100 * circuit.noise_sd(x);
  row["bandwidth_khz"] = 1e-3 * circuit.facts().bandwidth_hz;
  return row;
}

Json weights_json(const WeightCurve& curve) {
  const double shift = std::abs(curve.analog_shift_rad);
  return {{"sigma_deg", curve.sigma_rad / kDegree},
          {"shift_deg", shift / kDegree},
          {"shift_sigma", shift / curve.sigma_rad},
          {"approximation_shift_deg", std::abs(curve.approximation_shift_rad) / kDegree}};
}

Json dies_json(const DiesFound& found) {
  return {{"circuit", name_of(found.function)},
          {"ia_na", nanoampere(found.ia_a)},
          {"trimmed", found.trimmed},
          {"count", found.dies.rms.size()},
          {"median_percent", 100 * found.dies.quantile(0.5)},
          {"p90_percent", 100 * found.dies.quantile(0.9)},
          {"limit_percent", printed_for(found.function).most_error},
          {"yield", found.dies.yield(printed_for(found.function).most_error / 100)}};
}

}  // namespace

std::vector<const Behaviour*> found_circuits(const Characterisation& found, Function function, Level level) {
  std::vector<const Behaviour*> circuits;
  for (const Behaviour& circuit : found.circuits)
    if (circuit.facts().function == function && circuit.facts().level == level) circuits.push_back(&circuit);
  return circuits;
}

std::vector<OptionSpec> characterise_options() {
  return {{"--temperature", "C", "27", "degrees Celsius, from -40 to 125", "Circuit"},
          {"--supply", "V", "3", "volt, from 2.5 to 5.5", "Circuit"},
          {"--dies", "N", "50", "dies whose devices differ, from 0 to 10000", "Circuit"},
          {"--seed", "S", "1", "which dies", "Circuit"}};
}

CharacteriseRequest characterise_request_from(const Arguments& arguments) {
  CharacteriseRequest request;
  request.conditions.temperature_c = arguments.number("--temperature", -40, 125);
  request.conditions.supply_v = arguments.number("--supply", 2.5, 5.5);
  request.dies = static_cast<std::uint32_t>(arguments.integer("--dies", 0, 10'000));
  request.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, INT64_MAX));
  return request;
}

Characterisation characterisation(const CharacteriseRequest& request,
                                  const std::function<void(std::size_t, std::size_t)>& done) {
  Characterisation found{request, {}, {}, {}, {}};
  const std::vector<Work> table = table_of_work();
  const std::size_t all =
      table.size() + 2 * table2().size() + kSigmas_deg.size() + (request.dies > 0 ? 2 * table2().size() : 0);
  std::size_t so_far = 0;
  const auto next = [&] { done(++so_far, all); };
  for (const Work& work : table) {
    found.circuits.push_back(
        characterised(work.function, work.ia_a, work.level, request.conditions, Detail::kTransfer));
    next();
  }
  for (const Printed& printed : table2()) {
    found.trackers.push_back(
        characterised(printed.function, table3_current(printed.function), Level::kRealistic, request.conditions));
    next();
  }
  for (const double sigma_deg : kSigmas_deg) {
    const double ia_a = table3_current(Function::kGaussian) * sigma_deg / kSigmas_deg.front();
    const Behaviour gaussian =
        characterised(Function::kGaussian, ia_a, Level::kRealistic, request.conditions, Detail::kTransfer);
    found.weights.push_back(
        weight_curve(found.trackers.front(), gaussian, kTrueBearing_deg * kDegree, sigma_deg * kDegree));
    next();
  }
  for (const Printed& printed : table2())
    for (const bool trimmed : {true, false}) {
      if (request.dies == 0) continue;
      Conditions conditions = request.conditions;
      conditions.trimmed = trimmed;
      const double ia_a = table3_current(printed.function);
      found.dies.push_back({printed.function, ia_a, trimmed,
                            simulated_dies(printed.function, ia_a, conditions, request.seed, request.dies)});
      next();
    }
  return found;
}

Json characterisation_json(const Characterisation& found) {
  Json all{{"conditions",
            {{"temperature_c", found.request.conditions.temperature_c},
             {"supply_v", found.request.conditions.supply_v},
             {"seed", found.request.seed}}},
           {"ideal", Json::object()},
           {"range", Json::object()},
           {"tracker", Json::object()},
           {"weights", Json::array()},
           {"dies", Json::array()}};
  for (const Printed& printed : table2()) {
    const std::string name = name_of(printed.function);
    all[name] = rows_json(found, printed.function, Level::kRealistic);
    all["ideal"][name] = rows_json(found, printed.function, Level::kIdeal);
    all["range"][name] = range_json(all[name], all["ideal"][name]);
  }
  for (const Behaviour& circuit : found.trackers)
    all["tracker"][name_of(circuit.facts().function)] = tracker_json(circuit);
  for (const WeightCurve& curve : found.weights) all["weights"].push_back(weights_json(curve));
  for (const DiesFound& dies : found.dies) all["dies"].push_back(dies_json(dies));
  return all;
}

}  // namespace mote
