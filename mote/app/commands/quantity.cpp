#include "mote/app/commands/quantity.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

constexpr Unit kShown[] = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};  // the largest first

std::string names_of(std::span<const Unit> units) {
  std::string names;
  for (const Unit& unit : units) names += (names.empty() ? "" : ", ") + std::string(unit.name);
  return names;
}

}  // namespace

double quantity_from(const Arguments& arguments, const std::string& option, std::span<const Unit> units,
                     const std::string& example) {
  const std::string given = arguments.text(option);
  const std::string_view text = trimmed(given);
  const std::size_t end = text.find_last_of("0123456789.") + 1;  // npos + 1 = 0
  const auto number = number_in(trimmed(text.substr(0, end)));
  const auto unit =
      std::find_if(units.begin(), units.end(), [&](const Unit& one) { return one.name == trimmed(text.substr(end)); });
  if (!number || unit == units.end() || !(*number > 0) || !std::isfinite(*number * unit->size))
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), option, "a number above 0 with its unit (" + names_of(units) + ")",
                   in_quotes(given), "Pass " + option + " " + example + "."});
  return *number * unit->size;
}

std::string in_units(double seconds) {
  const Unit* shown = std::begin(kShown);
  while (shown + 1 != std::end(kShown) && seconds < 0.9995 * shown->size) ++shown;  // 999.5 us is shown as 1 ms
  return fmt::format("{:.3g} {}", seconds / shown->size, shown->name);
}

}  // namespace mote
