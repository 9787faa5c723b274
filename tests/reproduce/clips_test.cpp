// Items on clips: how they are read and refused, the clip that is drawn, and what `mote reproduce` makes of them.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mote/app/files/text.hpp"
#include "mote/app/reproduce/drawn_clip.hpp"
#include "mote/app/reproduce/laboratory.hpp"
#include "mote/app/reproduce/script.hpp"
#include "mote/base/refusal.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kDrawn = "[drawn]\nframes = 6\nseed = 3\noptions = [\"--particle-count\", \"fixed\"]\n";

/// An item on a clip; the line after [[run]]'s options is 14 when the source has four lines.
std::string clip_item(const std::string& source, const std::string& run = "", const std::string& end = "") {
  return "item = \"Fig. 0\"\ntitle = \"a track\"\nsource = \"a test\"\nprinted = \"nothing\"\n" + source +
         R"([[run]]
name = "all"
options = ["--states", "scale"]
particles = [30, 60]
[[run]]
name = "fixed"
)" + run +
         R"(
[[figure]]
title = "sweep"
[[figure]]
title = "frames"
runs = ["fixed"]
frames = [1, 3, 6]
[[compare]]
name = "overlap"
kind = "track"
key = "overlap"
runs = ["fixed"]
repeats = 2
at_least = 0.5
[[compare]]
name = "enough"
kind = "particles-enough"
runs = ["all"]
slack = 1000
repeats = 2
at_most = 30
)" + end;
}

reproduce::Item item_from(const Scratch& scratch, const std::string& text) {
  scratch.write("item.toml", text);
  return reproduce::read_item(scratch.file("item.toml"), "ppf");
}

TEST(ClipItems, AListOfParticlesIsASeriesOfRuns) {
  const Scratch scratch;
  const reproduce::Item item = item_from(scratch, clip_item(kDrawn));
  ASSERT_EQ(item.runs.size(), 3U);
  EXPECT_EQ(item.runs[0].name, "all 30");
  EXPECT_EQ(item.runs[1].name, "all 60");
  EXPECT_EQ(item.runs[1].series, "all");
  EXPECT_EQ(item.runs[1].number, 60);
  EXPECT_EQ(item.runs[2].series, "");
  EXPECT_EQ(reproduce::Laboratory(item).work(), 2U + 2 * 2U + 1U);  // overlap, enough, frames
  EXPECT_EQ(reproduce::script_for(item), "");
}

TEST(ClipItems, AreRefusedByLine) {
  const Scratch scratch;
  const std::string clip = "[clip]\nvideo = \"v\"\ntruth = \"t\"\ninit = \"1,2,30,30\"\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {clip_item(clip), "item.toml:5: \"frames\": expected an integer"},
      {clip_item(kDrawn + "[weights]\n"),
       "one of the tables [simulate], [data], [weights], [clip], [drawn], [cluster], [design] and [analog]"},
      {clip_item(kDrawn, "options = [\"--statse\", \"scale\"]"), "item.toml:13"},
      {clip_item(kDrawn, "options = [\"--states\", \"scale\"]\nset = [\"q=1\"]"), "\"set\": expected one of"},
      {clip_item(kDrawn, "particles = [60, 30]"), "\"particles\": expected a list of whole numbers from 1 on, rising"},
      {clip_item(kDrawn, "particles = [0]"), "\"particles\": expected a list of whole numbers"},
      {clip_item(kDrawn, "", "[[figure]]\ntitle = \"two\"\nruns = [\"all\"]\nframes = [1]\n"),
       "names of the item's runs"},
      {clip_item(kDrawn, "", "[[figure]]\ntitle = \"none\"\nframes = [1]\n"), "the one run whose frames are shown"},
      {clip_item(kDrawn, "", "[[compare]]\nname = \"n\"\nkind = \"rmse\"\n"), "one of track, particles-enough"},
      {clip_item(kDrawn, "", "[[compare]]\nname = \"n\"\nkind = \"track\"\nkey = \"luck\"\nruns = [\"fixed\"]\n"),
       "one of overlap, centre_error_px"},
      {clip_item(kDrawn, "", "[[compare]]\nname = \"n\"\nkind = \"particles-enough\"\nruns = [\"fixed\"]\n"),
       "names of runs with lists of particles"},
  };
  for (const auto& [text, says] : cases) try {
      const reproduce::Laboratory laboratory(item_from(scratch, text));
      ADD_FAILURE() << "accepted: " << says;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(refusal.code(), ExitCode::kBadData) << refusal.what();
      EXPECT_NE(std::string(refusal.what()).find(says), std::string::npos) << refusal.what() << "\n" << says;
    }
}

TEST(ClipItems, TheirCommandsNameTheFolderOfData) {
  const Scratch scratch;
  const std::string clip = "[clip]\nvideo = \"clips/a b\"\ntruth = \"t.txt\"\ninit = \"1,2,30,30\"\nframes = 4\n";
  const std::string script = reproduce::script_for(item_from(scratch, clip_item(clip)));
  EXPECT_TRUE(
      script.starts_with("mote track \"$MOTE_DATA\"/'clips/a b' --init 1,2,30,30 --truth \"$MOTE_DATA\"/t.txt "
                         "--frames 4 --states scale --particles 30 --summary ppf-fig-0-all-30.json\n"))
      << script;
}

// the texture under the box moves with the truth; noise apart
TEST(DrawnClip, TheTargetIsWhereTheTruthSays) {
  const Scratch scratch;
  const std::string init = reproduce::draw_clip(scratch.path(), 20, 4);
  const std::string truth = scratch.read("truth.csv");
  const auto lines = parts_of(truth, '\n');
  ASSERT_EQ(lines.size(), 22U);  // a header, 20 frames, nothing after the last line's end
  const auto level_at = [&](std::size_t frame, double u, double v) {
    const auto fields = parts_of(lines[frame + 1], ',');
    const auto number = [&](std::size_t column) { return number_in(fields[column]).value(); };
    const std::string pgm = scratch.read(fmt::format("f{:04}.pgm", frame + 1));
    const auto x = static_cast<std::size_t>(number(1) + u * number(3));
    const auto y = static_cast<std::size_t>(number(2) + v * number(4));
    return static_cast<double>(static_cast<unsigned char>(pgm.at(15 + 320 * y + x)));
  };
  double inside = 0;
  double outside = 0;
  for (const double u : {0.2, 0.4, 0.6, 0.8})
    for (const double v : {0.2, 0.4, 0.6, 0.8}) {
      inside += std::abs(level_at(0, u, v) - level_at(19, u, v)) / 16;
      outside += std::abs(level_at(0, u - 1.2, v) - level_at(19, u - 1.2, v)) / 16;
    }
  EXPECT_LT(inside, 25);
  EXPECT_GT(outside, 30);
  EXPECT_TRUE(truth.starts_with("frame,x,y,w,h\n1," + init + "\n")) << init;
}

/// A program with its tracker beside it and one item of a paper.
struct Press : Scratch {
  explicit Press(const std::string& item) {
    for (const std::string folder : {"bin", "papers/ppf"}) fs::create_directories(path() / folder);
    const fs::path program(MOTE_PROGRAM);
    for (const std::string name : {"mote", "mote-track"})
      if (fs::exists(program.parent_path() / name)) fs::copy_file(program.parent_path() / name, path() / "bin" / name);
    write("papers/ppf/item.toml", item);
  }
  Ended reproduce(const std::string& out, const std::string& before = "") const {
    return shell(before + " bin/mote reproduce ppf --out " + out);
  }
};

TEST(ReproduceClips, ADrawnClipIsTrackedComparedAndShown) {
  const Press press(clip_item(kDrawn));
  const Ended ended = press.reproduce("r");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json comparison = Json::parse(press.read("r/comparison.json"));
  ASSERT_EQ(comparison.size(), 2U);
  EXPECT_GT(comparison[0]["ours"].get<double>(), 0.5) << comparison.dump();
  EXPECT_EQ(comparison[1]["ours"], 30.0);
  const std::string csv = press.read("r/ppf-fig-0.csv");
  EXPECT_TRUE(csv.starts_with("run,particles,repeat,overlap,centre_error_px,success,lost_frames,frames_per_second,"))
      << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(press.read("r/index.html").find("src=\"data:image/jpeg;base64,/9j/"), std::string::npos);
}

TEST(ReproduceClips, AClipThatIsNotThereIsSkippedInWords) {
  const Press press(clip_item("[clip]\nvideo = \"clips/none\"\ntruth = \"t.txt\"\ninit = \"1,2,30,30\"\nframes = 4\n"));
  const Ended ended = press.reproduce("r", "MOTE_DATA=/nowhere");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string sentence =
      "skipped ppf Fig. 0: there is no /nowhere/clips/none. Set MOTE_DATA to the folder with clips/.";
  EXPECT_NE(ended.out.find(sentence), std::string::npos) << ended.out;
  EXPECT_NE(press.read("r/index.html").find(sentence), std::string::npos);
  EXPECT_EQ(Json::parse(press.read("r/comparison.json")), Json::array());
}

TEST(ReproduceClips, WithoutTheTrackerNoClipIsTracked) {
  const Press press(clip_item(kDrawn));
  fs::remove(press.path() / "bin/mote-track");
  const Ended ended = press.reproduce("r");
  EXPECT_EQ(ended.code, 5);
  EXPECT_NE(ended.err.find("expected the program that tracks, beside mote"), std::string::npos) << ended.err;
}

TEST(ReproduceClips, WhatTheTrackerRefusesIsSaid) {
  const Press press(clip_item("[clip]\nvideo = \"v\"\ntruth = \"t.txt\"\ninit = \"1,2,30,30\"\nframes = 4\n"));
  press.write("t.txt", "1,2,3,4\n");
  press.write("v", "no video");
  const Ended ended = press.reproduce("r", "MOTE_DATA=.");
  EXPECT_EQ(ended.code, 5);
  EXPECT_NE(ended.err.find("ppf Fig. 0: ./v: expected a video with at least one frame"), std::string::npos)
      << ended.err;
  EXPECT_EQ(ended.err.find('?'), std::string::npos) << ended.err;  // a line's end shown as a control character
  EXPECT_FALSE(fs::exists(press.path() / "r/index.html"));
}

}  // namespace
}  // namespace mote::testing
