#include <array>

#include <fmt/format.h>

#include "mote/app/catalogue/scene.hpp"
#include "mote/app/design/check.hpp"
#include "mote/app/reproduce/circuits.hpp"

namespace mote {
namespace {

constexpr Step kSteps = 10;
constexpr double kExact = 1e-12;     // of IMH, whose cycles are a law
constexpr double kSisrBound = 0.03;  // of SISR, whose cycles depend on the data
constexpr std::array kArchitectures{"imh", "sisr"};
constexpr std::array kParticles{"250", "1000"};

}  // namespace

std::size_t circuits_checked() { return kArchitectures.size() * kParticles.size(); }

std::vector<PredictionCheck> check_circuits(const std::string& where, const CheckProgress& progress) {
  Job job;
  job.model_name = "ungm";
  job.model = find_model(job.model_name, where).make(Settings(where, {}), {});
  job.recording = simulated_scene(*job.model, kSteps, 1).recording;
  std::vector<PredictionCheck> all;
  for (const std::string arch : kArchitectures)
    for (const std::string particles : kParticles) {
      reproduce::CircuitBench bench({where, arch, {"--arch", arch, "--particles", particles}, {}}, job);
      const auto figure = [&](const std::string& key) {
        reproduce::Comparison asked;
        asked.where = where;
        asked.key = key;
        return bench.figure(asked, job.recording);
      };
      PredictionCheck check;
      if (arch == "imh")
        check = {fmt::format("ungm, imh, N = {}: a step, cycles", particles), bench.law_cycles(),
                 bench.step_cycles(job.recording)};
      else
        check = {fmt::format("ungm, sisr, N = {}: {} steps, cycles", particles, kSteps), figure("golden_cycles"),
                 figure("cycles")};
      check.ratio = check.measured / check.predicted;
      check.bound = arch == "imh" ? kExact : kSisrBound;
      all.push_back(check);
      progress();
    }
  return all;
}

}  // namespace mote
