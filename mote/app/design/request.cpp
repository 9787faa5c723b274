#include "mote/app/design/request.hpp"

#include <sstream>

#include "mote/app/files/text.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

using namespace design;

constexpr double kMostTime = 1e12;
constexpr double kLeastTime = 1e-12;

/// "1,2,0.5": a number for a proposer, a weigher and a chain.
PerBlock per_block(const Arguments& arguments, const std::string& option) {
  std::vector<double> numbers;
  std::istringstream words(arguments.text(option));
  for (std::string word; std::getline(words, word, ',');) {
    const auto number = number_in(word);
    if (number && *number >= 0 && *number <= kMostTime) numbers.push_back(*number);
  }
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  throw Refusal(ExitCode::kWrongUse,
                {arguments.where(), option, "three numbers of at least 0: of a proposer, a weigher, a chain",
                 "\"" + arguments.text(option) + "\"", "Pass " + option + " 1,1,1."});
}

double time_from(const Arguments& arguments, const std::string& option, double least) {
  arguments.required(option, "what a particle takes in that stage",
                     "Pass --tp, --tw and --td; mote design measure MODEL finds them.");
  return arguments.number(option, least, kMostTime);
}

std::optional<double> limit_from(const Arguments& arguments, const std::string& option) {
  if (!arguments.given(option)) return std::nullopt;
  return arguments.number(option, kLeastTime, kMostTime);
}

double number_or_0(const Arguments& arguments, const std::string& option) {
  return arguments.given(option) ? arguments.number(option, 0, kMostTime) : 0;
}

void refuse_nothing_to_weigh(const Arguments& arguments, const Demand& d) {
  const bool energetic = d.goal == Goal::kEnergy || d.most_energy;
  const bool some =
      d.energy.propose + d.energy.weigh + d.energy.chain + d.idle.propose + d.idle.weigh + d.idle.chain > 0;
  if (energetic && !some)
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), d.most_energy ? "--most-energy" : "--minimise energy",
                   "blocks that take energy: --energy or --idle", "neither", "Pass --energy 1,1,1 or --idle 1,1,1."});
  if (d.goal == Goal::kBlocks && d.weights.propose + d.weights.weigh == 0)
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--weights", "a proposer or a weigher that counts",
                                        arguments.text("--weights"), "Pass --weights 1,1,1."});
}

}  // namespace

std::vector<OptionSpec> design_options() {
  const std::string step = "Step";
  const std::string goal = "Goal";
  const std::string exact = "Exact schedule";
  return {
      {"--tp", "T", "", "what a particle takes to propose, in any unit; must be given", step},
      {"--tw", "T", "", "to weigh; must be given", step},
      {"--td", "T", "", "for a chain to decide on, 0 or more; must be given", step},
      {"-n,--particles", "Q", "1000", "proposals of a step beside the burn-in, from 1 to 1000000", step},
      {"--burn-in", "NB", "0", "proposals that each chain forgets", step},
      {"--chains", "P", "1", "chains at most, each of N_b + Q/P proposals, from 1 to 64", step},
      {"--minimise", "WHAT", "", "time, blocks or energy [time; with --deadline blocks]", goal},
      {"--deadline", "T", "", "longest time of a step [none]", goal},
      {"--weights", "WP,WW,WD", "1,1,1", "what a proposer, a weigher, a chain count as blocks", goal},
      {"--most-blocks", "B", "", "largest P (w_p R_p + w_w R_w + w_d) [none]", goal},
      {"--energy", "EP,EW,ED", "0,0,0", "energy that each takes for a particle", goal},
      {"--idle", "SP,SW,SD", "0,0,0", "power that each takes all the time", goal},
      {"--most-energy", "E", "", "largest energy of a step [none]", goal},
      {"--as-printed", "", "", "table I as printed, instead of corrected", goal},
      {"--by-equations", "", "", "with --as-printed: equations (24) to (38), which differ from the table", goal},
      {"--queue", "C", "0", "places before the weighers and before the chain; 0 = no bound", exact},
      {"--alpha", "T", "", "latency of a message between stages [0]", exact},
      {"--beta", "T", "", "time of a link for a byte [0]", exact},
      {"--bytes", "B", "", "bytes of a message [0]", exact},
  };
}

DesignRequest design_request_from(const Arguments& arguments) {
  DesignRequest request;
  Demand& d = request.demand;
  d.times = {time_from(arguments, "--tp", kLeastTime), time_from(arguments, "--tw", kLeastTime),
             time_from(arguments, "--td", 0)};
  d.kept = static_cast<std::size_t>(arguments.integer("--particles", 1, 1'000'000));
  d.burn_in = static_cast<std::size_t>(arguments.integer("--burn-in", 0, 1'000'000));
  d.most_chains = static_cast<std::size_t>(arguments.integer("--chains", 1, 64));
  d.weights = per_block(arguments, "--weights");
  d.energy = per_block(arguments, "--energy");
  d.idle = per_block(arguments, "--idle");
  d.deadline = limit_from(arguments, "--deadline");
  d.most_blocks = limit_from(arguments, "--most-blocks");
  d.most_energy = limit_from(arguments, "--most-energy");
  d.goal = arguments.given("--minimise")
               ? static_cast<Goal>(arguments.choice("--minimise", {"time", "blocks", "energy"}))
           : d.deadline ? Goal::kBlocks
                        : Goal::kTime;
  refuse_nothing_to_weigh(arguments, d);
  if (arguments.given("--as-printed")) request.print = Print::kTable;
  if (arguments.given("--by-equations")) {
    if (request.print == Print::kCorrected)
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--by-equations", "--as-printed", "nothing",
                                          "Pass --as-printed --by-equations."});
    request.print = Print::kEquations;
  }
  request.queue = static_cast<std::size_t>(arguments.integer("--queue", 0, 1'000'000));
  request.message = {number_or_0(arguments, "--alpha"), number_or_0(arguments, "--beta"),
                     number_or_0(arguments, "--bytes")};
  return request;
}

}  // namespace mote
