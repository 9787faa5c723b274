#include "mote/app/explore/request.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mote/app/commands/particle_list.hpp"
#include "mote/app/commands/quantity.hpp"
#include "mote/app/compare/scenes.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"
#include "mote/software/simd/isa.hpp"
#include "mote/software/threads.hpp"

namespace mote::explore {
namespace {

/// What circuits are given.
constexpr compare::SceneBounds kMost{65535, 64};
constexpr long long kMostRuns = 100'000;
constexpr long long kMostSeed = 9223372036854775807LL;

std::size_t count_from(const Arguments& arguments, const std::string& option, long long most) {
  return static_cast<std::size_t>(arguments.integer(option, 1, most));
}

/// The words between commas.
std::vector<std::string> names_from(const Arguments& arguments, const std::string& option) {
  std::vector<std::string> all;
  for (const std::string_view part : parts_of(arguments.text(option), ',')) all.emplace_back(part);
  return all;
}

Space space_from(const Arguments& arguments, const Material& material) {
  Space space;
  space.model = material.design.model;
  space.where = material.design.where;
  space.settings = arguments.list("--set");
  space.catalogue_model = material.design.catalogue_model;
  space.platform = arguments.text("--platform");
  if (arguments.given("--kinds")) space.kinds = names_from(arguments, "--kinds");
  if (arguments.given("--particles")) space.particles = particle_list_from(arguments);
  if (arguments.given("--workers"))
    for (const long long w : integer_list_from(arguments, "--workers", 1, 1024, "1,2,4"))
      space.workers.push_back(static_cast<std::size_t>(w));
  if (arguments.given("--more-bits"))
    for (const long long b : integer_list_from(arguments, "--more-bits", -8, 8, "-2,0,2"))
      space.more_bits.push_back(static_cast<int>(b));
  if (arguments.given("--currents"))
    for (const long long na : integer_list_from(arguments, "--currents", 1, 100, "1,10,50"))
      space.currents.push_back(static_cast<int>(na));
  if (arguments.given("--bits"))
    for (const long long b : integer_list_from(arguments, "--bits", 1, 14, "6,8,10"))
      space.bits.push_back(static_cast<int>(b));
  return space;
}

/// "cpu, cluster, mixed or fpga:DEVICE"
std::string listed_targets() {
  std::vector<std::string> names;
  for (const TargetKind& kind : target_kinds())
    names.push_back(kind.name + (kind.detail.empty() ? "" : ":" + kind.detail));
  const std::string last = names.back();
  names.pop_back();
  return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

Refusal unknown_target(const std::string& where, const std::string& asked) {
  const std::string name = asked.substr(0, asked.find(':'));
  std::string example = target_kinds().front().example;
  for (const TargetKind& kind : target_kinds())
    if (kind.name == name) example = kind.example;
  return {ExitCode::kWrongUse,
          {where, "--target", listed_targets(), in_quotes(asked), fmt::format("Pass --target {}.", example)}};
}

/// The kind that --target names, and what stands behind its colon.
std::pair<const TargetKind&, std::string> kind_of(const Arguments& arguments) {
  const std::string asked = arguments.required("--target", listed_targets(), "Pass --target cpu.");
  const std::size_t colon = asked.find(':');
  const std::string detail = colon == std::string::npos ? "" : asked.substr(colon + 1);
  for (const TargetKind& kind : target_kinds())
    if (kind.name == asked.substr(0, colon) && kind.detail.empty() == (colon == std::string::npos))
      return {kind, detail};
  throw unknown_target(arguments.where(), asked);
}

/// What only other targets read is no use to be asked for.
void refuse_unread(const Arguments& arguments, const TargetKind& kind) {
  for (const TargetKind& other : target_kinds())
    for (const std::string& option : other.options)
      if (arguments.given(option) && std::find(kind.options.begin(), kind.options.end(), option) == kind.options.end())
        throw Refusal(ExitCode::kWrongUse,
                      {arguments.where(), option, "--target " + other.example, "--target " + arguments.text("--target"),
                       "Leave it out, or pass another --target."});
}

/// Directions of a frame that the model does not have are no use to be asked for.
void refuse_unread_columns(const Arguments& arguments, const compare::Design& design) {
  if (!arguments.given("--columns")) return;
  const std::vector<Column> columns = design.catalogue_model->columns();
  const std::string last = "doa" + arguments.text("--columns");
  if (std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == last; })) return;
  throw Refusal(ExitCode::kWrongUse,
                {design.where, "--columns", "a model of frames, as doa", in_quotes(design.model), "Leave it out."});
}

design::Rungs rungs_from(const Arguments& arguments) {
  const std::size_t first = count_from(arguments, "--first-runs", kMostRuns);
  const std::size_t most = count_from(arguments, "--runs", kMostRuns);
  if (arguments.given("--first-runs") && first > most)
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--first-runs", fmt::format("at most --runs {}", most),
                                        std::to_string(first), fmt::format("Pass --runs {}.", first)});
  return {first, most};
}

/// Figures that the target does not have cannot be limited.
void refuse_foreign(const Arguments& arguments, const std::vector<Figure>& figures, const Target& target) {
  for (const OptionSpec& option : explore_options())
    if (option.group == "Budgets" && option.flags.find("max") != std::string::npos && option.flags != "--max-rmse" &&
        arguments.given(option.flags) &&
        std::none_of(figures.begin(), figures.end(), [&](const Figure& f) { return f.option == option.flags; }))
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), option.flags, "a target that has it",
                                          "--target " + target.name(), "Leave it out, or pass another --target."});
}

double limit_from(const Arguments& arguments, const Figure& figure) {
  if (figure.option == "--deadline") return quantity_from(arguments, figure.option, kTimes, "1ms");
  if (figure.option == "--max-power") return quantity_from(arguments, figure.option, kPowers, "100mW");
  return arguments.number(figure.option, 1e-300, 1e300);
}

std::size_t goal_from(const Arguments& arguments, const std::vector<Figure>& figures) {
  std::vector<std::string> names;
  std::vector<std::size_t> places;
  const auto offer = [&](std::size_t k) {
    names.push_back(figures[k].name);
    places.push_back(k);
  };
  offer(figures.size() - 1);
  for (std::size_t k = 0; k + 1 < figures.size(); ++k)
    if (figures[k].axis) offer(k);
  if (arguments.given("--minimise")) return places[arguments.choice("--minimise", names)];
  for (const std::size_t k : places)
    if (figures[k].option.empty() || !arguments.given(figures[k].option)) return k;
  return places.front();
}

}  // namespace

std::vector<OptionSpec> explore_options() {
  const std::string budgets = "Budgets";
  const std::string space = "Candidates";
  const std::string judged = "Judgement";
  return {
      {"--target", "WHERE", "", "cpu, cluster, mixed or fpga:DEVICE (xc7a35t, xc7a100t, xc7z020, ...); must be given",
       space},
      {"--kinds", "LIST", "",
       "cpu: sisr, imh, auxiliary, sqmc, distributed; cluster: sisr, imh, distributed, stages; fpga: kinds of mote "
       "rtl; mixed: sisr, imh [all]",
       space},
      {"-n,--particles", "LIST", "",
       "numbers of particles [cpu: 64 to 65536, cluster: 4096 to 65536, fpga: 128 to 4096, mixed: 64 to 4096]", space},
      {"--workers", "LIST", "",
       "cpu: threads [1, all cores for many particles]; cluster: ranks [1 to 16]; fpga: lanes "
       "of kinds with several [4]; mixed: copies of the circuits [1,8]",
       space},
      {"--more-bits", "LIST", "", "fpga: bits after the point, of every word, more than chosen [-2,0]", space},
      {"--currents", "LIST", "", "mixed: I_a of both circuits in nA, from 1 to 100 [1,10,50 and MIXED's Table III]",
       space},
      {"--bits", "LIST", "", "mixed: bits of the ADC, from 1 to 14; the DAC has two more [6,8,10]", space},
      {"--platform", "NAME", "modern", "cluster: as of mote simulate-cluster", space},
      {"--set", "NAME=VALUE", "", "set a parameter of the model; may be repeated [its defaults]", space, true},
      {"--deadline", "TIME", "", "of a step, as 1ms or 20us", budgets},
      {"--max-rmse", "X", "", "error to the posterior mean, in the state's unit", budgets},
      {"--max-workers", "K", "", "threads, ranks, lanes or copies", budgets},
      {"--max-lut", "N", "", "fpga: look-up tables", budgets},
      {"--max-ff", "N", "", "fpga: flip-flops", budgets},
      {"--max-dsp", "N", "", "fpga: DSP blocks", budgets},
      {"--max-bram", "N", "", "fpga: memory blocks of 18 kbit", budgets},
      {"--max-power", "POWER", "", "fpga and mixed, as 100mW", budgets},
      {"--minimise", "WHAT", "", "rmse, time, threads, ranks, area or power [the first without a budget]", budgets},
      {"--data", "FILE", "", "one recording as CSV, instead of simulated ones", judged},
      {"--truth", "FILE", "", "its true states as CSV, whose error is said, too [none]", judged},
      {"--steps", "T", "50", "steps of a simulated recording, from 1 to 65535", judged},
      {"--recordings", "K", "32", "simulated recordings, from 1 to 10000", judged},
      {"--columns", "M", "1", "doa: directions per frame, from 1 to 64", judged},
      {"--error-of", "NAME", "",
       "the state that errors are of [position for models with x and y, else the first state]", judged},
      {"--runs", "R", "128", "runs that judge the candidates that are left in the end", judged},
      {"--first-runs", "R", "8", "runs that judge every candidate; as many as --runs: all are judged alike", judged},
      {"--seed", "S", "1", "first seed of recordings and runs", judged},
      {"--threads", "K", "", "candidates side by side [all cores]", judged},
      {"--state", "FILE", "", "findings are kept here; the same command goes on from it [--json's with .state]",
       "Output"}};
}

Material material_from(const Arguments& arguments) {
  Material material;
  compare::Design& design = material.design;
  design.model = arguments.text("MODEL");
  design.where = arguments.where();
  design.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, kMostSeed));
  material.source = compare::find_scenes(arguments, kMost, design, material.notes);
  refuse_unread_columns(arguments, design);
  design.repeats = kMostRuns;  // seeds do not depend on how many runs there are
  design.target = compare::target_of(arguments.text("--error-of"), design.catalogue_model->states(), design.where);
  return material;
}

std::unique_ptr<Target> target_from(const Arguments& arguments, const Material& material) {
  const auto [kind, detail] = kind_of(arguments);
  refuse_unread(arguments, kind);
  Space space = space_from(arguments, material);
  space.detail = detail;
  return kind.make(space, material.design.scenes.front().recording);
}

Order order_from(const Arguments& arguments, const Target& target) {
  std::vector<Figure> figures = target.figures();
  refuse_foreign(arguments, figures, target);
  figures.push_back({"rmse", "", "--max-rmse"});
  Order order;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    if (figures[k].limit > 0) order.limits.push_back({k, figures[k].limit});
    if (!figures[k].option.empty() && arguments.given(figures[k].option))
      order.limits.push_back({k, limit_from(arguments, figures[k])});
  }
  order.goal = goal_from(arguments, figures);
  order.rungs = rungs_from(arguments);
  order.threads = arguments.given("--threads") ? count_from(arguments, "--threads", 4096) : cores();
  return order;
}

RunFacts facts_of(const Arguments& arguments, const Material& material, const Target& target) {
  const compare::Design& design = material.design;
  std::string candidates;
  for (const Words& words : target.candidates()) candidates += fmt::format("{}\n", fmt::join(words, " "));
  std::string recordings;
  for (const Scene& scene : design.scenes) recordings += summed_up(scene.recording) + '\n';
  RunFacts facts = model_facts(design.model, arguments.list("--set"));
  facts.emplace_back("--target", target.name());
  const std::string platform = arguments.text("--platform");
  facts.emplace_back("--platform", platform);
  if (platform.ends_with(".xml")) facts.emplace_back("platform of checksum", checksum_of(read_text(platform)));
  facts.emplace_back("candidates of checksum", checksum_of(candidates));
  facts.emplace_back("recordings", material.source);
  facts.emplace_back("recordings of checksum", checksum_of(recordings));
  if (arguments.given("--truth"))
    facts.emplace_back("truth of checksum", checksum_of(read_text(arguments.text("--truth"))));
  facts.emplace_back("--seed", std::to_string(design.seed));
  facts.emplace_back("--error-of", design.target.name);
  facts.emplace_back("instruction set", std::string(name_of(best_isa().value_or(Isa::kSse4))));
  return facts;
}

}  // namespace mote::explore
