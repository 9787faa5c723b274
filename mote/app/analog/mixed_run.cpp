#include "mote/app/analog/mixed_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "mote/analog/placement.hpp"
#include "mote/app/analog/circuit_words.hpp"
#include "mote/app/catalogue/settings.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using analog::Cells;
using analog::Design;

/// An error of a part, as --part takes it.
struct PartError {
  std::string_view name;
  double Cells::*value;
  Range range;
};
constexpr std::array<PartError, 9> kParts{{{"divider_gain", &Cells::divider_gain, Range::kFraction},
                                           {"product_gain", &Cells::product_gain, Range::kFraction},
                                           {"memory_error", &Cells::memory_error, Range::kFraction},
                                           {"memory_leak", &Cells::memory_leak, Range::kFraction},
                                           {"source_gain", &Cells::source_gain, Range::kFraction},
                                           {"source_clip", &Cells::source_clip, Range::kPositive},
                                           {"multiplier_gain", &Cells::multiplier_gain, Range::kFraction},
                                           {"squarer_gain", &Cells::squarer_gain, Range::kFraction},
                                           {"comparator_noise", &Cells::comparator_noise, Range::kNotNegative}}};

std::string part_words() {
  std::string words;
  for (const PartError& part : kParts)
    words += fmt::format("{}{} [{:g}]", words.empty() ? "" : ", ", part.name, Cells{}.*part.value);
  return words;
}

const PartError& part_named(std::string_view name, const std::string& where) {
  for (const PartError& part : kParts)
    if (part.name == name) return part;
  throw Refusal(ExitCode::kWrongUse, {where, "--part", "NAME=VALUE with one of " + part_words(), in_quotes(name),
                                      "Pass for example --part memory_leak=0.001."});
}

Cells cells_from(const Arguments& arguments) {
  Cells cells;
  std::vector<std::string_view> given;
  for (const std::string& text : arguments.list("--part")) {
    const std::size_t sign = text.find('=');
    const PartError& part = part_named(std::string_view(text).substr(0, sign), arguments.where());
    const std::string_view digits = sign == std::string::npos ? "" : std::string_view(text).substr(sign + 1);
    const auto value = number_in(digits);
    const bool fits = value && std::isfinite(*value) && *value >= 0 && (part.range != Range::kPositive || *value > 0) &&
                      (part.range != Range::kFraction || *value < 1);
    if (!fits)
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), fmt::format("--part {}", part.name), words_for(part.range),
                                          in_quotes(digits), fmt::format("Its default is {:g}.", Cells{}.*part.value)});
    if (std::find(given.begin(), given.end(), part.name) != given.end())
      throw Refusal(ExitCode::kWrongUse,
                    {arguments.where(), fmt::format("--part {}", part.name), "one value", "two", "Pass it once."});
    given.push_back(part.name);
    cells.*part.value = *value;
  }
  return cells;
}

/// The circuits that a model has a use for by a method.
AnalogWords whole(const CatalogueModel& model, analog::Method method) {
  const analog::Wanted has = analog::functions_of(model.recorded(), method);
  const auto circuit = [](analog::Function function) {
    return CircuitWords{analog::Level::kRealistic, analog::table3_current(function)};
  };
  AnalogWords words;
  if (has.arctan) words.arctan = circuit(analog::Function::kArctan);
  if (has.gaussian) words.gaussian = circuit(analog::Function::kGaussian);
  return words;
}

/// The circuits that the options ask for.
///
/// error   Refusal (kWrongUse) for a Gaussian where there is none
AnalogWords words_from(const Arguments& arguments, const CatalogueModel& model, analog::Method method) {
  if (!arguments.given("--analog")) return whole(model, method);
  AnalogWords words = analog_words(arguments.text("--analog"), arguments.where());
  if (words.gaussian && method == analog::Method::kAllButRandom)
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--analog", "arctan alone with --method 3",
                                        "a Gaussian, which it does not have", "Leave gaussian out of --analog."});
  return words;
}

void set_bits(analog::ConverterSheet& sheet, const Arguments& arguments, const std::string& option) {
  if (!arguments.given(option)) return;
  sheet = analog::with_bits(sheet, static_cast<int>(arguments.integer(option, 0, analog::kMostBits)));
}

}  // namespace

std::vector<OptionSpec> mixed_options() {
  const std::string group = "Analog parts";
  return {
      {"--analog", "LIST", "",
       "circuits, as arctan=mite:Ia=10n,gaussian=mite:Ia=0.1n; mite or ideal; the rest is digital [all that the model "
       "has a use for]",
       group},
      {"--method", "M", "1",
       "1 = weights are analog, between DAC and ADC; 2 = all but the choice of ancestors; 3 = IMH without a Gaussian",
       group},
      {"--dac-bits", "B", "10", "bits of the DAC, from 0 (none there) to 16; method 1", group},
      {"--adc-bits", "B", "8", "bits of the ADC, from 0 (none there) to 16; methods 1 and 2", group},
      {"--calibrate", "HOW", "none",
       "none; transfer = the measurement goes through the measured arctangent, too; inflate = a Gaussian wider by the "
       "arctangent's error",
       group},
      {"--die", "K", "0", "die whose devices differ as Pelgrom's law says, by number; 0 = the typical one", group},
      {"--arctan-error", "PERCENT", "100", "scale of the arctangent's error, to ask what a better circuit would do",
       group},
      {"--noise", "PERCENT", "100", "scale of the circuits' noise; 0 = steady states, as MIXED simulates them", group},
      {"--part", "NAME=VALUE", "", "error of other parts, methods 2 and 3; may be repeated: " + part_words(), group,
       true},
  };
}

std::vector<OptionSpec> mixed_run_options() {
  std::vector<OptionSpec> options = mixed_options();
  for (OptionSpec& option : plan_options()) options.push_back(std::move(option));
  return options;
}

Design design_from(const Arguments& arguments, const CatalogueModel& model) {
  Design design;
  design.method = static_cast<analog::Method>(arguments.choice("--method", {"1", "2", "3"}) + 1);
  design.calibration =
      static_cast<analog::Calibration>(arguments.choice("--calibrate", {"none", "transfer", "inflate"}));
  set_bits(design.dac, arguments, "--dac-bits");
  set_bits(design.adc, arguments, "--adc-bits");
  design.cells = cells_from(arguments);
  const auto die = static_cast<std::uint32_t>(arguments.integer("--die", 0, 1'000'000));
  design.seed = die;
  const double error = arguments.number("--arctan-error", 0, 10'000) / 100;
  const double noise = arguments.number("--noise", 0, 10'000) / 100;
  const AnalogWords words = words_from(arguments, model, design.method);
  const auto made = [&](analog::Function function, const CircuitWords& circuit) {
    const analog::Behaviour& typical = circuit_behaviour(function, circuit);
    const analog::Behaviour one = die == 0 ? typical : typical.on_die(design.seed, die);
    const double of_this = function == analog::Function::kArctan ? error : 1;
    return of_this == 1 && noise == 1 ? one : analog::scaled(one, of_this, noise);
  };
  if (words.arctan) design.arctan = made(analog::Function::kArctan, *words.arctan);
  if (words.gaussian) design.gaussian = made(analog::Function::kGaussian, *words.gaussian);
  return design;
}

std::unique_ptr<Filter> mixed_filter(const CatalogueModel& model, const Plan& plan, const Design& design,
                                     const std::string& where) {
  return analog::make_mixed_filter(model.recorded(), plan, design, where);
}

std::string words_of(const Design& design) {
  std::string words = fmt::format("Method-{}", static_cast<int>(design.method));
  for (const auto& circuit : {design.arctan, design.gaussian})
    if (circuit) words += "; " + circuit->name();
  if (design.method == analog::Method::kWeights) words += fmt::format("; DAC {} bits", design.dac.bits);
  if (design.method != analog::Method::kAllButRandom) words += fmt::format("; ADC {} bits", design.adc.bits);
  return words;
}

}  // namespace mote
