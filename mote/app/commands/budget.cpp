#include "mote/app/commands/budget.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/memory.hpp"
#include "mote/app/commands/quantity.hpp"
#include "mote/app/files/text.hpp"
#include "mote/engine/budget.hpp"

namespace mote {
namespace {

constexpr double kTrialSeconds = 0.1;  // that steps of one number of particles are tried for, about

[[noreturn]] void refuse(const Arguments& arguments, const std::string& what, const std::string& expected,
                         const std::string& got, const std::string& next) {
  throw Refusal(ExitCode::kWrongUse, {arguments.where(), what, expected, got, next});
}

std::vector<double> bins_from(const Arguments& arguments) {
  if (!arguments.given("--bins")) return {};
  std::vector<double> widths;
  for (const std::string_view part : parts_of(arguments.text("--bins"), ',')) {
    const auto width = number_in(part);
    if (!width || !(*width >= 0 && *width < kInfinity))
      refuse(arguments, "--bins", "widths of at least 0, one a state, separated by commas",
             in_quotes(arguments.text("--bins")), "Pass --bins 0.5.");
    widths.push_back(*width);
  }
  return widths;
}

/// Whether the number of particles can follow what is asked for, and nothing else says it.
void check_what_stands_beside(const Arguments& arguments, const Plan& plan, const std::string& asked) {
  const Engine engine = engine_of(plan);
  if (plan.filter != FilterKind::kSisr && plan.filter != FilterKind::kImh && plan.filter != FilterKind::kAuxiliary)
    refuse(arguments, asked, "--filter sisr, imh or auxiliary, whose number of particles may change",
           fmt::format("--filter {}", name_of(plan.filter)), "Pass --filter sisr, or --particles instead.");
  if (engine != Engine::kSimd && engine != Engine::kReference)
    refuse(arguments, asked, "--engine simd or reference", fmt::format("--engine {}", name_of(engine)),
           "Pass --engine fastest, or --particles instead.");
  for (const auto& [option, reason] :
       {std::pair{"--particles", "which it replaces"}, std::pair{"--draws", "since chains keep all that they draw"},
        std::pair{"--checkpoint", "which keeps no run whose number of particles changes"}})
    if (arguments.given(option))
      refuse(arguments, asked, fmt::format("no {} beside it, {}", option, reason),
             fmt::format("{} {}", option, arguments.text(option)), fmt::format("Leave {} out.", option));
}

}  // namespace

std::vector<OptionSpec> budget_options() {
  const std::string group = "Budget (sisr, imh, auxiliary; simd, reference)";
  return {{"--budget", "TIME", "",
           "time of a step, as 1ms: as accurate as it allows. Tries at the start how many particles that is; up to so "
           "many, every step has what the weights before it ask for [none]",
           group},
          {"--most-particles", "N", "",
           "the same up to N particles, which are told instead of tried: the same run again [none]", group},
          {"--mc-error", "E", "",
           "with either: wanted standard error of means by Monte Carlo, in standard deviations of the state, from 0 to "
           "1; 0 = always the most particles [0.005]",
           group},
          {"--bins", "W,W...", "",
           "with either: widths of bins by state, 0 = not divided; then also particles for a Kullback-Leibler distance "
           "of 0.05 over the bins, with probability 0.99 [none]",
           group}};
}

std::optional<Budget> budget_from(const Arguments& arguments, Plan& plan) {
  const bool told = arguments.given("--most-particles");
  const bool timed = arguments.given("--budget");
  if (!told && !timed) {
    for (const std::string option : {"--mc-error", "--bins"})
      if (arguments.given(option))
        refuse(arguments, option, "--budget or --most-particles beside it", "neither", "Pass --budget 1ms.");
    return std::nullopt;
  }
  if (told && timed)
    refuse(arguments, "--most-particles", "no --budget beside it, which finds them",
           "--budget " + arguments.text("--budget"), "Pass one of the two.");
  Budget budget;
  if (timed) budget.seconds = quantity_from(arguments, "--budget", kTimes, "1ms");
  check_what_stands_beside(arguments, plan, timed ? "--budget" : "--most-particles");
  AdaptiveOptions& a = budget.adaptive;
  if (plan.filter != FilterKind::kSisr) a.least = std::max(a.least, plan.chain.chains);
  const auto most = static_cast<long long>(kMostParticles);
  a.most = told ? static_cast<std::size_t>(arguments.integer("--most-particles", static_cast<long long>(a.least), most))
                : kMostParticles;
  if (arguments.given("--mc-error")) a.error = arguments.number("--mc-error", 0, 1);
  a.bins = bins_from(arguments);
  plan.particles = told ? a.most : a.least;
  return budget;
}

std::unique_ptr<AdaptiveFilter> adaptive_filter(const Budget& budget, const Job& job, const Plan& plan,
                                                const std::string& where) {
  return std::make_unique<AdaptiveFilter>(job.model->filter(plan, where), budget.adaptive);
}

void settle(Budget& budget, const Job& job, const RunRequest& request, Plan& plan) {
  AdaptiveOptions& a = budget.adaptive;
  const std::size_t states = job.model->states().size();
  if (!a.bins.empty() && a.bins.size() != states)
    throw Refusal(ExitCode::kWrongUse,
                  {request.where, "--bins", fmt::format("a width for each of the model's {} states", states),
                   std::to_string(a.bins.size()), "Write 0 for a state that is not divided."});
  if (!budget.seconds) return;
  const double room = available_memory() / 2;
  for (a.most = kMostParticles; a.most > a.least; a.most /= 2) {
    plan.particles = a.most;
    if (bytes_needed(plan, states) <= room) break;
  }
  a.most = std::max(a.most, a.least);
  const auto make = [&](const Plan& trial) {
    Budget fixed = budget;
    fixed.adaptive.least = fixed.adaptive.most = trial.particles;
    return adaptive_filter(fixed, job, trial, request.where);
  };
  const auto steps = static_cast<std::size_t>(std::clamp(kTrialSeconds / *budget.seconds, 8.0, 100.0));
  const Affordable found =
      affordable(*budget.seconds, a.least, a.most, PilotClock(make, job.recording, plan, request, steps));
  a.most = plan.particles = found.particles;
  budget.step_seconds = found.step_seconds;
  budget.fits = found.fits;
}

nlohmann::json budget_json(const Budget& budget, const ParticleCounts& counts) {
  using Json = nlohmann::json;
  return {{"seconds", budget.seconds ? Json(*budget.seconds) : Json(nullptr)},
          {"most_particles", budget.adaptive.most},
          {"least_particles", budget.adaptive.least},
          {"mc_error", budget.adaptive.error},
          {"step_seconds", budget.seconds ? Json(budget.step_seconds) : Json(nullptr)},
          {"fits", budget.seconds ? Json(budget.fits) : Json(nullptr)},
          {"particles", {{"least", counts.least}, {"mean", counts.mean()}, {"most", counts.most}}},
          {"replay", fmt::format("--most-particles {}", budget.adaptive.most)}};
}

std::string budget_text(const Budget& budget, const ParticleCounts& counts) {
  std::string text = fmt::format("particles from {} to {}, mean {:.6g}", counts.least, counts.most, counts.mean());
  if (budget.seconds)
    text += fmt::format("; budget {}: at most {}, which took {}; the same run again: --most-particles {}",
                        in_units(*budget.seconds), budget.adaptive.most, in_units(budget.step_seconds),
                        budget.adaptive.most);
  return text + "\n";
}

}  // namespace mote
