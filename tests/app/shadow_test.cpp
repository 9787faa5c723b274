// The shadows that simulated clusters cast: their messages against those of the filters.

#include "mote/cluster/shadow.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "mote/app/catalogue/scene.hpp"
#include "mote/cluster/chain_shadow.hpp"
#include "mote/cluster/counting_team.hpp"
#include "mote/cluster/group_shadow.hpp"
#include "mote/engine/run.hpp"
#include "mote/engine/thread_teams.hpp"

namespace mote::testing {
namespace {

/// A team that notes what it is asked for.
class NotingTeam final : public Team {
 public:
  using Parcels = std::span<const ParcelOut>;
  using Noted = std::function<std::size_t(Parcels)>;

  NotingTeam(Team& team, std::vector<std::string>& notes, Noted noted)
      : team_(&team), notes_(&notes), noted_(std::move(noted)) {}
  std::size_t rank() const override { return team_->rank(); }
  std::size_t ranks() const override { return team_->ranks(); }
  void largest(std::span<double> numbers) override {
    note("largest of", numbers.size());
    team_->largest(numbers);
  }
  void add(std::span<ExactSum> sums) override {
    note("add", sums.size());
    team_->add(sums);
  }
  ExactSum before(const ExactSum& mine) override {
    note("before", 1);
    return team_->before(mine);
  }
  std::vector<std::uint32_t> gather(std::uint32_t mine) override {
    note("gather", 1);
    return team_->gather(mine);
  }
  void exchange(std::span<const ParcelOut> out, std::span<const ParcelIn> in) override {
    note("exchange", noted_(out));
    team_->exchange(out, in);
  }
  void complete(std::span<std::byte> column, std::span<const std::size_t> begins) override {
    note("complete", column.size());
    team_->complete(column, begins);
  }
  void share(std::span<std::byte> bytes) override {
    note("share", bytes.size());
    team_->share(bytes);
  }
  void send(std::size_t to, std::span<const std::byte> bytes) override {
    note("send", bytes.size());
    team_->send(to, bytes);
  }
  void expect(std::size_t from, std::span<std::byte> bytes) override {
    note("expect", bytes.size());
    team_->expect(from, bytes);
  }
  void await() override {
    note("await", 1);
    team_->await();
  }

 private:
  void note(const std::string& what, std::size_t count) { notes_->push_back(what + " " + std::to_string(count)); }
  Team* team_;
  std::vector<std::string>* notes_;
  Noted noted_;  // what is noted of parcels
};

using Notes = std::vector<std::string>;
constexpr Step kSteps = 5;
constexpr std::size_t kDimensions = 4;  // of the bearings model

/// What rank 1 of a team of three is asked for.
Notes notes_of_rank_1(const std::function<void(Team&)>& work, const NotingTeam::Noted& noted) {
  Notes rank_1;
  ThreadTeams(3).run([&](Team& team) {
    Notes notes;
    NotingTeam noting(team, notes, noted);
    work(noting);
    if (team.rank() == 1) rank_1 = notes;
  });
  return rank_1;
}

/// The number of particles' bytes is chance; that they come as whole numbers, by components, is not.
std::size_t rest_of_bytes(NotingTeam::Parcels parcels) {
  std::size_t rest = 0;
  for (const ParcelOut& parcel : parcels) rest += parcel.bytes.size() % 8;
  return rest;
}
/// Parcels with their lengths and receivers.
std::size_t all_of(NotingTeam::Parcels parcels) {
  std::size_t all = 0;
  for (const ParcelOut& parcel : parcels) all = 1000 * all + 10 * parcel.bytes.size() + parcel.rank;
  return all;
}

/// What the filter of a plan asks for.
Notes notes_of_filter(Plan plan, const NotingTeam::Noted& noted) {
  const auto model = find_model("bearings", "test").make(Settings("test", {}), {});
  const Recording recording = simulated_scene(*model, kSteps, 1).recording;
  return notes_of_rank_1(
      [&](Team& team) {
        Plan here = plan;
        here.engine = Engine::kMpi;
        here.team = &team;
        RunRequest request;
        request.states = model->states();
        const auto filter = model->filter(here, "test");
        run(*filter, here, recording, request);
      },
      noted);
}

// claim    the shadows ask of a team what the filters ask, in their order
// referee  the filters of --engine mpi
TEST(Shadow, AsksWhatTheFilterAsks) {
  // few blocks, of which every rank is told all sums, and many, whose sums are added up in turn
  for (const auto& [particles, least] : {std::pair{std::size_t{9000}, 10U}, {1100 * kBlock, 40U}}) {
    const Notes of_shadow = notes_of_rank_1(
        [&](Team& team) {
          const ShadowCloud cloud{.particles = particles, .dimensions = kDimensions};
          std::vector<std::byte> anywhere(Shadow::parcel_bytes(cloud, 3));
          Shadow shadow(team, cloud, anywhere);
          for (Step t = 1; t <= kSteps; ++t) shadow.step(t, [] {});
        },
        rest_of_bytes);
    Plan plan;
    plan.particles = particles;
    EXPECT_EQ(of_shadow, notes_of_filter(plan, rest_of_bytes));
    EXPECT_GE(of_shadow.size(), least);
  }
}

TEST(ChainShadow, AsksWhatTheFilterAsks) {
  for (const FilterKind kind : {FilterKind::kImh, FilterKind::kAuxiliary})
    for (const ChainStart start : {ChainStart::kFirst, ChainStart::kWeighted}) {
      const Notes of_shadow = notes_of_rank_1(
          [&](Team& team) {
            const ChainCloud cloud{.particles = 9000,
                                   .dimensions = kDimensions,
                                   .chains = 40,
                                   .weighted_start = start == ChainStart::kWeighted};
            std::vector<std::byte> anywhere(ChainShadow::column_bytes(cloud));
            ChainShadow shadow(team, cloud, anywhere);
            for (Step t = 1; t <= kSteps; ++t) shadow.step([] {}, [] {});
          },
          rest_of_bytes);
      Plan plan;
      plan.filter = kind;
      plan.particles = 9000;
      plan.chain.chains = 40;
      plan.chain.start = start;
      EXPECT_EQ(of_shadow, notes_of_filter(plan, rest_of_bytes)) << name_of(kind);
      EXPECT_GT(of_shadow.size(), 40U);
    }
}

// claim    ranks make whole blocks, and visit every proposal once
TEST(ChainShadow, SharesTheWork) {
  std::array<std::size_t, 3> made{};
  std::array<std::size_t, 3> visited{};
  ThreadTeams(3).run([&](Team& team) {
    const ChainCloud cloud{.particles = 5000, .chains = 30};
    std::vector<std::byte> anywhere(ChainShadow::column_bytes(cloud));
    const ChainShadow shadow(team, cloud, anywhere);
    made[team.rank()] = shadow.made();
    visited[team.rank()] = shadow.visited();
  });
  EXPECT_EQ(visited, (std::array<std::size_t, 3>{1670, 1670, 1660})) << "20 chains of 167, 10 of 166";
  EXPECT_EQ(made, (std::array<std::size_t, 3>{2048, 3072, 1928})) << "blocks 0 1, 1 2 3, 3 4";
}

TEST(GroupShadow, AsksWhatTheFilterAsks) {
  for (const Exchange exchange : {Exchange::kNone, Exchange::kAppend, Exchange::kReplace, Exchange::kSwap})
    for (const Topology topology : {Topology::kRing, Topology::kBidirectional, Topology::kHypercube}) {
      GroupOptions groups;
      groups.groups = 8;
      groups.exchange = exchange;
      groups.exchange_count = 3;
      groups.topology = topology;
      groups.exchange_every = 2;
      const Notes of_shadow = notes_of_rank_1(
          [&](Team& team) {
            GroupShadow<double> shadow(team, {.particles = 1000, .dimensions = kDimensions, .groups = groups});
            for (Step t = 1; t <= kSteps; ++t)
              shadow.step(
                  t, [] {}, [] {});
          },
          all_of);
      Plan plan;
      plan.filter = FilterKind::kDistributed;
      plan.particles = 1000;
      plan.groups = groups;
      EXPECT_EQ(of_shadow, notes_of_filter(plan, all_of)) << static_cast<int>(exchange) << static_cast<int>(topology);
      EXPECT_GT(of_shadow.size(), 40U);
    }
}

// claim    appended particles are resampled besides: two groups here, three particles to each, every other step
TEST(GroupShadow, ResamplesWhatIsAppended) {
  GroupOptions groups;
  groups.groups = 2;
  groups.exchange = Exchange::kAppend;
  groups.exchange_count = 3;
  groups.exchange_every = 2;
  ThreadTeams(1).run([&](Team& team) {
    const GroupShadow<float> shadow(team, {.particles = 100, .groups = groups});
    EXPECT_EQ(shadow.resampled(1), 100U);
    EXPECT_EQ(shadow.resampled(2), 106U);
  });
}

// claim    what ranks send is counted by the laws of CountingTeam
// referee  the same worked by hand for three ranks: two rounds, two others
TEST(CountingTeam, CountsWhatIsSent) {
  std::array<Traffic, 3> sent;
  ThreadTeams(3).run([&](Team& team) {
    CountingTeam counting(team);
    std::array<double, 5> numbers{};
    counting.largest(numbers);  // 2 messages, 2 x 40 bytes
    counting.gather(7);         // 2, 2 x 4
    std::array<std::uint32_t, 6> column{};
    counting.complete(std::as_writable_bytes(std::span(column)), std::vector<std::size_t>{0, 3, 5, 6});  // 2, 2 x own
    counting.share(std::as_writable_bytes(std::span(numbers)));  // of rank 0: 2, 2 x 40
    counting.before({});                                         // of ranks 0 and 1: 2 and 1 sums
    sent[team.rank()] = counting.traffic();
  });
  EXPECT_EQ(sent[0].messages, 2 + 2 + 2 + 2 + 2);
  EXPECT_EQ(sent[0].bytes, 80 + 8 + 2 * 12 + 80 + 2 * sizeof(ExactSum));
  EXPECT_EQ(sent[1].messages, 2 + 2 + 2 + 1);
  EXPECT_EQ(sent[1].bytes, 80 + 8 + 2 * 8 + sizeof(ExactSum));
  EXPECT_EQ(sent[2].messages, 2 + 2 + 2);
  EXPECT_EQ(sent[2].bytes, 80 + 8 + 2 * 4);
}

}  // namespace
}  // namespace mote::testing
