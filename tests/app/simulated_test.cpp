// `mote simulate-cluster`: simulated times against laws worked by hand.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mote/app/simulated/platform.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

class SimulatedCluster : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!kSimulates) GTEST_SKIP() << "built without SimGrid";
  }

  nlohmann::json sweep(const std::string& words) const {
    const Ended ended = scratch_.shell("mote simulate-cluster " + words + " --json s.json");
    EXPECT_EQ(ended.code, 0) << ended.err;
    return nlohmann::json::parse(scratch_.read("s.json"));
  }
  nlohmann::json runs(const std::string& words) const { return sweep(words).at("runs"); }
  static double seconds(const nlohmann::json& run) { return run.at("seconds_per_step").get<double>(); }

  static double sent_bytes(const nlohmann::json& run) { return run.at("bytes_per_step").get<double>(); }

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

// claim    a step is predicted within 10 %, messages included
// referee  SimGrid
// twin     the laws of stages whose messages take no time, on a network that does take time
TEST_F(SimulatedCluster, IsPredicted) {
  const auto worst = [](const nlohmann::json& all, const std::string& by) {
    double most = 0;
    for (const auto& run : all) most = std::max(most, std::abs(seconds(run) / run.at(by).get<double>() - 1));
    return most;
  };
  const std::string visual = "--stage-parallel --platform red -n 840 --dimensions 6 --tp 8e-6 --tw 1.1e-3 --td 1e-6 ";
  const auto weighers = runs(visual + "--filter imh --weighers 1,6 --steps 2");
  EXPECT_LT(worst(weighers, "predicted_seconds"), 0.1);
  EXPECT_GT(worst(weighers, "law_seconds"), 0.05);
  EXPECT_LT(worst(runs(visual + "--filter sisr --weighers 1,6 --steps 2"), "predicted_seconds"), 0.1);
  EXPECT_LT(worst(runs("--ranks 1,4,16 -n 20000 --tp 5e-9 --ess 0.4 --steps 40"), "predicted_seconds"), 0.1);
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

// claim    groups on cores of a ring send their neighbours what they exchange, and no more
// referee  K letters of M particles, a state of 8 bytes and a weight of 8, over one hop of 10 ns at 400 MB/s
TEST_F(SimulatedCluster, ExchangesAlongTheRing) {
  const std::string words =
      "--filter distributed --platform ring:16 --ranks 4,16 -n 1024 --tp 1e-6 --ess 0.4 --steps 4 --exchange swap";
  const auto two = sweep(words + " --exchange-count 2");
  const auto& none = two.at("beside")[0];
  EXPECT_EQ(none.at("name"), "no exchange");
  EXPECT_EQ(two.at("beside")[1].at("filter"), "sisr");
  for (const std::size_t k : {1, 2}) {
    const double cores = two.at("runs")[k].at("ranks").get<double>();
    EXPECT_NEAR(sent_bytes(two.at("runs")[k]) - sent_bytes(none.at("runs")[k]), cores * 2 * 16, 1e-3) << cores;
    const double exchange = seconds(two.at("runs")[k]) - seconds(none.at("runs")[k]);
    EXPECT_GT(exchange, 0.9 * (10e-9 + 32 / 400e6)) << cores;
    EXPECT_LT(exchange, 2e-6) << "a letter waits for its sender, too, which may come late from the sums before";
    EXPECT_EQ(two.at("runs")[k].at("groups"), cores);
    EXPECT_LT(sent_bytes(two.at("runs")[k]), sent_bytes(two.at("beside")[1].at("runs")[k])) << "sums of all weights";
  }
  EXPECT_EQ(two.at("beside")[1].at("runs").size(), 3U);
  const auto both = runs(words + " --topology bidirectional --exchange-every 2")[2];
  EXPECT_NEAR(sent_bytes(both) - sent_bytes(none.at("runs")[2]), 16 * 2 * 16 / 2.0, 1e-3) << "two of four steps";
}

// claim    several groups on a core keep between them what they exchange
TEST_F(SimulatedCluster, KeepsGroupsTogether) {
  const std::string words =
      "--strong --filter distributed --platform ring:4 --ranks 4 -n 4096 --groups 16 --tp 1e-6 --ess 0.4 --steps 2";
  const auto some = sweep(words + " --exchange append");
  const auto last = [](const nlohmann::json& list) { return list.back(); };
  EXPECT_NEAR(sent_bytes(last(some.at("runs"))) - sent_bytes(last(some.at("beside")[0].at("runs"))), 4 * 16, 1e-3)
      << "the last of a core's four groups sends its letter over a hop";
  const Ended table = scratch_.shell("mote simulate-cluster " + words + " --exchange append --report r.html");
  EXPECT_NE(table.out.find("append 1 on ring\n"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("global resampling (sisr)\n"), std::string::npos) << table.out;
  EXPECT_NE(scratch_.read("r.html").find("Bytes sent"), std::string::npos);
}

// claim    ranks with chains hand all that these keep to all
// referee  an allgather of 4096 numbers: every rank takes in three quarters of them at 12.5 MB/s
TEST_F(SimulatedCluster, HandsOnWhatChainsKeep) {
  const std::string words = "--strong --platform red --ranks 4 -n 4096 --steps 2 --tp 1e-6 --filter ";
  const auto imh = runs(words + "imh --chains 8").back();
  const double waits = seconds(imh) - 1024e-6 - 3 * 1024 * 8 / 12.5e6;
  EXPECT_GT(waits, 8 * 2 * 70e-6) << "the others are for sums: 2 rounds each";
  EXPECT_LT(waits, 12 * 3 * 70e-6);
  EXPECT_NEAR(sent_bytes(imh), 4 * 3 * 1024 * 8, 0.1 * 4 * 3 * 1024 * 8);
  EXPECT_EQ(runs(words + "auxiliary --chains 8").back(), imh) << "pairs of state and parent travel alike";
  const auto weighted = runs(words + "imh --chains 8 --chain-start weighted").back();
  EXPECT_NEAR(sent_bytes(weighted), 2 * sent_bytes(imh), 0.1 * sent_bytes(imh)) << "all weights to all";
}

// claim    a host that is slower takes so many times what was measured
TEST_F(SimulatedCluster, SlowsDownWhatWasMeasured) {
  const auto json = sweep("--filter imh --stage-parallel --platform ideal -n 840 --slower 1000 --steps 2");
  EXPECT_GT(json.at("tp").get<double>(), 1e-6) << "no core takes a nanosecond for a normal number and a cosine";
  EXPECT_LT(json.at("tp").get<double>(), 1e-2);
  EXPECT_EQ(json.at("times"), "measured on one core of this machine, times 1000");
}

// claim    platforms are what their files in data/platforms say
TEST(Platforms, AreReadFromTheirFiles) {
  const simulated::Platform red = simulated::platform_from("red", "test");
  EXPECT_EQ(red.hosts, 16U);
  EXPECT_DOUBLE_EQ(red.link_latency_s, 35e-6);
  EXPECT_DOUBLE_EQ(red.bandwidth, 12.5e6);
  EXPECT_FALSE(red.ring);
  const simulated::Platform ring = simulated::platform_from("ring:5", "test");
  EXPECT_EQ(ring.hosts, 5U);
  EXPECT_DOUBLE_EQ(ring.link_latency_s, 10e-9);
  EXPECT_TRUE(ring.ring);
  EXPECT_NE(ring.xml.find("radical=\"0-4\""), std::string::npos);
  EXPECT_NE(ring.xml.find("topo_parameters=\"5\""), std::string::npos);
  EXPECT_EQ(ring.xml.find('@'), std::string::npos) << "every place is filled in";
  EXPECT_EQ(simulated::host_list(ring), "host0\nhost1\nhost2\nhost3\nhost4\n");
  EXPECT_EQ(simulated::platform_from("modern", "test").hosts, 1024U);
  EXPECT_DOUBLE_EQ(simulated::platform_from("modern", "test").bandwidth, 12.5e9);
  EXPECT_EQ(simulated::platform_from("ideal", "test").link_latency_s, 0);
  EXPECT_EQ(simulated::platform_from("blue", "test").hosts, 12U);
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
           {"--filter imh --ess 0.4", 2, "--ess: expected --filter sisr or distributed"},
           {"--filter imh --chains 3 --ranks 4", 2, "--ranks: expected at most 3, a chain each, got 4"},
           {"--filter imh -n 300000000", 2, "--particles: expected an integer from 1 to 268435456"},
           {"--filter auxiliary --proposal observation", 2, "--proposal: expected prior"},
           {"--stage-parallel --filter imh --chain-start weighted", 2, "--chain-start: expected no --chain-start"},
           {"--stage-parallel --filter distributed", 2,
            "--filter: expected sisr, imh or auxiliary beside --stage-parallel, got distributed"},
           {"--groups 4", 2, "--groups: expected --filter distributed, got --filter sisr"},
           {"--exchange swap", 2, "--exchange: expected --filter distributed, got --filter sisr"},
           {"--filter distributed --exchange nope", 2, "--exchange: expected one of none, append, replace, swap"},
           {"--filter distributed --groups 2 -n 64 --ranks 4", 2, "--ranks: expected at most 2, a group each, got 4"},
           {"--filter distributed --exchange swap --exchange-count 9 -n 8 --ranks 4", 2,
            "--exchange-count: expected an integer from 1 to 8"},
           {"--filter distributed --exchange append --topology hypercube -n 64 --ranks 3", 2,
            "--topology hypercube: expected a power of two"},
           {"--slower 2", 2, "--slower: expected no --slower beside --tp"},
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

}  // namespace
}  // namespace mote::testing
