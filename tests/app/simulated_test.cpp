// `mote simulate-cluster`: simulated times against laws worked by hand, and its messages against those of the filter.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mote/app/catalogue/scene.hpp"
#include "mote/cluster/shadow.hpp"
#include "mote/engine/run.hpp"
#include "mote/engine/thread_teams.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

class SimulatedCluster : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!kSimulates) GTEST_SKIP() << "built without SimGrid";
  }

  nlohmann::json runs(const std::string& words) const {
    const Ended ended = scratch_.shell("mote simulate-cluster " + words + " --json s.json");
    EXPECT_EQ(ended.code, 0) << ended.err;
    return nlohmann::json::parse(scratch_.read("s.json")).at("runs");
  }
  static double seconds(const nlohmann::json& run) { return run.at("seconds_per_step").get<double>(); }

  Scratch scratch_;
};

// claim    stages on ranks whose messages take no time need what the laws say (docs/pipeline.md)
// referee  the laws, worked by hand for blocks of ten particles: T_p 20 us, T_w 10 us, T_d 40 us a block, 30 blocks
TEST_F(SimulatedCluster, TakesWhatTheLawsSay) {
  const std::string times = "--stage-parallel --platform ideal -n 300 --block 10 --tp 2e-6 --tw 1e-6 --td ";
  const auto imh = runs(times + "4e-6 --filter imh --proposers 1,2");
  EXPECT_NEAR(seconds(imh[0]), 20e-6 + 10e-6 + 30 * 40e-6, 2e-6) << "the chain is the slowest";
  EXPECT_NEAR(seconds(imh[1]), seconds(imh[0]), 1e-6) << "so a second proposer gains nothing";
  const auto proposing = runs(times + "1e-6 --filter imh --proposers 1,2");
  EXPECT_NEAR(seconds(proposing[0]), 30 * 20e-6 + 10e-6 + 10e-6, 2e-6) << "proposing is";
  EXPECT_NEAR(seconds(proposing[1]), 15 * 20e-6 + 2 * 10e-6 + 10e-6, 11e-6);
  const auto sisr = runs(times + "1e-6 --filter sisr --proposers 1,2");
  EXPECT_NEAR(seconds(sisr[0]), 30 * 20e-6 + 10e-6 + 300e-6, 2e-6) << "resampling waits for all";
  EXPECT_NEAR(sisr[0].at("law_seconds").get<double>(), seconds(sisr[0]), 1e-6);
  const auto three = runs(times + "4e-6 --filter imh --chains 3 --proposers 3 --weighers 3");
  EXPECT_NEAR(seconds(three[0]), 20e-6 + 10e-6 + 10 * 40e-6, 20e-6) << "a third of them each";
}

// claim    a step of a team of R takes its work and ten waits or fewer of log2 R messages one after the other
// referee  latency 1.5 us; 9 waits for all and the children's way to their neighbours
TEST_F(SimulatedCluster, WaitsForItsMessages) {
  const auto all = runs("--ranks 2,4,32 --tp 2e-9 --ess 0.4 --steps 4");
  EXPECT_NEAR(seconds(all[0]), 2e-3, 1e-8);
  for (std::size_t k = 1; k < all.size(); ++k) {
    const double rounds = std::log2(all[k].at("ranks").get<double>());
    EXPECT_GT(seconds(all[k]), 2e-3 + 9 * rounds * 1.4e-6);
    EXPECT_LT(seconds(all[k]), 2e-3 + 10 * rounds * 1.6e-6 + 20e-6);
    EXPECT_GT(all[k].at("efficiency").get<double>(), 0.9);
  }
  EXPECT_EQ(runs("--ranks 4 --tp 2e-9 --ess 0.4 --steps 4")[1], all[2]) << "no chance in it";
  const auto strong = runs("--strong -n 100000 --ranks 8 --tp 1e-7 --ess 0.4 --steps 2");
  EXPECT_LT(strong[1].at("speedup").get<double>(), 100'000.0 / (13 * 1024)) << "the largest share has 13 blocks";
  EXPECT_GT(strong[1].at("speedup").get<double>(), 7);
}

TEST_F(SimulatedCluster, TakesAPlatformFile) {
  scratch_.write(
      "two.xml",
      "<?xml version='1.0'?>\n<!DOCTYPE platform SYSTEM \"https://simgrid.org/simgrid.dtd\">\n<platform "
      "version=\"4.1\"><cluster id=\"c\" prefix=\"h\" suffix=\"\" radical=\"0-1\" speed=\"1Gf\" bw=\"1MBps\" "
      "lat=\"1ms\"/></platform>\n");
  EXPECT_GT(seconds(runs("--platform two.xml --ranks 2 --tp 1e-9 --ess 0.4 --steps 2")[1]), 18e-3);
  const Ended ring = scratch_.shell(
      "mote simulate-cluster --platform ring:16 --ranks 16 --tp 1e-6 --ess 0.4 -n 1024 --steps 2 --report r.html");
  EXPECT_EQ(ring.code, 0) << ring.err;
  EXPECT_NE(scratch_.read("r.html").find("16 cores of 100 MHz on a ring"), std::string::npos);
}

TEST_F(SimulatedCluster, RefusesInSentences) {
  struct Case {
    std::string words;
    int code;
    std::string sentence;
  };
  for (const Case& c : std::vector<Case>{
           {"--platform nope", 2, "--platform: expected red, blue, modern, ideal, ring:N or FILE.xml, got \"nope\""},
           {"--platform ring:1", 2, "ring:N, N cores from 2 to 1024"},
           {"--platform no.xml", 3, "no.xml: expected a platform file of SimGrid"},
           {"--platform red --ranks 17", 2, "--ranks: expected at most 16, the hosts of red, got 17"},
           {"--platform red --stage-parallel --weighers 15", 2,
            "at most 16 ranks, the hosts of red, got 17 with the chain"},
           {"--strong -n 2048 --ranks 3", 2, "at most 2 for 2048 particles"},
           {"--ranks 0", 2, "--ranks: expected integers from 1 to"},
           {"--weak --strong", 2, "--weak: expected it, or --strong, got both"},
           {"--filter imh", 2,
            "--filter: expected sisr, whose particles ranks can share, got imh. Pass --stage-parallel."},
           {"--weighers 2", 2, "--weighers: expected no --weighers beside --data-parallel"},
           {"--stage-parallel --ranks 3", 2, "--ranks: expected no --ranks beside --stage-parallel"},
           {"--stage-parallel --chains 2", 2, "--chains: expected --filter imh or auxiliary"}}) {
    const Ended ended = scratch_.shell("mote simulate-cluster --tp 1e-9 " + c.words);
    EXPECT_EQ(ended.code, c.code) << c.words << "\n" << ended.err;
    EXPECT_NE(ended.err.find(c.sentence), std::string::npos) << c.words << "\n" << ended.err;
  }
  const Ended ended = scratch_.shell("PATH=/nowhere; mote simulate-cluster");
  EXPECT_EQ(ended.code, 5);
  EXPECT_NE(ended.err.find("smpirun: expected SimGrid's smpirun in the PATH"), std::string::npos) << ended.err;
}

/// A team that notes what it is asked for.
class NotingTeam final : public Team {
 public:
  NotingTeam(Team& team, std::vector<std::string>& notes) : team_(&team), notes_(&notes) {}
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
    std::size_t rest = 0;  // parcels come by components
    for (const ParcelOut& parcel : out) rest += parcel.bytes.size() % 8;
    note("exchange", rest);
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
};

// claim    the shadow asks of a team what the filter asks, in its order
// referee  the filter of --engine mpi
TEST(Shadow, AsksWhatTheFilterAsks) {
  const auto model = find_model("bearings", "test").make(Settings("test", {}), {});
  const Recording recording = simulated_scene(*model, 5, 1).recording;
  std::vector<std::string> of_filter;
  std::vector<std::string> of_shadow;
  ThreadTeams(3).run([&](Team& team) {
    std::vector<std::string> notes;
    NotingTeam noting(team, notes);
    Plan plan;
    plan.particles = 9000;
    plan.engine = Engine::kMpi;
    plan.team = &noting;
    RunRequest request;
    request.states = model->states();
    const auto filter = model->filter(plan, "test");
    run(*filter, plan, recording, request);
    if (team.rank() == 1) of_filter = notes;
  });
  ThreadTeams(3).run([&](Team& team) {
    std::vector<std::string> notes;
    NotingTeam noting(team, notes);
    const ShadowCloud cloud{.particles = 9000, .dimensions = 4};
    std::vector<std::byte> anywhere(Shadow::parcel_bytes(cloud, 3));
    Shadow shadow(noting, cloud, anywhere);
    for (Step t = 1; t <= 5; ++t) shadow.step(t, [] {});
    if (team.rank() == 1) of_shadow = notes;
  });
  EXPECT_EQ(of_shadow, of_filter);
  EXPECT_GT(of_shadow.size(), 40U);
}

}  // namespace
}  // namespace mote::testing
