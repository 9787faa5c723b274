#include "mote/app/reproduce/answers.hpp"

#include <nlohmann/json.hpp>

#include "mote/base/numbers.hpp"
#include "mote/base/refusal.hpp"

namespace mote::reproduce {

double answer_at(const nlohmann::json& json, const Comparison& comparison, const std::string& command,
                 const std::string& example) {
  const nlohmann::json::json_pointer place("/" + comparison.key);
  if (json.contains(place)) {
    const nlohmann::json& value = json.at(place);
    if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
    if (value.is_number()) return value.get<double>();
    if (value.is_null()) return kNaN;
  }
  throw Refusal(ExitCode::kBadData, {comparison.where, "\"key\"", "a path in the JSON of " + command + " to one value",
                                     "\"" + comparison.key + "\"", example + " is one."});
}

}  // namespace mote::reproduce
