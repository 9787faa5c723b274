#include "mote/app/analog/power_request.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/analog/circuit_words.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using Json = nlohmann::json;

/// The paper's filter on an FPGA, of the paper FPGA: 1000 particles, 50 steps in 7.57 ms at 2434 mW.
const OtherCircuit kPrinted{"FPGA as printed (XA7A100T)", 1000 * 50 / 7.57e-3, 2.434};

/// The figures of `mote rtl --json`: energy of a step over power is its time.
OtherCircuit circuit_from(const std::string& path, int particles) {
  const Json json = Json::parse(read_text(path), nullptr, false);
  const auto number = [&](const char* key) {
    const bool has = json.is_object() && json.contains(key) && json[key].is_number() && json[key].get<double>() > 0;
    if (!has)
      throw Refusal(ExitCode::kBadData, {path, fmt::format("\"{}\"", key), "a number above 0", "none",
                                         "Write it by mote rtl MODEL --simulate obs.csv --synth xc7 --json."});
    return json[key].get<double>();
  };
  const double watt = 1e-3 * number("power_mw");
  return {path, particles * watt / (1e-6 * number("uj_per_step")), watt};
}

/// Takes power and time from simulated circuits, which settle one after the other.
void simulate(PowerRequest& request) {
  const auto facts = [](analog::Function function, double ia_a) {
    return circuit_behaviour(function, {analog::Level::kRealistic, ia_a}).facts();
  };
  const auto arctan = facts(analog::Function::kArctan, request.ia_arctan_a);
  const auto gaussian = facts(analog::Function::kGaussian, request.ia_gaussian_a);
  request.load.arctan_w = arctan.power_w;
  request.load.gaussian_w = gaussian.power_w;
  request.load.rate_hz = 1 / (arctan.settling_s + gaussian.settling_s);
}

}  // namespace

std::vector<OptionSpec> power_options() {
  const std::string circuits = "Circuits";
  const std::string digital = "Digital";
  const std::string load = "Load";
  return {
      {"--ia-arctan", "NA", "10", "I_a of the arctangent in nA, from 0.001 to 1000", circuits},
      {"--ia-gaussian", "NA", "10", "I_a of the Gaussian in nA, from 0.001 to 1000; Table III has 0.1", circuits},
      {"--simulated", "", "", "take the circuits' power and rate from a simulation, in place of Table II and --rate",
       circuits},
      {"--node", "UM", "0.35", "process of the CORDIC in um, from 0.005 to 10", digital},
      {"--vdd", "V", "3.3", "its supply in V, from 0.1 to 10", digital},
      {"--clock", "MHZ", "1", "its clock in MHz, from 0.000001 to 10000", digital},
      {"--bits", "B", "12", "its bits, from 2 to 64", digital},
      {"--rate", "HZ", "31622.8", "particles a second of a circuit, from 1 to 1e9; the paper says 10 to 100 kHz", load},
      {"--mac", "UW", "", "P of an analog multiply-accumulate in uW, from 0 [a tenth of 17 adders of 16 bits]", load},
      {"-n,--particles", "N", "1000", "particles of a step, from 1 to 268435456", load},
      {"--fpga", "FILE", "",
       "JSON of mote rtl with power_mw and uj_per_step, of a filter of N particles; may be "
       "repeated [none]",
       load, true}};
}

PowerRequest power_request_from(const Arguments& arguments) {
  PowerRequest request;
  request.ia_arctan_a = 1e-9 * arguments.number("--ia-arctan", 1e-3, 1e3);
  request.ia_gaussian_a = 1e-9 * arguments.number("--ia-gaussian", 1e-3, 1e3);
  request.simulated = arguments.given("--simulated");
  if (request.simulated && arguments.given("--rate"))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--rate", "none beside --simulated, which finds the rate",
                                        arguments.text("--rate"), "Leave one of them out."});
  analog::Load& load = request.load;
  load.arctan_w = analog::printed_arctan_power(request.ia_arctan_a);
  load.gaussian_w = analog::printed_gaussian_power(request.ia_gaussian_a);
  if (request.simulated) simulate(request);
  load.process = {arguments.number("--node", 0.005, 10), arguments.number("--vdd", 0.1, 10)};
  load.clock_hz = 1e6 * arguments.number("--clock", 1e-6, 1e4);
  load.bits = static_cast<int>(arguments.integer("--bits", 2, 64));
  if (arguments.given("--rate")) load.rate_hz = arguments.number("--rate", 1, 1e9);
  request.mac_w = arguments.given("--mac") ? 1e-6 * arguments.number("--mac", 0, 1e9)
                                           : analog::digital_mac_power(load.rate_hz) / analog::kAnalogMacSaving;
  request.particles = static_cast<int>(arguments.integer("--particles", 1, 268435456));
  request.others = {kPrinted};
  for (const std::string& path : arguments.list("--fpga"))
    request.others.push_back(circuit_from(path, request.particles));
  return request;
}

}  // namespace mote
