#pragma once
/// The stages of a step on the ranks of a team, as in IMH-OPT: proposers, weighers, chains.
///
///   proposers -> [messages of a block] -> weighers -> [rank 0: all blocks; other chains: those of theirs]

#include "mote/engine/cast.hpp"
#include "mote/engine/team.hpp"
#include "mote/filter/stages.hpp"

namespace mote {

/// Particles in a message for `count` of them: eight messages or more for each rank of the broader stage, as far as
/// these have 16 to 1024 particles.
std::size_t message_block(std::size_t count, const Cast& cast);

/// Runs the stages on the ranks of a team. Block i is proposed by proposer i mod R_p, weighed by weigher i mod R_w, and
/// taken in order by the chain that it belongs to, while later ones are proposed. Rank 0 gets them all, with what the
/// other chains have come to: after a run it has everything, the other ranks what they worked on.
///
/// shape   every rank calls run() with the same stages; they start from the same state
/// cost    two messages a block, three where another rank than 0 takes it; each has four blocks under way at most
/// source  docs/cluster.md; IMH-OPT sections V-B, V-C and VI-A
class RankStages final : public StageRunner {
 public:
  /// block: particles in a message, 0 = message_block().
  RankStages(Team& team, const Cast& cast, std::size_t block = 0) : team_(&team), cast_(cast), block_(block) {}

  void run(const Stages& stages) override;
  std::size_t proposers() const override { return 1; }  // on this rank
  std::size_t lines() const override { return cast_.chains; }
  /// Found by rank 0, which has everything, and told to the others.
  std::uint64_t agreed(const std::function<std::uint64_t()>& find) override;

 private:
  struct Block {
    Stretch stretch;
    std::size_t line;
  };
  struct Visit {
    const Block* block;
    std::size_t from;
  };

  void cut(const Stages& stages);
  void propose(const Stages& stages, std::size_t proposer);
  void weigh(const Stages& stages, std::size_t weigher);
  void take(const Stages& stages, std::size_t line);
  void collect_outcomes(const Stages& stages, std::size_t line);

  /// Sends what lies in memory as one message; the other way round.
  void send(std::size_t to, const Memory& memory);
  template <class Do>
  void receive_each(const Stages& stages, const std::vector<Visit>& visits, const Do& work);

  Team* team_;
  Cast cast_;
  std::size_t block_;
  std::vector<Block> blocks_;  // of the run, in order
  std::vector<std::byte> message_;
};

}  // namespace mote
