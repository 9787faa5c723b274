#include "mote/app/catalogue/settings.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/app/terminal/suggestion.hpp"
#include "mote/base/refusal.hpp"

namespace mote {

std::string words_for(Range range) {
  switch (range) {
    case Range::kAny:
      return "a finite number";
    case Range::kPositive:
      return "a number above 0";
    case Range::kNotNegative:
      return "a number of at least 0";
    case Range::kFraction:
      return "a number of at least 0 and below 1";
  }
  return "";
}

Settings::Settings(std::string where, const std::vector<std::string>& texts) : where_(std::move(where)) {
  for (const std::string& text : texts) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos || sign == 0)
      throw Refusal(ExitCode::kWrongUse,
                    {where_, "--set", "name=value", "\"" + text + "\"", "Pass for example --set q=10."});
    const std::string key = text.substr(0, sign);
    for (const Given& other : given_)
      if (other.key == key)
        throw Refusal(ExitCode::kWrongUse,
                      {where_, "--set " + key, "one value",
                       "two: \"" + other.value + "\" and \"" + text.substr(sign + 1) + "\"", "Pass it once."});
    given_.push_back({key, text.substr(sign + 1)});
  }
  used_.resize(given_.size());
}

std::optional<std::string> Settings::text(const std::string& key) const {
  for (std::size_t i = 0; i < given_.size(); ++i) {
    if (given_[i].key != key) continue;
    used_[i] = true;
    return given_[i].value;
  }
  return std::nullopt;
}

double Settings::number(const std::string& key, double fallback, Range range) const {
  const auto given = text(key);
  if (!given) return fallback;
  const auto value = number_in(*given);
  const bool fits = value && std::isfinite(*value) &&
                    (range == Range::kAny || *value > 0 || (range != Range::kPositive && *value == 0)) &&
                    (range != Range::kFraction || *value < 1);
  if (!fits)
    throw Refusal(ExitCode::kWrongUse, {where_, "--set " + key, words_for(range), "\"" + *given + "\"",
                                        fmt::format("Its default is {}.", fallback)});
  return *value;
}

long Settings::integer(const std::string& key, long fallback, long least, long most) const {
  const auto given = text(key);
  if (!given) return fallback;
  const auto value = integer_in(*given);
  if (!value || *value < least || *value > most)
    throw Refusal(ExitCode::kWrongUse, {where_, "--set " + key, fmt::format("an integer from {} to {}", least, most),
                                        "\"" + *given + "\"", fmt::format("Its default is {}.", fallback)});
  return static_cast<long>(*value);
}

void Settings::finish(const std::string& model, const std::vector<std::string>& known) const {
  for (std::size_t i = 0; i < given_.size(); ++i)
    if (!used_[i])
      throw Refusal(ExitCode::kWrongUse,
                    {where_, "--set", fmt::format("a parameter of {} ({})", model, fmt::join(known, ", ")),
                     "\"" + given_[i].key + "\"", hint(given_[i].key, known, "See mote models " + model + ".")});
}

}  // namespace mote
