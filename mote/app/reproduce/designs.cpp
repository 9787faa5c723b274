#include "mote/app/reproduce/designs.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

/// What stands at a path "cases/A/time".
nlohmann::json found_at(const DesignReport& report, const std::string& key) {
  const nlohmann::json all = design_json(report);
  const nlohmann::json::json_pointer place("/" + key);
  return all.contains(place) ? all.at(place) : nlohmann::json::object();
}

}  // namespace

Designs::Designs(const Item& item) {
  for (const Run& run : item.runs) {
    std::vector<std::string> words = *item.design;
    words.insert(words.end(), run.options.begin(), run.options.end());
    reports_.emplace_back(run.name,
                          design_report(design_request_from(arguments_from(run.where, design_options(), words))));
  }
  for (const Comparison& c : item.comparisons)
    if (const auto value = found_at(reports_.front().second, c.key); value.is_structured())
      throw Refusal(ExitCode::kBadData, {c.where, "\"key\"", "a path in the JSON of mote design optimise to one value",
                                         "\"" + c.key + "\"", "cases/A/time is one."});
}

double Designs::figure(const Comparison& c, std::size_t side) const {
  const auto named = [&](const auto& entry) { return entry.first == c.runs[side]; };
  const auto value = found_at(std::find_if(reports_.begin(), reports_.end(), named)->second, c.key);
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  return value.is_number() ? value.get<double>() : kNaN;
}

std::vector<DesignCurve> Designs::curves(const Figure& figure) const {
  std::vector<DesignCurve> all;
  const bool pairs = figure.quantity == kDesignFigures[0];
  for (const auto& [name, report] : reports_) {
    if (!figure.runs.empty() && std::find(figure.runs.begin(), figure.runs.end(), name) == figure.runs.end()) continue;
    const design::Demand& d = report.request.demand;
    const double n = d.proposals(1);
    DesignCurve curve{name};
    for (int r = 1; r <= figure.repeats; ++r) {
      const auto count = static_cast<std::size_t>(r);
      curve.blocks.push_back(r);
      curve.exact.push_back(design::makespan(design::line_of(d, pairs ? count : 1, count, 1)));
      curve.law.push_back(pairs ? paired_time(n, r, d.times, {d.times.propose, d.times.weigh})
                                : single_chain_time(n, d.times, 1, r));
    }
    all.push_back(std::move(curve));
  }
  return all;
}

}  // namespace mote::reproduce
