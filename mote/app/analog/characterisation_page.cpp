// A characterisation in words, tables and plots.

#include <fmt/format.h>

#include "mote/app/analog/characterisation.hpp"
#include "mote/app/analog/table2.hpp"
#include "mote/base/numbers.hpp"

namespace mote {
namespace {

using namespace analog;
using report::Chart;
using report::Series;
using report::Table;

constexpr int kDrawn = 400;  // steps over the input

std::string titled(Function function) { return function == Function::kArctan ? "arctan" : "Gaussian"; }

std::string level_name(Level level) { return level == Level::kIdeal ? "ideal" : "realistic"; }

std::vector<std::string> cells(const Behaviour& circuit) {
  const Behaviour::Facts& facts = circuit.facts();
  return {level_name(facts.level),
          fmt::format("{:g}", 1e9 * facts.ia_a),
          fmt::format("{:.3f}", 100 * facts.rms),
          fmt::format("{:.3f}", 100 * facts.worst),
          facts.function == Function::kArctan ? fmt::format("{:.3f}", facts.worst / kDegree) : "-",
          fmt::format("{:.4g}", 1e6 * facts.power_w),
          fmt::format("{:.4g}", 1e6 * facts.settling_s),
          fmt::format("{:.3g}", 1e-3 / facts.settling_s)};
}

Table table_of(const Characterisation& found, Function function) {
  const Printed& printed = printed_for(function);
  Table table{.title = titled(function),
              .columns = {"level", "I_a nA", "rms %", "max %", "max deg", "power uW", "settling us", "rate kHz"}};
  for (const Level level : {Level::kIdeal, Level::kRealistic})
    for (const Behaviour* circuit : found_circuits(found, function, level)) table.rows.push_back(cells(*circuit));
  for (const auto& [ia_na, power_uw] :
       {std::pair{printed.ia_na.front(), printed.least_power_uw}, {printed.ia_na.back(), printed.most_power_uw}})
    table.rows.push_back({"printed", fmt::format("{:g}", ia_na),
                          fmt::format("{:g} to {:g}", printed.least_error, printed.most_error), "-", "-",
                          fmt::format("{:g}", power_uw), "-", "10 to 100"});
  return table;
}

Chart errors_chart(const Characterisation& found, Function function) {
  Chart chart{.title = titled(function) + ": error of the output",
              .x_label = "input (I_a)",
              .y_label = function == Function::kArctan ? "output - arctan (rad)" : "output - exp(-x^2/2)"};
  const auto draw = [&](const Behaviour& circuit) {
    Series& series = chart.series.emplace_back(Series{.name = circuit.name()});
    for (int k = 0; k <= kDrawn; ++k) {
      const double x = kRange * (2.0 * k / kDrawn - 1);
      series.x.push_back(x);
      series.y.push_back(circuit(x) - exact(function, x));
    }
  };
  draw(*found_circuits(found, function, Level::kIdeal).front());
  for (const Behaviour* circuit : found_circuits(found, function, Level::kRealistic)) draw(*circuit);
  return chart;
}

Chart power_chart(const Characterisation& found) {
  Chart chart{.title = "Largest power over the input",
              .x_label = "I_a (nA)",
              .y_label = "power (uW)",
              .log_x = true,
              .log_y = true};
  for (const Printed& printed : table2()) {
    Series& ours =
        chart.series.emplace_back(Series{.name = titled(printed.function), .mark = Series::Mark::kMarkedLine});
    for (const Behaviour* circuit : found_circuits(found, printed.function, Level::kRealistic)) {
      ours.x.push_back(1e9 * circuit->facts().ia_a);
      ours.y.push_back(1e6 * circuit->facts().power_w);
    }
    chart.series.push_back({.name = titled(printed.function) + ", printed",
                            .mark = Series::Mark::kPoints,
                            .x = {printed.ia_na.front(), printed.ia_na.back()},
                            .y = {printed.least_power_uw, printed.most_power_uw}});
  }
  return chart;
}

Chart weights_chart(const WeightCurve& curve) {
  Chart chart{.title = fmt::format("Weights at sigma_r = {:g} deg", curve.sigma_rad / kDegree),
              .x_label = "bearing of the particle (deg)",
              .y_label = "weight"};
  std::vector<double> bearing_deg = curve.bearing_rad;
  for (double& bearing : bearing_deg) bearing /= kDegree;
  chart.series = {{.name = "true", .x = bearing_deg, .y = curve.exact},
                  {.name = "approximation", .x = bearing_deg, .y = curve.approximation},
                  {.name = "analog", .x = bearing_deg, .y = curve.analog}};
  return chart;
}

Chart dies_chart(const Characterisation& found) {
  Chart chart{.title = "Dies by their error", .x_label = "rms error (%)", .y_label = "share of dies", .log_x = true};
  for (const DiesFound& dies : found.dies) {
    Series& series =
        chart.series.emplace_back(Series{.name = fmt::format("{}, I_a {:g} nA, {}", titled(dies.function),
                                                             1e9 * dies.ia_a, dies.trimmed ? "trimmed" : "as made"),
                                         .mark = Series::Mark::kSteps});
    for (std::size_t k = 0; k < dies.dies.rms.size(); ++k) {
      series.x.push_back(100 * dies.dies.rms[k]);
      series.y.push_back(static_cast<double>(k + 1) / static_cast<double>(dies.dies.rms.size()));
    }
  }
  return chart;
}

std::string weights_line(const WeightCurve& curve) {
  const double shift = std::abs(curve.analog_shift_rad);
  return fmt::format("{:.3f} deg = {:.3f} sigma_r at sigma_r = {:g} deg", shift / kDegree, shift / curve.sigma_rad,
                     curve.sigma_rad / kDegree);
}

std::string dies_line(const DiesFound& found) {
  return fmt::format("{}, I_a {:g} nA, {:<8} median {:.2f} %, yield {:.0f} % within {:g} %", titled(found.function),
                     1e9 * found.ia_a, found.trimmed ? "trimmed:" : "as made:", 100 * found.dies.quantile(0.5),
                     100 * found.dies.yield(printed_for(found.function).most_error / 100),
                     printed_for(found.function).most_error);
}

}  // namespace

std::string characterisation_text(const Characterisation& found) {
  std::string text;
  for (const Printed& printed : table2()) {
    const Table table = table_of(found, printed.function);
    text += fmt::format("{:<10}{:>8}{:>14}{:>9}{:>9}{:>10}{:>13}{:>11}\n", table.title, "I_a nA", "rms %", "max %",
                        "max deg", "power uW", "settling us", "rate kHz");
    for (const auto& row : table.rows)
      text += fmt::format("{:<10}{:>8}{:>14}{:>9}{:>9}{:>10}{:>13}{:>11}\n", row[0], row[1], row[2], row[3], row[4],
                          row[5], row[6], row[7]);
  }
  for (const WeightCurve& curve : found.weights) text += "mode of the weights shifted by " + weights_line(curve) + "\n";
  for (const DiesFound& dies : found.dies) text += dies_line(dies) + "\n";
  return text;
}

report::Page characterisation_page(const Characterisation& found) {
  report::Page page{.title = "Analog arctan and Gaussian"};
  page.summary = fmt::format(
      "MITE networks simulated by ngspice at {:g} V and {:g} degrees C, the input from -10 I_a to "
      "+10 I_a.",
      found.request.conditions.supply_v, found.request.conditions.temperature_c);
  for (const Printed& printed : table2()) page.charts.push_back(errors_chart(found, printed.function));
  page.charts.push_back(power_chart(found));
  for (const WeightCurve& curve : found.weights) {
    page.charts.push_back(weights_chart(curve));
    page.facts.push_back({"Shift of the mode", weights_line(curve)});
  }
  if (!found.dies.empty()) page.charts.push_back(dies_chart(found));
  for (const DiesFound& dies : found.dies) page.facts.push_back({"Dies", dies_line(dies)});
  for (const Printed& printed : table2()) page.tables.push_back(table_of(found, printed.function));
  page.notes = {"Errors in percent of 1 rad (arctan, I_a is 1 rad) and of the peak (Gaussian).",
                "Power: the largest over the input, mirrors, bias and reference included.",
                "Settling: after a step of the input between 0 and I_a, until the output is within 1/512 of I_a."};
  return page;
}

}  // namespace mote
