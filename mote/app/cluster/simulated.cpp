// A rank of a simulated cluster. SimGrid's smpirun starts it; what the ranks do besides telling each other takes
// simulated time alone. Rank 0 says how long a step took, as JSON.
//
//   mote-smpi data-parallel|stage-parallel KEY=VALUE...

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <simgrid/host.h>
#include <smpi/smpi.h>

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

/// Seconds of a step, the first left out.
template <class Do>
double seconds_a_step(Team& team, std::size_t steps, const Do& step) {
  step(1);
  const double start = now(team);
  for (std::size_t t = 2; t <= steps + 1; ++t) step(static_cast<Step>(t));
  return (now(team) - start) / static_cast<double>(steps);
}

/// Memory that all ranks send from and receive to: they are threads of one process.
/// Others may be at work on it, so it stays where it is when it grows: each size has its own.
std::span<std::byte> anywhere(std::size_t bytes) {
  static std::map<std::size_t, std::vector<std::byte>> memory;
  std::vector<std::byte>& of_size = memory[bytes];
  of_size.resize(bytes);
  return of_size;
}

double data_parallel(const Words& words, Team& team) {
  const ShadowCloud cloud{words.count("particles"),    words.count("dimensions"), words.count("angles"),
                          words.count("number-bytes"), words("variation"),        words.count("seed")};
  Shadow shadow(team, cloud, anywhere(Shadow::parcel_bytes(cloud, team.ranks())));
  const double seconds = words("seconds");  // a particle
  return seconds_a_step(team, words.count("steps"), [&](Step t) {
    shadow.step(t, [&] { pass(seconds * static_cast<double>(shadow.particles())); });
  });
}

/// The steps of RankedFilter: stages whose work is time alone, the verdict, what rank 0 selects, and the set.
double stage_parallel(const Words& words, Team& team) {
  const Cast cast{words.count("proposers"), words.count("weighers"), words.count("chains")};
  const bool chains = words("resamples") == 0;
  const std::size_t n = words.count("particles");
  const std::size_t bytes = words.count("particle-bytes");  // of a message
  const ChainLayout layout{n, n, cast.chains, 0};
  const auto in_memory = [](std::size_t size) { return Memory{anywhere(size)}; };
  const auto passing = [&](const char* time) {
    return [seconds = words(time)](Stretch stretch) { pass(seconds * static_cast<double>(stretch.size())); };
  };
  const auto proposing = passing("tp");
  Stages stages{{0, n},        {{{0, n}}}, [&](std::size_t, std::size_t, Stretch stretch) { proposing(stretch); },
                passing("tw"), {},         [&](Stretch stretch) { return in_memory(stretch.size() * bytes); }};
  if (chains) {
    stages.lines = lines_of(layout, cast.chains);
    stages.take = passing("td");
    stages.outcome = [&](std::size_t line) {
      const Cut kept(n, cast.chains);
      return in_memory((kept.begin(line + 1) - kept.begin(line)) * sizeof(Index));
    };
  }
  RankStages ranks(team, cast, words.count("block"));
  return seconds_a_step(team, words.count("steps"), [&](Step) {
    if (words.count("step-bytes") > 0) team.share(anywhere(words.count("step-bytes")));
    ranks.run(stages);
    team.share(anywhere(sizeof(StepReport)));
    if (!chains && team.rank() == 0) pass(words("td") * static_cast<double>(n));
    team.share(anywhere(words.count("set-bytes")));
  });
}

}  // namespace

int main(int count, char** words) {
  const MpiSession session(count, words);
  const auto team = make_mpi_team();
  const Words given(count, words);
  const bool by_stages = std::string(words[1]) == "stage-parallel";
  const double seconds = by_stages ? stage_parallel(given, *team) : data_parallel(given, *team);
  if (team->rank() == 0) std::printf("{\"seconds_per_step\": %.17g}\n", seconds);
  return 0;
}
