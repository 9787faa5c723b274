#include <nlohmann/json.hpp>

#include "mote/app/analog/mixed_run.hpp"
#include "mote/app/commands/run.hpp"

namespace mote {
namespace {

nlohmann::json as_json(const analog::Design& design) {
  nlohmann::json json{
      {"method", static_cast<int>(design.method)}, {"dac_bits", design.dac.bits}, {"adc_bits", design.adc.bits}};
  for (const auto& circuit : {design.arctan, design.gaussian}) {
    if (!circuit) continue;
    const analog::Behaviour::Facts& facts = circuit->facts();
    json[analog::name_of(facts.function)] = {{"name", circuit->name()},
                                             {"ia_na", 1e9 * facts.ia_a},
                                             {"rms_percent", 100 * facts.rms},
                                             {"power_uw", 1e6 * facts.power_w},
                                             {"settling_us", 1e6 * facts.settling_s}};
  }
  return {{"analog", json}};
}

ExitCode run_analog(const Arguments& arguments) {
  return run_alone(arguments, [&](const Job& job, const Plan& plan) {
    const analog::Design design = design_from(arguments, *job.model);
    return OtherMachine{mixed_filter(*job.model, plan, design, arguments.where()),
                        "mixed-mode",
                        {{"analog parts", words_of(design)}},
                        as_json(design)};
  });
}

}  // namespace

Command analog_run_command() {
  std::vector<OptionSpec> options = run_file_options();
  for (OptionSpec& option : mixed_run_options()) options.push_back(std::move(option));
  return {"analog run",
          "Filter a recording by analog parts",
          {{"MODEL", "a model of the catalogue (see mote models), or a .toml file"}},
          std::move(options),
          run_analog,
          "Exit codes: 0 done, 2 wrong use, 3 bad data, 4 collapsed, 5 ngspice missing, 6 cannot write, 130 "
          "interrupted."};
}

}  // namespace mote
