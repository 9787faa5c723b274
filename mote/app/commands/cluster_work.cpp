#include "mote/app/commands/cluster_work.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "mote/app/commands/particle_list.hpp"
#include "mote/app/commands/plan_options.hpp"
#include "mote/base/draws.hpp"

namespace mote {
namespace {

using namespace simulated;

constexpr long long kMostRanks = 4096;
constexpr long long kMostEach = 1'000'000'000;
constexpr std::size_t kChainsOfARank = 16;  // that keep its vectors busy

bool has_chains(const Workload& work) {
  return work.filter == FilterKind::kImh || work.filter == FilterKind::kAuxiliary;
}

std::vector<std::size_t> list_from(const Arguments& arguments, const std::string& option, long long most) {
  const auto all = integer_list_from(arguments, option, 1, most, "1,2,4");
  return {all.begin(), all.end()};
}

/// One of two options, the first unless told.
bool second_of(const Arguments& arguments, const std::string& first, const std::string& second) {
  if (arguments.given(first) && arguments.given(second))
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), first, "it, or " + second, "both", "Pass one of them."});
  return arguments.given(second);
}

void refuse_beside(const Arguments& arguments, const std::vector<std::string>& options, const std::string& beside) {
  for (const std::string& option : options)
    if (arguments.given(option))
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), option, fmt::format("no {} beside {}", option, beside),
                                          option, "Leave it out."});
}

/// Refuses options that the filter does not read.
void refuse_without(const Arguments& arguments, bool read, const std::vector<std::string>& options,
                    const std::string& filters) {
  for (const std::string& option : options)
    if (!read && arguments.given(option))
      throw Refusal(ExitCode::kWrongUse, {arguments.where(), option, "--filter " + filters,
                                          "--filter " + arguments.text("--filter"), "Leave it out."});
}

void check_options(const Arguments& arguments, const Workload& work) {
  if (work.by_stages)
    refuse_beside(arguments, {"--ranks", "--weak", "--strong", "--ess", "--chain-start"}, "--stage-parallel");
  else
    refuse_beside(arguments, {"--proposers", "--weighers", "--block", "--step-bytes"}, "--data-parallel");
  for (const char* time : {"--tp", "--tw", "--td"})
    if (arguments.given(time)) refuse_beside(arguments, {"--slower"}, time);
  refuse_without(arguments, has_chains(work), {"--chains", "--chain-start"}, "imh or auxiliary");
  refuse_without(arguments, !has_chains(work), {"--ess"}, "sisr or distributed, whose weights decide what travels");
  const bool groups = work.filter == FilterKind::kDistributed;
  refuse_without(arguments, groups, {"--groups"}, "distributed");
  refuse_without(arguments, groups, kExchangeOptions, "distributed");
  if (work.by_stages && groups)
    throw Refusal(ExitCode::kWrongUse, {arguments.where(), "--filter", "sisr, imh or auxiliary beside --stage-parallel",
                                        "distributed", "Leave --stage-parallel out."});
  if (!work.by_stages && has_chains(work) && arguments.text("--proposal") != "prior")
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), "--proposal", "prior, where ranks share the particles of chains",
                   arguments.text("--proposal"), "Pass --stage-parallel, or leave it out."});
}

void refuse_ranks(const Arguments& arguments, const Sweep& sweep, const std::string& expected) {
  throw Refusal(ExitCode::kWrongUse,
                {arguments.where(), "--ranks", expected, std::to_string(sweep.ranks.back()), "Pass fewer --ranks."});
}

/// What `mote run` says of the filter on so many ranks.
void check_filter(const Workload& work, std::size_t ranks, const std::string& where) {
  Plan plan;
  plan.filter = work.filter;
  plan.particles = work.particles_of(ranks);
  plan.chain.chains = work.chains;
  plan.groups = work.groups;
  plan.groups.groups = work.groups_of(ranks);
  check(plan, where);
}

void check_shares(const Arguments& arguments, const Sweep& sweep) {
  const Workload& work = sweep.work;
  const std::size_t most = sweep.ranks.back();
  if (sweep.platform.hosts > 0 && most > sweep.platform.hosts)
    refuse_ranks(arguments, sweep,
                 fmt::format("at most {}, the hosts of {}", sweep.platform.hosts, sweep.platform.name));
  if (work.filter == FilterKind::kDistributed) {
    if (most > work.groups_of(most))
      refuse_ranks(arguments, sweep, fmt::format("at most {}, a group each", work.groups_of(most)));
    for (const std::size_t ranks : sweep.ranks) check_filter(work, ranks, arguments.where());
    return;
  }
  if (ranks_with_blocks(work, {most}).empty())
    refuse_ranks(arguments, sweep,
                 fmt::format("at most {} for {} particles, a block of {} each", (work.particles + kBlock - 1) / kBlock,
                             work.particles, kBlock));
  if (!has_chains(work)) return;
  if (most > work.chains) refuse_ranks(arguments, sweep, fmt::format("at most {}, a chain each", work.chains));
  for (const std::size_t ranks : sweep.ranks) check_filter(work, ranks, arguments.where());
}

void cast_shares(const Arguments& arguments, Sweep& sweep) {
  sweep.ranks = list_from(arguments, "--ranks", kMostRanks);
  if (has_chains(sweep.work) && !arguments.given("--chains")) sweep.work.chains = kChainsOfARank * sweep.ranks.back();
  if (sweep.ranks.front() != 1) sweep.ranks.insert(sweep.ranks.begin(), 1);
  check_shares(arguments, sweep);
}

void cast_stages(const Arguments& arguments, Sweep& sweep) {
  sweep.proposers = list_from(arguments, "--proposers", static_cast<long long>(kMostStageWorkers));
  sweep.weighers = list_from(arguments, "--weighers", static_cast<long long>(kMostStageWorkers));
  const Cast largest{sweep.proposers.back(), sweep.weighers.back(), sweep.work.chains};
  if (sweep.platform.hosts > 0 && largest.ranks() > sweep.platform.hosts)
    throw Refusal(ExitCode::kWrongUse,
                  {arguments.where(), "--proposers --weighers",
                   fmt::format("at most {} ranks, the hosts of {}", sweep.platform.hosts, sweep.platform.name),
                   fmt::format("{} with {}", largest.ranks(), sweep.work.chains > 1 ? "the chains" : "the chain"),
                   "Pass fewer."});
}

}  // namespace

Workload work_from(const Arguments& arguments) {
  Workload work;
  const auto integer = [&](const char* option, long long least, long long most) {
    return static_cast<std::size_t>(arguments.integer(option, least, most));
  };
  work.by_stages = second_of(arguments, "--data-parallel", "--stage-parallel");
  work.weak = !second_of(arguments, "--weak", "--strong");
  work.filter = static_cast<FilterKind>(arguments.choice("--filter", {"sisr", "imh", "auxiliary", "distributed"}));
  check_options(arguments, work);
  const bool blocks = !work.by_stages && work.filter != FilterKind::kDistributed;
  work.particles = integer("--particles", blocks ? 1024 : 1, kMostEach);
  work.number_bytes = arguments.choice("--precision", {"float", "double"}) == 0 ? 4 : 8;
  if (arguments.given("--chains")) work.chains = integer("--chains", 1, work.by_stages ? 64 : kMostEach);
  work.weighted_start = arguments.choice("--chain-start", {"first", "weighted"}) == 1;
  if (arguments.given("--block")) work.block = integer("--block", 1, kMostEach);
  work.groups = exchange_from(arguments);
  work.groups.groups = arguments.given("--groups") ? integer("--groups", 1, kMostEach) : 0;
  work.step_bytes = integer("--step-bytes", 0, kMostEach);
  work.steps = integer("--steps", 1, 100'000);
  work.seed = static_cast<std::uint64_t>(arguments.integer("--seed", 0, 4'294'967'295));
  return work;
}

void cast_ranks(const Arguments& arguments, Sweep& sweep) {
  if (sweep.work.by_stages)
    cast_stages(arguments, sweep);
  else
    cast_shares(arguments, sweep);
}

std::vector<std::size_t> ranks_with_blocks(const Workload& work, const std::vector<std::size_t>& ranks) {
  std::vector<std::size_t> some;
  for (const std::size_t r : ranks)
    if (r <= (work.particles_of(r) + kBlock - 1) / kBlock) some.push_back(r);
  return some;
}

}  // namespace mote
