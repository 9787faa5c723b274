#include "mote/app/reproduce/budgets.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "mote/app/analog/power_report.hpp"
#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {
namespace {

/// What stands at a path "table5/method1/printed/uw".
nlohmann::json found_at(const PowerRequest& request, const std::string& key) {
  const nlohmann::json all = power_json(request);
  const nlohmann::json::json_pointer place("/" + key);
  return all.contains(place) ? all.at(place) : nlohmann::json::object();
}

}  // namespace

Budgets::Budgets(const Item& item) {
  for (const Run& run : item.runs) {
    std::vector<std::string> words = *item.power;
    words.insert(words.end(), run.options.begin(), run.options.end());
    requests_.emplace_back(run.name, power_request_from(arguments_from(run.where, power_options(), words)));
  }
  for (const Comparison& c : item.comparisons)
    if (found_at(requests_.front().second, c.key).is_structured())
      throw Refusal(ExitCode::kBadData, {c.where, "\"key\"", "a path in the JSON of mote analog power to one value",
                                         "\"" + c.key + "\"", "table5/method1/printed/uw is one."});
}

double Budgets::figure(const Comparison& c, std::size_t side) const {
  const auto named = [&](const auto& entry) { return entry.first == c.runs[side]; };
  const auto value = found_at(std::find_if(requests_.begin(), requests_.end(), named)->second, c.key);
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  return value.is_number() ? value.get<double>() : kNaN;
}

report::Chart Budgets::chart(const Figure& figure) const {
  const auto drawn = [&](const auto& entry) { return figure.runs.empty() || entry.first == figure.runs.front(); };
  return power_chart(std::find_if(requests_.begin(), requests_.end(), drawn)->second);
}

}  // namespace mote::reproduce
