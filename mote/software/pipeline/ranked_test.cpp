#include "mote/software/pipeline/ranked.hpp"

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/engine/checkpoint_laws.hpp"
#include "mote/engine/drawn_recording.hpp"
#include "mote/engine/run.hpp"
#include "mote/engine/thread_teams.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/local_level.hpp"
#include "mote/model/ungm.hpp"
#include "mote/software/engines.hpp"

namespace mote {
namespace {

template <class M>
std::vector<EstimateRow> on_team(const M& model, Plan plan, const Cast& cast, const Recording& recording) {
  plan.engine = Engine::kMpi;
  plan.proposers = cast.proposers;
  plan.weighers = cast.weighers;
  RunRequest request;
  request.states = model.states();
  std::vector<EstimateRow> rows;
  ThreadTeams teams(cast.ranks());
  teams.run([&](Team& team) {
    Plan mine = plan;
    mine.team = &team;
    check(mine, "test");
    const auto filter = ranked_filter(model, mine, "test");
    RunRecord record = run(*filter, mine, recording, request);
    if (team.rank() == 0) rows = std::move(record.rows);
  });
  return rows;
}

template <class M>
std::vector<EstimateRow> by_reference(const M& model, const Plan& plan, const Recording& recording) {
  RunRequest request;
  request.states = model.states();
  const auto filter = reference_filter(model, plan, "test");
  return run(*filter, plan, recording, request).rows;
}

bool same(const std::vector<EstimateRow>& a, const std::vector<EstimateRow>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const EstimateRow& x, const EstimateRow& y) { return laws::same(x, y); });
}

Plan plan_of(FilterKind filter, std::size_t particles, std::size_t chains = 1) {
  Plan plan;
  plan.filter = filter;
  plan.particles = particles;
  plan.chain.chains = chains;
  plan.seed = 3;
  plan.on_collapse = OnCollapse::kKeep;
  return plan;
}

template <class M>
void expect_the_reference(const M& model, const Plan& plan, const std::vector<Cast>& casts) {
  const Recording recording = drawn_recording(model, 6);
  const auto expected = by_reference(model, plan, recording);
  for (const Cast& cast : casts)
    EXPECT_TRUE(same(on_team(model, plan, cast, recording), expected))
        << name_of(plan.filter) << ", Rp = " << cast.proposers << ", Rw = " << cast.weighers << ", P = " << cast.chains;
}

// claim    ranks with a stage each give the bits of the reference engine, for any cast
// referee  the reference engine
// design   three filters, a few options of each, casts of 3 to 8 ranks; the twin draws by another seed
TEST(RankedFilters, GiveTheBitsOfTheReference) {
  const std::vector<Cast> one{{1, 1, 1}, {2, 1, 1}, {1, 3, 1}, {3, 4, 1}};
  const std::vector<Cast> three{{1, 1, 3}, {2, 2, 3}, {3, 2, 3}};
  for (const std::size_t n : {50, 2000}) {
    expect_the_reference(Ungm<1>{}, plan_of(FilterKind::kSisr, n), one);
    expect_the_reference(Ungm<1>{}, plan_of(FilterKind::kImh, n), one);
    expect_the_reference(Bearings{}, plan_of(FilterKind::kAuxiliary, n, 3), three);
  }
  Plan burnt = plan_of(FilterKind::kImh, 1000, 3);
  burnt.chain.burn_in = 37;
  burnt.chain.draws = 1501;
  expect_the_reference(LocalLevel{}, burnt, three);
  Plan by_weights = plan_of(FilterKind::kImh, 700, 3);
  by_weights.chain.burn_in.reset();
  expect_the_reference(Ungm<1>{}, by_weights, three);
  by_weights.chain.start = ChainStart::kWeighted;
  expect_the_reference(LocalLevel{}, by_weights, three);
  Plan guided = plan_of(FilterKind::kAuxiliary, 500, 3);
  guided.proposal = "guided";
  guided.precision = Precision::kFloat;
  guided.chain.parent_weights = ParentWeights::kLookahead;
  expect_the_reference(Bearings{}, guided, three);
  Plan improved = plan_of(FilterKind::kImh, 800, 3);
  improved.chain.parents = Parents::kPermuted;
  improved.chain.start = ChainStart::kWeighted;
  expect_the_reference(Ungm<1>{}, improved, three);
  Plan carried = plan_of(FilterKind::kSisr, 1500);
  carried.selection.ess_threshold = 0.3;
  carried.selection.exponent = 0.7;
  expect_the_reference(LocalLevel{}, carried, one);
  Plan other = plan_of(FilterKind::kImh, 50);
  const Recording recording = drawn_recording(Ungm<1>{}, 6);
  const auto expected = by_reference(Ungm<1>{}, other, recording);
  other.seed = 4;
  EXPECT_FALSE(same(on_team(Ungm<1>{}, other, {1, 1, 1}, recording), expected)) << "twin";
}

TEST(RankedFilters, CollapseAsTheReference) {
  Recording far = drawn_recording(LocalLevel{}, 6);
  far.steps[2].rows[0].values[0] = 1e300;
  for (const auto& [filter, burn_in] : std::vector<std::pair<FilterKind, std::optional<std::size_t>>>{
           {FilterKind::kSisr, 0}, {FilterKind::kImh, 0}, {FilterKind::kImh, std::nullopt}})
    for (const OnCollapse what : {OnCollapse::kKeep, OnCollapse::kReset}) {
      Plan plan = plan_of(filter, 700);
      plan.chain.burn_in = burn_in;
      plan.on_collapse = what;
      const auto expected = by_reference(LocalLevel{}, plan, far);
      EXPECT_TRUE(expected[2].report.collapsed);
      EXPECT_TRUE(same(on_team(LocalLevel{}, plan, {2, 2, 1}, far), expected)) << name_of(filter);
    }
  Plan plan = plan_of(FilterKind::kImh, 700);
  plan.on_collapse = OnCollapse::kStop;
  const auto stopping = [&] {
    ThreadTeams teams(3);
    std::atomic<int> stopped = 0;
    teams.run([&](Team& team) {
      Plan mine = plan;
      mine.engine = Engine::kMpi;
      mine.proposers = 1;
      mine.team = &team;
      RunRequest request;
      request.states = LocalLevel{}.states();
      const auto filter = ranked_filter(LocalLevel{}, mine, "test");
      try {
        run(*filter, mine, far, request);
      } catch (const Refusal& refusal) {
        stopped += refusal.code() == ExitCode::kCollapsed ? 1 : 0;
      }
    });
    return stopped.load();
  };
  EXPECT_EQ(stopping(), 3) << "all ranks come to it together";
}

TEST(RankedFilters, RefuseATeamOfAnotherSize) {
  const auto sentence = [](Plan plan) {
    plan.engine = Engine::kMpi;
    plan.proposers = 2;
    std::string said;
    ThreadTeams teams(3);
    teams.run([&](Team& team) {
      Plan mine = plan;
      mine.team = &team;
      try {
        check(mine, "mote run");
      } catch (const Refusal& refusal) {
        if (team.rank() == 0) said = refusal.what();
      }
    });
    return said;
  };
  EXPECT_EQ(sentence(plan_of(FilterKind::kImh, 100, 5)),
            "mote run: --engine mpi --proposers --weighers: expected 8 ranks: 2 that propose, 1 that weigh, 5 with a "
            "chain, got 3. "
            "Start mpirun -n 8.");
  EXPECT_NE(sentence(plan_of(FilterKind::kSqmc, 100)).find("expected --filter sisr, imh or auxiliary"),
            std::string::npos);
}

TEST(RankStages, CutMessages) {
  EXPECT_EQ(message_block(10, {1, 1, 1}), 16U);
  EXPECT_EQ(message_block(840, {1, 6, 1}), 16U);
  EXPECT_EQ(message_block(840, {1, 1, 1}), 64U);
  EXPECT_EQ(message_block(1'000'000, {2, 2, 1}), 1024U);
}

}  // namespace
}  // namespace mote
