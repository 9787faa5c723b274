// A rank of a simulated cluster. SimGrid's smpirun starts it; what the ranks do besides telling each other takes
// simulated time alone. Rank 0 says how long a step took and what all ranks sent in it, as JSON.
//
//   mote-smpi particles|chains|groups|stages KEY=VALUE...

#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <simgrid/host.h>
#include <smpi/smpi.h>

#include "mote/cluster/chain_shadow.hpp"
#include "mote/cluster/counting_team.hpp"
#include "mote/cluster/group_shadow.hpp"
#include "mote/cluster/mpi_team.hpp"
#include "mote/cluster/shadow.hpp"
#include "mote/filter/filter.hpp"
#include "mote/software/pipeline/rank_stages.hpp"

namespace {

using namespace mote;

/// KEY=VALUE words; they come from mote, which has checked them.
class Words {
 public:
  Words(int count, char** words) {
    for (int i = 2; i < count; ++i) {
      const std::string word = words[i];
      const std::size_t at = word.find('=');
      values_[word.substr(0, at)] = std::strtod(word.c_str() + at + 1, nullptr);
    }
  }
  double operator()(const std::string& key) const { return values_.at(key); }
  std::size_t count(const std::string& key) const { return static_cast<std::size_t>(values_.at(key)); }

 private:
  std::map<std::string, double> values_;
};

/// Lets simulated time pass on this rank's host.
void pass(double seconds) { smpi_execute_flops(seconds * sg_host_get_speed(sg_host_self())); }

/// Simulated seconds; a barrier before, so that all ranks read the same.
double now(Team& team) {
  team.gather(0);
  double time = MPI_Wtime();
  team.largest({&time, 1});
  return time;
}

double sum_over_ranks(Team& team, double mine) {
  std::vector<double> all(team.ranks());
  std::vector<std::size_t> begins(team.ranks() + 1);
  std::iota(begins.begin(), begins.end(), std::size_t{0});
  all[team.rank()] = mine;
  team.complete(std::as_writable_bytes(std::span(all)), begins);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

/// What a step takes, and what all ranks send in it.
struct Taken {
  double seconds, messages, bytes;
};

/// Of a step, the first left out.
template <class Do>
Taken a_step(CountingTeam& team, std::size_t steps, const Do& step) {
  step(1);
  const double start = now(team);
  const Traffic sent = team.traffic();
  for (std::size_t t = 2; t <= steps + 1; ++t) step(static_cast<Step>(t));
  const Traffic all = team.traffic();
  const double seconds = now(team) - start;
  const auto count = static_cast<double>(steps);
  return {seconds / count, sum_over_ranks(team, all.messages - sent.messages) / count,
          sum_over_ranks(team, all.bytes - sent.bytes) / count};
}

/// Memory that all ranks send from and receive to: they are threads of one process.
/// Others may be at work on it, so it stays where it is when it grows: each size has its own.
std::span<std::byte> anywhere(std::size_t bytes) {
  static std::map<std::size_t, std::vector<std::byte>> memory;
  std::vector<std::byte>& of_size = memory[bytes];
  of_size.resize(bytes);
  return of_size;
}

Taken particles(const Words& words, CountingTeam& team) {
  const ShadowCloud cloud{words.count("particles"),    words.count("dimensions"), words.count("angles"),
                          words.count("number-bytes"), words("variation"),        words.count("seed")};
  Shadow shadow(team, cloud, anywhere(Shadow::parcel_bytes(cloud, team.ranks())));
  const double seconds = words("tp") + words("tw") + words("td");
  return a_step(team, words.count("steps"),
                [&](Step t) { shadow.step(t, [&] { pass(seconds * static_cast<double>(shadow.particles())); }); });
}

Taken chains(const Words& words, CountingTeam& team) {
  const ChainCloud cloud{words.count("particles"),    words.count("dimensions"), words.count("angles"),
                         words.count("number-bytes"), words.count("chains"),     words.count("weighted-start") != 0};
  ChainShadow shadow(team, cloud, anywhere(ChainShadow::column_bytes(cloud)));
  return a_step(team, words.count("steps"), [&](Step) {
    shadow.step([&] { pass((words("tp") + words("tw")) * static_cast<double>(shadow.made())); },
                [&] { pass(words("td") * static_cast<double>(shadow.visited())); });
  });
}

template <class R>
Taken groups(const Words& words, CountingTeam& team) {
  GroupCloud cloud{words.count("particles"), words.count("dimensions"), {}};
  cloud.groups.groups = words.count("groups");
  cloud.groups.exchange = static_cast<Exchange>(words.count("exchange"));
  cloud.groups.exchange_count = words.count("exchange-count");
  cloud.groups.topology = static_cast<Topology>(words.count("topology"));
  cloud.groups.exchange_every = words.count("exchange-every");
  GroupShadow<R> shadow(team, cloud);
  return a_step(team, words.count("steps"), [&](Step t) {
    shadow.step(
        t, [&] { pass((words("tp") + words("tw")) * static_cast<double>(shadow.particles())); },
        [&] { pass(words("td") * static_cast<double>(shadow.resampled(t))); });
  });
}

/// The steps of RankedFilter: stages whose work is time alone, the verdict, what rank 0 selects, and the set.
Taken stages(const Words& words, CountingTeam& team) {
  const Cast cast{words.count("proposers"), words.count("weighers"), words.count("chains")};
  const bool has_chains = words("resamples") == 0;
  const std::size_t n = words.count("particles");
  const std::size_t bytes = words.count("particle-bytes");  // of a message
  const ChainLayout layout{n, n, cast.chains, 0};
  const auto in_memory = [](std::size_t size) { return Memory{anywhere(size)}; };
  const auto passing = [&](const char* time) {
    return [seconds = words(time)](Stretch stretch) { pass(seconds * static_cast<double>(stretch.size())); };
  };
  const auto proposing = passing("tp");
  Stages parts{{0, n},        {{{0, n}}}, [&](std::size_t, std::size_t, Stretch stretch) { proposing(stretch); },
               passing("tw"), {},         [&](Stretch stretch) { return in_memory(stretch.size() * bytes); }};
  if (has_chains) {
    parts.lines = lines_of(layout, cast.chains);
    parts.take = passing("td");
    parts.outcome = [&](std::size_t line) {
      const Cut kept(n, cast.chains);
      return in_memory((kept.begin(line + 1) - kept.begin(line)) * sizeof(Index));
    };
  }
  RankStages ranks(team, cast, words.count("block"));
  return a_step(team, words.count("steps"), [&](Step) {
    if (words.count("step-bytes") > 0) team.share(anywhere(words.count("step-bytes")));
    ranks.run(parts);
    team.share(anywhere(sizeof(StepReport)));
    if (!has_chains && team.rank() == 0) pass(words("td") * static_cast<double>(n));
    team.share(anywhere(words.count("set-bytes")));
  });
}

Taken taken(const std::string& scenario, const Words& words, CountingTeam& team) {
  if (scenario == "stages") return stages(words, team);
  if (scenario == "chains") return chains(words, team);
  if (scenario == "particles") return particles(words, team);
  return words.count("number-bytes") == 4 ? groups<float>(words, team) : groups<double>(words, team);
}

}  // namespace

int main(int count, char** words) {
  const MpiSession session(count, words);
  const auto ranks = make_mpi_team();
  CountingTeam team(*ranks);
  const Taken step = taken(words[1], Words(count, words), team);
  if (team.rank() == 0)
    std::printf(R"({"seconds_per_step": %.17g, "messages_per_step": %.17g, "bytes_per_step": %.17g})", step.seconds,
                step.messages, step.bytes);
  return 0;
}
