#include "mote/app/explore/request.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mote/app/commands/particle_list.hpp"
#include "mote/app/commands/quantity.hpp"
#include "mote/app/files/text.hpp"
#include "mote/base/draws.hpp"
#include "mote/base/refusal.hpp"
#include "mote/software/threads.hpp"

namespace mote::explore {
namespace {

constexpr long long kMostRuns = 100'000;
constexpr long long kMostSeed = 9223372036854775807LL;

std::size_t count_from(const Arguments& arguments, const std::string& option, long long most) {
  return static_cast<std::size_t>(arguments.integer(option, 1, most));
}

void simulate(const Arguments& arguments, Material& material) {
  compare::Design& design = material.design;
  const auto steps = static_cast<Step>(arguments.integer("--steps", 1, 65535));
  const std::size_t recordings = count_from(arguments, "--recordings", 10'000);
  design.catalogue_model =
      find_model(design.model, design.where)
          .make(Settings(design.where, material.settings), frame_header(arguments.integer("--columns", 1, 64)));
  for (std::size_t k = 0; k < recordings; ++k)
    design.scenes.push_back(simulated_scene(*design.catalogue_model, steps, design.seed + k));
  material.source = fmt::format("{} simulated recording{} of {} steps (seeds {} to {})", recordings,
                                recordings == 1 ? "" : "s", steps, design.seed, design.seed + recordings - 1);
}

void load(const Arguments& arguments, Material& material) {
  compare::Design& design = material.design;
  for (const char* option : {"--steps", "--recordings", "--columns"})
    if (arguments.given(option))
      throw Refusal(ExitCode::kWrongUse, {design.where, option, "simulated recordings", "--data with one of its own",
                                          fmt::format("Leave out {} or --data.", option)});
  Job job =
      load_job(design.model, arguments.text("--data"), arguments.text("--truth"), material.settings, design.where);
  design.catalogue_model = job.model;
  design.scenes.push_back({std::move(job.recording), job.truth ? std::move(*job.truth) : Truth{}});
  material.notes = std::move(job.notes);
  material.source = arguments.text("--data");
}

/// The words between commas.
std::vector<std::string> names_from(const Arguments& arguments, const std::string& option) {
  std::vector<std::string> all;
  for (const std::string_view part : parts_of(arguments.text(option), ',')) all.emplace_back(part);
  return all;
}

Space space_from(const Arguments& arguments, const Material& material) {
  Space space{material.design.model,
              material.design.where,
              material.settings,
              material.design.catalogue_model,
              {},
              {},
              {},
              {},
              {},
              {}};
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

/// A number that any change of a text changes.
std::uint64_t digest_of(const std::string& text) {
  std::uint64_t digest = text.size();
  for (const char c : text) digest = mixed(digest ^ static_cast<unsigned char>(c));
  return digest;
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
       "rtl; mixed: "
       "sisr, imh [all]",
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
  material.settings = arguments.list("--set");
  if (arguments.given("--truth") && !arguments.given("--data"))
    throw Refusal(ExitCode::kWrongUse, {design.where, "--truth", "--data, whose truth it is", "nothing",
                                        "Pass --data, or leave --truth out: simulated recordings have their own."});
  if (arguments.given("--data")) {
    load(arguments, material);
  } else {
    simulate(arguments, material);
  }
  design.repeats = kMostRuns;  // seeds do not depend on how many runs there are
  design.target = compare::target_of(arguments.text("--error-of"), design.catalogue_model->states(), design.where);
  return material;
}

std::unique_ptr<Target> target_from(const Arguments& arguments, const Material& material) {
  const std::string asked = arguments.required("--target", "cpu, cluster, mixed or fpga:DEVICE", "Pass --target cpu.");
  const Space space = space_from(arguments, material);
  const Recording& first = material.design.scenes.front().recording;
  if (asked == "cpu") return processor(space, first);
  if (asked == "cluster") return cluster(space, arguments.text("--platform"));
  if (asked.starts_with("fpga:")) return device(space, asked.substr(5), first);
  if (asked == "mixed") return mixed_mode(space);
  throw Refusal(ExitCode::kWrongUse, {space.where, "--target", "cpu, cluster, mixed or fpga:DEVICE", in_quotes(asked),
                                      asked == "fpga" ? "Pass --target fpga:xc7a100t." : "Pass --target cpu."});
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
  order.rungs = {count_from(arguments, "--first-runs", kMostRuns), count_from(arguments, "--runs", kMostRuns)};
  order.threads = arguments.given("--threads") ? count_from(arguments, "--threads", 4096) : cores();
  return order;
}

nlohmann::json belongs_of(const Arguments& arguments, const Material& material, const Target& target) {
  std::vector<std::string> candidates;
  for (const Words& words : target.candidates()) candidates.push_back(fmt::format("{}", fmt::join(words, " ")));
  nlohmann::json all{{"exploration", 1},
                     {"model", material.design.model},
                     {"settings", material.settings},
                     {"target", target.name()},
                     {"platform", arguments.text("--platform")},
                     {"source", material.source},
                     {"seed", material.design.seed},
                     {"state", material.design.target.name},
                     {"candidates", candidates}};
  for (const char* file : {"--data", "--truth"})
    if (arguments.given(file)) all[file] = digest_of(read_text(arguments.text(file)));
  if (material.design.model.ends_with(".toml")) all["text"] = digest_of(read_text(material.design.model));
  return all;
}

}  // namespace mote::explore
