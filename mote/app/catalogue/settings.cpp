#include "mote/app/catalogue/settings.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

template <class T>
std::optional<T> whole(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string words_for(Range range) {
  switch (range) {
    case Range::kAny:
      return "a finite number";
    case Range::kPositive:
      return "a number above 0";
    case Range::kNotNegative:
      return "a number of at least 0";
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
  const auto value = whole<double>(*given);
  const bool fits = value && std::isfinite(*value) &&
                    (range == Range::kAny || *value > 0 || (range == Range::kNotNegative && *value == 0));
  if (!fits)
    throw Refusal(ExitCode::kWrongUse, {where_, "--set " + key, words_for(range), "\"" + *given + "\"",
                                        fmt::format("Its default is {}.", fallback)});
  return *value;
}

long Settings::integer(const std::string& key, long fallback, long least, long most) const {
  const auto given = text(key);
  if (!given) return fallback;
  const auto value = whole<long>(*given);
  if (!value || *value < least || *value > most)
    throw Refusal(ExitCode::kWrongUse, {where_, "--set " + key, fmt::format("an integer from {} to {}", least, most),
                                        "\"" + *given + "\"", fmt::format("Its default is {}.", fallback)});
  return *value;
}

void Settings::finish(const std::string& model, const std::string& known) const {
  for (std::size_t i = 0; i < given_.size(); ++i) {
    if (used_[i]) continue;
    throw Refusal(ExitCode::kWrongUse,
                  {where_, "--set " + given_[i].key, fmt::format("a parameter of {} ({})", model, known),
                   fmt::format("\"{}\"", given_[i].key), "See mote models."});
  }
}

}  // namespace mote
