#include "mote/app/analog/circuit_words.hpp"

#include <map>
#include <tuple>

#include "mote/analog/characterise.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

constexpr const char* kExample = "Pass --analog arctan=mite:Ia=10n,gaussian=mite:Ia=0.1n.";

[[noreturn]] void refuse(const std::string& where, const std::string& expected, std::string_view got) {
  throw Refusal(ExitCode::kWrongUse, {where, "--analog", expected, in_quotes(got), kExample});
}

/// "10n" in ampere.
double current_from(std::string_view text, const std::string& where) {
  double unit = 1;
  std::string_view digits = text;
  if (!digits.empty() && !digits.ends_with('.') && (digits.back() < '0' || digits.back() > '9')) {
    const char letter = digits.back();
    unit = letter == 'p' ? 1e-12 : letter == 'n' ? 1e-9 : letter == 'u' ? 1e-6 : 0;
    digits.remove_suffix(1);
  }
  const auto number = number_in(digits);
  if (!number || !(*number * unit > 0)) refuse(where, "a current above 0 with p, n or u behind it", text);
  return *number * unit;
}

CircuitWords circuit_from(std::string_view text, double ia_a, const std::string& where) {
  const auto parts = parts_of(text, ':');
  CircuitWords circuit{analog::Level::kRealistic, ia_a};
  if (parts[0] == "ideal") {
    circuit.level = analog::Level::kIdeal;
  } else if (parts[0] != "mite") {
    refuse(where, "mite (transistors) or ideal (the MITE law)", parts[0]);
  }
  if (parts.size() == 1) return circuit;
  if (parts.size() > 2 || !parts[1].starts_with("Ia=")) refuse(where, "KIND or KIND:Ia=CURRENT", text);
  circuit.ia_a = current_from(parts[1].substr(3), where);
  return circuit;
}

}  // namespace

AnalogWords analog_words(const std::string& text, const std::string& where) {
  AnalogWords words;
  for (const std::string_view part : parts_of(text, ',')) {
    const std::size_t equals = part.find('=');
    const std::string_view name = part.substr(0, equals);
    if (equals == std::string_view::npos || (name != "arctan" && name != "gaussian"))
      refuse(where, "arctan=... and gaussian=..., each at most once", part);
    const analog::Function function = name == "arctan" ? analog::Function::kArctan : analog::Function::kGaussian;
    auto& circuit = name == "arctan" ? words.arctan : words.gaussian;
    if (circuit) refuse(where, "arctan=... and gaussian=..., each at most once", part);
    circuit = circuit_from(part.substr(equals + 1), analog::table3_current(function), where);
  }
  return words;
}

const analog::Behaviour& circuit_behaviour(analog::Function function, const CircuitWords& words) {
  static std::map<std::tuple<analog::Function, analog::Level, double>, analog::Behaviour> known;
  const auto key = std::tuple(function, words.level, words.ia_a);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known.emplace(key, analog::characterised(function, words.ia_a, words.level)).first->second;
}

}  // namespace mote
