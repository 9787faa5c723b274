#include "mote/app/analog/power_report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/analog/behaviour.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;
using namespace analog;
using I = Implementation;

constexpr std::array<I, kImplementations> kAll{I::kMethod1, I::kMethod2, I::kDigital, I::kMethod3};
constexpr std::array<const char*, kImplementations> kKeys{"method1", "method2", "digital", "method3"};

/// Table III's currents, for which the paper's "about 20" is asked.
Load at_table3(Load load) {
  load.arctan_w = printed_arctan_power(table3_current(Function::kArctan));
  load.gaussian_w = printed_gaussian_power(table3_current(Function::kGaussian));
  return load;
}

Json power_of(const Power& power) { return {{"uw", 1e6 * power.watt}, {"macs", power.macs}}; }

std::string cell(const Power& power) {
  if (power.macs == 0) return power.watt == 0 ? "-" : fmt::format("{:.4g}", 1e6 * power.watt);
  const std::string macs = power.macs == 1 ? "P" : fmt::format("{:g} P", power.macs);
  return power.watt == 0 ? macs : fmt::format("{:.4g} + {}", 1e6 * power.watt, macs);
}

Json budget_json(const Load& load, I implementation) {
  const auto rows = table5(load);
  Json json{{"printed", power_of(overall(rows, implementation, true))},
            {"components", power_of(overall(rows, implementation, false))}};
  auto everything = rows;
  for (const Operation& row : left_out(load)) everything.push_back(row);
  for (const Operation& row : everything)
    json["rows"][row.name] = power_of(row.power[static_cast<std::size_t>(implementation)]);
  json["with_left_out"] = power_of(overall(everything, implementation, false));
  return json;
}

/// Ratios of digital to Method-2: by the printed table, at Table III's currents, with what Table V leaves out.
Json savings(const PowerRequest& request) {
  const auto rows = table5(request.load);
  const Load low = at_table3(request.load);
  const auto low_rows = table5(low);
  auto honest = low_rows;
  for (const Operation& row : left_out(low)) honest.push_back(row);
  const Power digital = overall(rows, I::kDigital, true);
  const Power printed = overall(rows, I::kMethod2, true);
  const Power table3 = overall(low_rows, I::kMethod2, false);
  const double most = most_mac_for_saving(digital, table3, 20);
  const auto [least_saving, most_saving] = saving_range(digital, printed);
  return {{"printed_least", least_saving},
          {"printed_most", most_saving},
          {"printed_reaches_20", most_mac_for_saving(digital, printed, 20) >= 0},
          {"printed_most_p_uw_for_20", 1e6 * most_mac_for_saving(digital, printed, 20)},
          {"table3_nonlinear_uw", 1e6 * low_rows[0].power[1].watt},
          {"table3_most_p_uw_for_20", 1e6 * most},
          {"table3_at_p", saving(digital, table3, request.mac_w)},
          {"table3_with_left_out_at_p",
           saving(overall(honest, I::kDigital, false), overall(honest, I::kMethod2, false), request.mac_w)}};
}

/// Energy and time at the circuit's rate, the CORDIC at its own clock as in Table V.
Json work_of(const PowerRequest& request, I implementation) {
  const double watt = overall(table5(request.load), implementation, false).at(request.mac_w);
  const double rate = implementation == I::kMethod1
                          ? std::min({request.load.rate_hz, request.load.dac.rate_hz, request.load.adc.rate_hz})
                          : request.load.rate_hz;
  const double step_s = request.particles / rate;
  return {{"nj_per_particle", 1e9 * watt / rate}, {"uj_per_step", 1e6 * watt * step_s}, {"ms_per_step", 1e3 * step_s}};
}

Json crossovers(const PowerRequest& request) {
  const auto at = [&](const Load& load, I analog) {
    const double rate = crossover(load, analog, I::kDigital, request.mac_w);
    return std::isnan(rate) ? Json(nullptr) : Json(rate);
  };
  Json json;
  for (const I implementation : {I::kMethod1, I::kMethod2, I::kMethod3}) {
    const char* key = kKeys[static_cast<std::size_t>(implementation)];
    json[key] = {{"at_these_currents", at(request.load, implementation)},
                 {"at_table3", at(at_table3(request.load), implementation)}};
  }
  return json;
}

report::Series line(const PowerRequest& request, const Load& load, I implementation, const std::string& name) {
  report::Series series{.name = name, .mark = report::Series::Mark::kLine};
  for (double exponent = 2; exponent <= 8.001; exponent += 0.05) {
    series.x.push_back(std::pow(10, exponent));
    series.y.push_back(1e6 * power_at_rate(load, implementation, series.x.back(), request.mac_w));
  }
  return series;
}

report::Table table_of(const std::string& title, const std::vector<Operation>& rows) {
  report::Table table{title, {"operation", "Method-1", "Method-2", "digital (ASIC)", "Method-3 (IMH)"}};
  const auto add = [&](const std::string& name, const auto& power) {
    std::vector<std::string> cells{name};
    for (const I implementation : kAll) cells.push_back(cell(power(implementation)));
    table.rows.push_back(std::move(cells));
  };
  for (const Operation& row : rows)
    add(row.name, [&](I implementation) { return row.power[static_cast<std::size_t>(implementation)]; });
  add("overall", [&](I implementation) { return overall(rows, implementation, false); });
  add("overall, rounded as the paper rounds", [&](I implementation) { return overall(rows, implementation, true); });
  return table;
}

std::string rate_words(const Json& rate) {
  return rate.is_null() ? "at no rate" : fmt::format("from {:.3g} particles/s on", rate.get<double>());
}

/// For which P twenty times hold: up to `most_uw`, below 0 for none.
std::string twenty_words(double most_uw) {
  return most_uw < 0 ? "never 20" : fmt::format("20 for P up to {:.1f} uW", most_uw);
}

std::vector<report::Fact> facts_of(const PowerRequest& request) {
  const Json json = power_json(request);
  const Json& s = json["saving"];
  const Json& c = json["crossover_hz"];
  std::vector<report::Fact> facts{
      {"P", fmt::format("{:.3g} uW", 1e6 * request.mac_w)},
      {"a circuit handles",
       fmt::format("{:.4g} particles/s{}", request.load.rate_hz,
                   request.simulated ? ", after which it has settled to half a step of 8 bits" : "")},
      {"CORDIC", fmt::format("{:.4g} uW each; in current-mode logic {:.4g} uW", json["table4"]["digital"].get<double>(),
                             json["table4"]["mcml"].get<double>())},
      {"Method-2 by Table V, rounded as the paper rounds",
       fmt::format("{:.3g} to {:.3g} times less than digital; {}", s["printed_least"].get<double>(),
                   s["printed_most"].get<double>(), twenty_words(s["printed_most_p_uw_for_20"]))},
      {"Method-2 at Table III's currents", fmt::format("{:.3g} times less at P; {}", s["table3_at_p"].get<double>(),
                                                       twenty_words(s["table3_most_p_uw_for_20"]))},
      {"with the ADC and the random numbers",
       fmt::format("{:.3g} times", s["table3_with_left_out_at_p"].get<double>())}};
  for (const char* key : {"method1", "method2", "method3"})
    facts.push_back({fmt::format("{} below a CORDIC clocked by the particles", key),
                     fmt::format("{}; at Table III's currents {}", rate_words(c[key]["at_these_currents"]),
                                 rate_words(c[key]["at_table3"]))});
  for (std::size_t k = 0; k < kImplementations; ++k) {
    const Json& w = json["work"][kKeys[k]];
    facts.push_back({name_of(kAll[k]), fmt::format("{:.3g} nJ a particle, {:.3g} uJ and {:.3g} ms a step of {}",
                                                   w["nj_per_particle"].get<double>(), w["uj_per_step"].get<double>(),
                                                   w["ms_per_step"].get<double>(), request.particles)});
  }
  return facts;
}

}  // namespace

Json power_json(const PowerRequest& request) {
  const Load& load = request.load;
  Json json{
      {"p_uw", 1e6 * request.mac_w},
      {"circuits", request.simulated ? "simulated" : "as printed"},
      {"table2",
       {{"arctan", {{"min", 1e6 * printed_arctan_power(0.5e-9)}, {"max", 1e6 * printed_arctan_power(20e-9)}}},
        {"gaussian", {{"min", 1e6 * printed_gaussian_power(0.1e-9)}, {"max", 1e6 * printed_gaussian_power(10e-9)}}}}},
      {"table4",
       {{"digital", 1e6 * cordic_power(load.process, load.bits, load.clock_hz)}, {"mcml", 1e6 * mcml_power()}}},
      {"saving", savings(request)},
      {"crossover_hz", crossovers(request)}};
  for (std::size_t k = 0; k < kImplementations; ++k) {
    json["table5"][kKeys[k]] = budget_json(load, kAll[k]);
    json["table5_at_table3"][kKeys[k]] = budget_json(at_table3(load), kAll[k]);
    json["work"][kKeys[k]] = work_of(request, kAll[k]);
  }
  for (const OtherCircuit& other : request.others)
    json["others"].push_back({{"name", other.name},
                              {"rate_hz", other.rate_hz},
                              {"power_uw", 1e6 * other.power_w},
                              {"nj_per_particle", 1e9 * other.power_w / other.rate_hz}});
  return json;
}

std::string power_text(const PowerRequest& request) {
  std::string text = "Table V from components, in uW\n";
  for (const auto& row : table_of("", table5(request.load)).rows)
    text += fmt::format("{:<40}{:>16}{:>16}{:>16}{:>16}\n", row[0], row[1], row[2], row[3], row[4]);
  for (const report::Fact& fact : facts_of(request)) text += fmt::format("{}: {}\n", fact.name, fact.value);
  return text;
}

report::Chart power_chart(const PowerRequest& request) {
  report::Chart chart{.title = "Power against the rate of particles", .x_label = "particles/s", .y_label = "uW"};
  chart.log_x = chart.log_y = true;
  for (const I implementation : kAll)
    chart.series.push_back(line(request, request.load, implementation, name_of(implementation)));
  for (const I implementation : {I::kMethod2, I::kMethod3})
    chart.series.push_back(
        line(request, at_table3(request.load), implementation, name_of(implementation) + ", Table III"));
  for (const OtherCircuit& other : request.others)
    chart.series.push_back(
        {.name = other.name, .mark = report::Series::Mark::kPoints, .x = {other.rate_hz}, .y = {1e6 * other.power_w}});
  return chart;
}

report::Page power_page(const PowerRequest& request, const std::string& command) {
  report::Page page;
  page.title = "Power of a particle filter, analog and digital";
  page.command = command;
  page.facts = facts_of(request);
  page.charts = {power_chart(request)};
  page.tables = {table_of("Table V from components (uW)", table5(request.load)),
                 table_of("The same at Table III's currents (uW)", table5(at_table3(request.load))),
                 table_of("What Table V leaves out (uW)", left_out(request.load))};
  page.notes = {
      "Digital parts of the chart are clocked by the particles; Table V clocks its CORDIC at 1 MHz whatever they are.",
      "Analog circuits take their power all the time; a rate above one circuit's needs copies side by side."};
  return page;
}

}  // namespace mote
