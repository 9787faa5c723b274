#include "mote/app/commands/checkpoint_options.hpp"

#include <fmt/format.h>

#include "mote/app/commands/plan_options.hpp"
#include "mote/app/files/facts.hpp"
#include "mote/engine/cast.hpp"
#include "mote/engine/team.hpp"
#include "mote/software/simd/isa.hpp"

namespace mote {
namespace {

constexpr long long kMostSteps = 1000000000;

/// Whether the bits depend on how long the processor's vectors are: those of the SIMD engine do, alone or on a team.
bool is_on_vectors(const Plan& plan) {
  const bool on_team = engine_of(plan) == Engine::kMpi && !has_cast(plan) && plan.filter != FilterKind::kDistributed;
  return engine_of(plan) == Engine::kSimd || on_team;
}

std::string instruction_set(const Plan& plan) {
  return is_on_vectors(plan) ? std::string(name_of(best_isa().value_or(Isa::kSse4))) : "any";
}

RunFacts facts_of(const Arguments& arguments, const Plan& plan, const Job& job) {
  RunFacts facts = model_facts(job.model_name, arguments.list("--set"));
  facts.emplace_back("--data of", summed_up(job.recording));
  facts.emplace_back("--estimate", fmt::format("{}", fmt::join(arguments.list("--estimate"), " ")));
  for (const OptionSpec& option : plan_options()) {
    const std::string name = option.flags.substr(option.flags.find("--"));
    if (name == "--threads" || name == "--proposers" || name == "--weighers") continue;  // no result depends on them
    facts.emplace_back(name, name == "--engine" ? std::string(name_of(engine_of(plan))) : arguments.text(name));
  }
  facts.emplace_back("instruction set", instruction_set(plan));
  facts.emplace_back("ranks", std::to_string(plan.team == nullptr ? 1 : plan.team->ranks()));
  return facts;
}

}  // namespace

std::vector<OptionSpec> checkpoint_options() {
  const std::string group = "Checkpoint";
  return {{"--checkpoint", "FILE", "",
           "keep the run in FILE, now and then and at Ctrl-C; if FILE exists the run goes on from there. Removed when "
           "the run is done [none]",
           group},
          {"--checkpoint-every", "S", "",
           "steps of the model between two checkpoints [10 s, or what makes them 5 % of the time]", group}};
}

std::optional<CheckpointFile> checkpoint_from(const Arguments& arguments, const Plan& plan, const Job& job) {
  std::optional<std::size_t> every;
  if (arguments.given("--checkpoint-every"))
    every = static_cast<std::size_t>(arguments.integer("--checkpoint-every", 1, kMostSteps));
  if (!arguments.given("--checkpoint")) {
    if (every)
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--checkpoint-every", "--checkpoint FILE beside it",
                                          "none", "Pass --checkpoint run.checkpoint."});
    return {};
  }
  if (arguments.given("--dump-particles"))
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), "--checkpoint", "no --dump-particles beside it, which a run broken off loses",
                   "--dump-particles " + arguments.text("--dump-particles"), "Pass one of the two."});
  return std::make_optional<CheckpointFile>(arguments.text("--checkpoint"), facts_of(arguments, plan, job), every);
}

}  // namespace mote
