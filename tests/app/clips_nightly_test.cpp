// Real clips with true boxes, made by others: scored where MOTE_DATA has them, skipped with a word where it has not.

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

struct Clip {
  std::string name, frames, truth, init;
  double overlap;  // to reach, a mean over seeds
};
std::ostream& operator<<(std::ostream& out, const Clip& clip) { return out << clip.name; }

std::filesystem::path clips() {
  const char* data = std::getenv("MOTE_DATA");
  return std::filesystem::path(data != nullptr ? data : MOTE_SOURCE "/../shared/data") / "clips";
}

double mean_overlap(const Clip& clip, const std::string& options) {
  const Scratch scratch;
  double sum = 0;
  constexpr int kSeeds = 3;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Ended ended = scratch.shell("mote track '" + (clips() / clip.frames).string() + "' --truth '" +
                                      (clips() / clip.truth).string() + "' --init " + clip.init +
                                      " --summary s.json --seed " + std::to_string(seed) + options);
    EXPECT_EQ(ended.code, 0) << ended.err;
    sum += nlohmann::json::parse(scratch.read("s.json"))["overlap"].get<double>();
  }
  return sum / kSeeds;
}

class Clips : public ::testing::TestWithParam<Clip> {};

// claim    default options follow the target: the mean overlap reaches what is asked on every clip
// referee  boxes drawn by hand, published with the clips
// design   seeds 1 to 3, fixed: the verdict never flickers
// risk     none of chance; the twin (the appearance alone, without the filters of place and extent) must fail on the
// clip
//          with a full occlusion
TEST_P(Clips, ReachTheOverlapAsked) {
  const Clip& clip = GetParam();
  if (!std::filesystem::exists(clips() / clip.truth))
    GTEST_SKIP() << clips() << " does not have " << clip.frames << ". Set MOTE_DATA to the folder with clips/.";
  EXPECT_GE(mean_overlap(clip, ""), clip.overlap);
}

// claim    IMH is as good as SISR at the same number of likelihoods
TEST_P(Clips, ImhIsWithinTwoHundredthsOfSisr) {
  const Clip& clip = GetParam();
  if (!std::filesystem::exists(clips() / clip.truth))
    GTEST_SKIP() << clips() << " does not have " << clip.frames << ". Set MOTE_DATA to the folder with clips/.";
  EXPECT_NEAR(mean_overlap(clip, " --filter imh"), mean_overlap(clip, ""), 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    All, Clips,
    ::testing::Values(Clip{"car4", "otb_car4/img", "otb_car4/groundtruth_rect.txt", "69,50,107,87", 0.85},
                      Clip{"crossing", "otb_crossing/img", "otb_crossing/groundtruth_rect.txt", "204,150,17,50", 0.75},
                      Clip{"jogging1", "otb_jogging/img", "otb_jogging/groundtruth_rect.1.txt", "110,97,25,101", 0.65},
                      Clip{"jogging2", "otb_jogging/img", "otb_jogging/groundtruth_rect.2.txt", "179,78,37,114", 0.74},
                      Clip{"david", "tld_david/david.mpg", "tld_david/gt.txt", "165,93,51,54", 0.70},
                      Clip{"pedestrian3", "tld_pedestrian3/pedestrian3.mpg", "tld_pedestrian3/gt.txt", "154,102,24,52",
                           0.75}),
    [](const auto& tested) { return tested.param.name; });

// claim    a pedestrian is found by the detector, lost behind the lamp post, and found again
// referee  the hand-drawn boxes of the jogger who is nearer at the start; the post hides her from frame 50 to 57
// design   seeds 1 to 3
// risk     none of chance
TEST(Clips, DetectionStartsSurvivesTheFullOcclusionAndReportsIt) {
  if (!std::filesystem::exists(clips() / "otb_jogging")) GTEST_SKIP() << clips() << " does not have otb_jogging.";
  for (const std::string seed : {"1", "2", "3"}) {
    const Scratch scratch;
    const Ended ended = scratch.shell("mote track '" + (clips() / "otb_jogging/img").string() + "' --truth '" +
                                      (clips() / "otb_jogging/groundtruth_rect.2.txt").string() +
                                      "' --truth-format otb --detect --summary s.json --out b.csv --seed " + seed);
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_GT(nlohmann::json::parse(scratch.read("s.json"))["overlap"].get<double>(), 0.6) << seed;
    std::stringstream lines(scratch.read("b.csv"));
    std::string line;
    std::getline(lines, line);
    int hidden = 0;
    for (int frame = 1; std::getline(lines, line); ++frame) {
      std::size_t comma = 0;
      for (int k = 0; k < 6; ++k) comma = line.find(',', comma) + 1;
      const bool lost = line[comma] == '1';
      if (frame >= 50 && frame < 58) hidden += lost;
      const bool in_view = (frame > 5 && frame < 45) || frame > 70;
      EXPECT_FALSE(lost && in_view) << seed << ": " << line;
    }
    EXPECT_GE(hidden, 3) << seed;
  }
}

TEST(Clips, TheAppearanceAloneDoesNotReachTheOverlapAsked) {
  const Clip clip{"jogging2", "otb_jogging/img", "otb_jogging/groundtruth_rect.2.txt", "179,78,37,114", 0.74};
  if (!std::filesystem::exists(clips() / clip.truth))
    GTEST_SKIP() << clips() << " does not have " << clip.frames << ".";
  EXPECT_LT(mean_overlap(clip, " --likelihood mixture --motion walk"), clip.overlap - 0.05);
}

}  // namespace
}  // namespace mote::testing
