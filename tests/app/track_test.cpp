// mote track as a user meets it: made video with exact truth, files, bad input; real clips where there are any.

#include <cmath>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "mote/vision/detector.hpp"
#include "mote/vision/drawing.hpp"
#include "mote/vision/synthetic.hpp"
#include "tests/app/program.hpp"

namespace mote::testing {
namespace {

using vision::Box;
using vision::box_of;
using vision::testing::pose_at;
using vision::testing::Stage;

vision::Pose pose_in(int k) { return pose_at(80 + 2.0 * k, 90 + 0.5 * k); }

/// A scratch folder with the pictures f001.png ... f<frames>.png and the truth as CSV.
struct Video : Scratch {
  Stage stage;
  std::string init;

  explicit Video(int frames = 20) {
    std::string truth = "frame,x,y,w,h\n";
    for (int k = 0; k < frames; ++k) {
      const Box box = box_of(pose_in(k), stage.first);
      char name[16];
      std::snprintf(name, sizeof name, "f%03d.png", k + 1);
      cv::imwrite(file(name), stage.frame(pose_in(k)));
      truth += std::to_string(k + 1) + "," + std::to_string(box.x) + "," + std::to_string(box.y) + "," +
               std::to_string(box.w) + "," + std::to_string(box.h) + "\n";
      if (k == 0) init = std::to_string(box.x) + "," + std::to_string(box.y) + ",48,40";
    }
    write("truth.csv", truth);
  }
  Ended track(const std::string& more) const { return shell("mote track f%03d.png -n 200 " + more); }
};

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Track, WritesBoxesVideoReportAndSummary) {
  const Video video;
  const Ended ended = video.track("--init " + video.init +
                                  " --truth truth.csv --out b.csv --summary s.json --video v.avi --report r.html");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("mean overlap"), std::string::npos);
  const std::string boxes = video.read("b.csv");
  EXPECT_EQ(lines_of(boxes), 21U);
  EXPECT_TRUE(boxes.starts_with(
      "frame,x,y,w,h,score,lost,centre_x,centre_y,log_w,log_h,angle,skew\n1,56,70,48,40,1,0,80,90,0,0,0,0\n"));
  const auto summary = nlohmann::json::parse(video.read("s.json"));
  EXPECT_GT(summary["overlap"].get<double>(), 0.85);
  EXPECT_LT(summary["centre_error_px"].get<double>(), 2);
  EXPECT_EQ(summary["frames"], 20);
  EXPECT_EQ(summary["lost_frames"], 0);
  const auto& frame = summary["frame_ms"];
  EXPECT_GT(frame["p50"].get<double>(), 0);
  EXPECT_GE(frame["p99"].get<double>(), frame["p50"].get<double>());
  EXPECT_GE(frame["max"].get<double>(), frame["p99"].get<double>());
  for (const std::string stage : {"tp", "tw", "td"}) EXPECT_GT(summary["particle_us"][stage].get<double>(), 0) << stage;
  EXPECT_GT(summary["particle_us"]["tw"].get<double>(), summary["particle_us"]["td"].get<double>());
  EXPECT_GT(video.read("v.avi").size(), 10000U);
  EXPECT_NE(video.read("r.html").find("Overlap with the truth"), std::string::npos);
}

TEST(Track, OneSeedOneFile) {
  const Video video(8);
  for (const std::string run : {"--out a.csv --threads 1", "--out b.csv --threads 2", "--out c.csv --seed 2"})
    EXPECT_EQ(video.track("--init " + video.init + " " + run).code, 0);
  EXPECT_EQ(video.read("a.csv"), video.read("b.csv"));
  EXPECT_NE(video.read("a.csv"), video.read("c.csv"));
}

TEST(Track, EveryFilterStateAndLikelihood) {
  const Video video(6);
  for (const std::string options :
       {"--filter imh", "--filter imh --improved", "--filter auxiliary",
        "--filter distributed --groups 4 --exchange swap", "--filter sqmc", "--precision float", "--states location",
        "--states scale --motion second", "--motion walk", "--likelihood mixture", "--likelihood distance",
        "--particle-count fixed"}) {
    const Ended ended = video.track("--init " + video.init + " --truth truth.csv --summary s.json " + options);
    ASSERT_EQ(ended.code, 0) << options << ended.err;
    EXPECT_GT(nlohmann::json::parse(video.read("s.json"))["overlap"].get<double>(), 0.7) << options;
  }
}

TEST(Track, TruthsOfBothBenchmarks) {
  const Video video(5);
  std::string otb;
  std::string tld;
  for (int k = 0; k < 5; ++k) {
    const Box b = box_of(pose_in(k), video.stage.first);
    const auto text = [](double x) { return std::to_string(x); };
    otb += text(b.x + 1) + "\t" + text(b.y + 1) + "\t48\t40\n";
    tld +=
        k == 3 ? "NaN,NaN,NaN,NaN\n" : text(b.x) + "," + text(b.y) + "," + text(b.x + 48) + "," + text(b.y + 40) + "\n";
  }
  video.write("otb.txt", otb);
  video.write("tld.txt", tld);
  for (const std::string name : {"otb.txt", "tld.txt"}) {
    ASSERT_EQ(video.track("--init " + video.init + " --summary s.json --truth " + name).code, 0);
    EXPECT_GT(nlohmann::json::parse(video.read("s.json"))["overlap"].get<double>(), 0.85) << name;
  }
}

TEST(Track, WhatWasTrackedBeforeABadFrameIsWritten) {
  const Video video(6);
  video.write("f004.png", "no picture");
  const Ended ended = video.track("--init " + video.init + " --out b.csv");
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("f004.png: expected a picture, got a file that cannot be decoded."), std::string::npos)
      << ended.err;
  EXPECT_EQ(lines_of(video.read("b.csv")), 4U);
}

TEST(Track, TheFirstFramesOnly) {
  const Video video(6);
  const Ended ended = video.track("--init " + video.init + " --out b.csv --frames 3 --video out%d.png");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(lines_of(video.read("b.csv")), 4U);
  EXPECT_FALSE(video.read("out3.png").empty());
  EXPECT_TRUE(video.read("out4.png").empty());
  ASSERT_EQ(video.track("--init " + video.init + " --out all.csv --frames 100").code, 0);
  EXPECT_EQ(lines_of(video.read("all.csv")), 7U);
}

TEST(Track, ASheetOfFrames) {
  const Video video(5);
  const Ended ended = video.track("--init " + video.init + " --sheet s.png --sheet-frames 1,3,5,9 --report r.html");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(cv::imread(video.file("s.png")).size(), cv::Size(3 * 320 + 8, 240));
  EXPECT_NE(video.read("r.html").find("<img alt=\"Frames\" src=\"data:image/png;base64,"), std::string::npos);
}

TEST(Track, AVideoCutShortIsTrackedToItsEndAndRefused) {
  const Video video(1);
  {
    vision::Film film(video.file("v.avi"), 25);
    for (int k = 0; k < 12; ++k) film.add(video.stage.frame(pose_in(k)));
    film.commit();
  }
  const auto path = video.path() / "v.avi";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) * 2 / 3);
  const std::string track = "mote track v.avi -n 100 --init " + video.init + " --out b.csv --summary s.json";
  const Ended ended = video.shell(track);
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("v.avi: expected a whole video, got a file cut short after "), std::string::npos)
      << ended.err;
  const auto frames = nlohmann::json::parse(video.read("s.json"))["frames"].get<std::size_t>();
  EXPECT_GT(frames, 4U);
  EXPECT_LT(frames, 12U);
  EXPECT_EQ(lines_of(video.read("b.csv")), frames + 1);
  EXPECT_EQ(video.shell(track + " --frames " + std::to_string(frames)).code, 0);
}

struct Case {
  std::string name, options;
  int code;
  std::string sentence;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class TrackRefused : public ::testing::TestWithParam<Case> {};

TEST_P(TrackRefused, InOneSentence) {
  const Video video(2);
  const auto before = video.files();
  const Ended ended = video.shell("mote track " + GetParam().options);
  EXPECT_EQ(ended.code, GetParam().code) << ended.err;
  EXPECT_EQ(lines_of(ended.err), 1U) << ended.err;
  EXPECT_NE(ended.err.find(GetParam().sentence), std::string::npos) << ended.err;
  EXPECT_EQ(before, video.files());
}

INSTANTIATE_TEST_SUITE_P(
    All, TrackRefused,
    ::testing::Values(
        Case{"NoBox", "f%03d.png --out b.csv", 2, "expected a first box, or --detect, got neither"},
        Case{"BoxOutside", "f%03d.png --init 900,10,40,40 --out b.csv", 2,
             "at least half inside the frame of 320 x 240"},
        Case{"BoxNoNumbers", "f%03d.png --init 1,2,nan,4 --out b.csv", 2, "expected x,y,w,h in pixels"},
        Case{"BoxTooSmall", "f%03d.png --init 1,2,3,3 --out b.csv", 2, "at least 4"},
        Case{"NoFrames", "f%03d.png --init 1,2,30,30 --frames 0", 2, "--frames: expected an integer from 1"},
        Case{"OverAFrame", "f%03d.png --init 1,2,30,30 --out f002.png", 2, "a file that this command reads"},
        Case{"PicturesOverFrames", "f%03d.png --init 1,2,30,30 --out b.csv --video f%03d.png", 2,
             "f001.png: expected an output in a file of its own"},
        Case{"PicturesOverAFolder", ". --init 1,2,30,30 --video ./f%03d.png", 2, "a file that this command reads"},
        Case{"OverTheTruth", "f%03d.png --init 1,2,30,30 --truth truth.csv --report truth.csv", 2,
             "truth.csv: expected an output in a file of its own"},
        Case{"VideoOverTheTruth", "f%03d.png --init 1,2,30,30 --truth truth.csv --video truth.csv", 2,
             "truth.csv: expected an output in a file of its own"},
        Case{"TwoToOne", "f%03d.png --init 1,2,30,30 --out b.csv --summary ./b.csv", 2,
             "the same file for two outputs"},
        Case{"VideoAndReport", "f%03d.png --init 1,2,30,30 --report v.avi --video v.avi", 2,
             "the same file for two outputs"},
        Case{"SheetEnding", "f%03d.png --init 1,2,30,30 --sheet s.gif", 2, "a name that ends in .png or .jpg"},
        Case{"SheetFrames", "f%03d.png --init 1,2,30,30 --sheet s.png --sheet-frames 1,0", 2,
             "numbers of frames from 1"},
        Case{"NoVideo", "none.mp4 --init 1,2,30,30 --out b.csv", 3, "none.mp4: expected a video file"},
        Case{"Corrupt", "truth.csv --init 1,2,30,30 --out b.csv", 3, "truth.csv: expected a video"},
        Case{"Gaussian", "f%03d.png --init 1,2,30,30 --filter ekf", 2, "a picture has no slope"},
        Case{"VectorEngine", "f%03d.png --init 1,2,30,30 --engine simd", 2, "--engine: expected reference"},
        Case{"NoDisplay", "f%03d.png --init 1,2,30,30 --show", 5, "--show: expected a display"},
        Case{"NoDisplayToDrawOn", "f%03d.png --show --out b.csv", 5, "--show: expected a display, got none"},
        Case{"DetectorAlone", "f%03d.png --init 1,2,30,30 --detector people", 2, "--detect beside it"},
        Case{"NoDetector", "f%03d.png --detect --detector truth.csv", 3, "truth.csv: expected a detector"},
        Case{"TruthLine", "f%03d.png --init 1,2,30,30 --truth f001.png", 3, "f001.png"},
        Case{"VideoNowhere", "f%03d.png --init 1,2,30,30 --video no/v.mp4", 6, "no/v.mp4"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Track, ADisplayThatOpensNoWindowIsRefused) {
  const Video video(2);
  const Ended ended = video.shell("DISPLAY=:4321 mote track f%03d.png --show --out b.csv");
  EXPECT_EQ(ended.code, 5) << ended.err;
  EXPECT_NE(ended.err.find("--show: expected a display, got one that opens no window."), std::string::npos)
      << ended.err;
}

/// A display without a screen, with a mouse that draws from (60, 90) of the window over 48 x 40 pixels, then a key.
std::string with_mouse(const std::string& key, const std::string& track) {
  return "Xvfb -displayfd 7 -screen 0 640x480x24 7>display 2>log & server=$!; trap 'kill $server' EXIT; "
         "for i in $(seq 100); do [ -s display ] && break; sleep 0.1; done; export DISPLAY=:$(cat display); "
         "{ window=$(timeout 20 xdotool search --sync --onlyvisible --name 'mote track' | tail -n 1); sleep 1; "
         "xdotool mousemove --window $window 60 90 mousedown 1; sleep 0.2; xdotool mousemove_relative 20 20; sleep "
         "0.2; "
         "xdotool mousemove_relative 28 20; sleep 0.2; xdotool mouseup 1; sleep 0.2; xdotool key " +
         key + "; } >>log 2>&1 & timeout 60 " + track;
}

TEST(Track, TheMouseDrawsTheBox) {
  if (std::system("command -v Xvfb >/dev/null && command -v xdotool >/dev/null") != 0)
    GTEST_SKIP() << "Xvfb or xdotool is not installed.";
  const Video video(2);
  const std::string track = "'" MOTE_PROGRAM "' track f%03d.png --show --out - -n 100";
  const Ended drawn = video.shell(with_mouse("Return", track));
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  double x = 0;
  double y = 0;
  double w = 0;
  double h = 0;
  const std::string first = drawn.out.substr(drawn.out.find('\n') + 1);
  ASSERT_EQ(std::sscanf(first.c_str(), "1,%lf,%lf,%lf,%lf,", &x, &y, &w, &h), 4) << drawn.out;
  EXPECT_NEAR(w, 48, 1);
  EXPECT_NEAR(h, 40, 1);
  EXPECT_NEAR(x, 60, 4);
  EXPECT_TRUE(drawn.out.starts_with("frame,x,y,w,h,")) << drawn.out;
  EXPECT_NE(drawn.err.find("The box was drawn: --init "), std::string::npos) << drawn.err;
  const Ended off = video.shell(with_mouse("c", track));
  EXPECT_EQ(off.code, 2) << off.err;
  EXPECT_NE(off.err.find("drawn with the mouse, got none. Pass --init x,y,w,h instead."), std::string::npos) << off.err;
}

TEST(Track, TheDetectorIsNotWrittenOver) {
  const Video video(2);
  video.shell("for i in $(seq 1765); do echo 0; done >d.txt");
  const Ended ended = video.track("--detect --detector d.txt --out d.txt");
  EXPECT_EQ(ended.code, 2) << ended.err;
  EXPECT_NE(ended.err.find("a file that this command reads"), std::string::npos) << ended.err;
}

TEST(Train, PatchesAndScenesAreNotWrittenOver) {
  const Video video(1);
  cv::imwrite(video.file("p.png"), vision::testing::texture({128, 128}, 9, 1));
  for (const std::string out : {"p.png", "f001.png"}) {
    const Ended ended = video.shell("mote train --positives p.png --negatives p.png --scenes f%03d.png --out " + out);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_NE(ended.err.find("a file that this command reads"), std::string::npos) << ended.err;
  }
}

/// A bright square with a dark rim on texture: the target; crossed out, what looks like one.
cv::Mat sign_patch(bool crossed, unsigned seed) {
  cv::Mat patch = vision::testing::texture({64, 64}, 9, seed);
  cv::rectangle(patch, {12, 12, 40, 40}, cv::Scalar::all(240), cv::FILLED);
  cv::rectangle(patch, {12, 12, 40, 40}, cv::Scalar::all(10), 4);
  if (crossed) {
    cv::line(patch, {14, 14}, {50, 50}, cv::Scalar::all(10), 4);
    cv::line(patch, {14, 50}, {50, 14}, cv::Scalar::all(10), 4);
  }
  return patch;
}

cv::Mat mosaic_of_squares() {
  cv::Mat with(256, 512, CV_8UC3);
  for (int k = 0; k < 32; ++k)
    sign_patch(false, static_cast<unsigned>(k)).copyTo(with(cv::Rect(k % 8 * 64, k / 8 * 64, 64, 64)));
  return with;
}

/// Texture with patches in a row, `scale` times their size.
cv::Mat scene_with(bool crossed, int count, double scale, unsigned seed) {
  const int side = static_cast<int>(std::lround(64 * scale));
  cv::Mat scene = vision::testing::texture({side * count + 20, side + 20}, 9, seed);
  for (int k = 0; k < count; ++k) {
    cv::Mat patch;
    cv::resize(sign_patch(crossed, seed + 100 + static_cast<unsigned>(k)), patch, {side, side});
    patch.copyTo(scene(cv::Rect(10 + k * side, 10, side, side)));
  }
  return scene;
}

// claim    what scenes without targets show instead of them is learnt, whatever size and colours the scenes have
// twin     the detector without scenes takes what is crossed out for targets
TEST(Train, HardNegativesFromScenesOfAnySize) {
  const Scratch scratch;
  cv::imwrite(scratch.file("with.png"), mosaic_of_squares());
  cv::imwrite(scratch.file("without.png"), vision::testing::texture({512, 512}, 9, 77));
  std::filesystem::create_directory(scratch.path() / "scenes");
  unsigned seed = 500;
  for (const double scale : {0.4, 1.0, 1.5, 2.3}) {
    cv::Mat scene = scene_with(true, 5, scale, seed++);
    if (scale < 1) cv::cvtColor(scene, scene, cv::COLOR_BGR2GRAY);
    if (scale > 2) cv::cvtColor(scene, scene, cv::COLOR_BGR2BGRA);
    cv::imwrite(scratch.file("scenes/s" + std::to_string(seed) + ".png"), scene);
  }
  cv::imwrite(scratch.file("scenes/tiny.png"), vision::testing::texture({5, 300}, 2, 1));
  const std::string train = "mote train --positives with.png --negatives without.png ";
  ASSERT_EQ(scratch.shell(train + "--out plain.txt").code, 0);
  const Ended ended = scratch.shell(train + "--scenes scenes --out hard.txt");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out.find(" 0 of these hard negatives"), std::string::npos) << ended.out;
  const auto found = [&](const std::string& detector, bool crossed) {
    const auto all = vision::Detector::from_file(scratch.file(detector)).detect(scene_with(crossed, 5, 1.2, 900));
    return all.size();
  };
  EXPECT_GE(found("plain.txt", true), 4U);
  EXPECT_LE(found("hard.txt", true), 1U);
  EXPECT_GE(found("hard.txt", false), 4U);
}

TEST(Train, ADetectorOfSquaresFindsThem) {
  const Scratch scratch;
  const cv::Mat with = mosaic_of_squares();
  cv::imwrite(scratch.file("with.png"), with);
  cv::imwrite(scratch.file("without.png"), vision::testing::texture({512, 512}, 9, 77));
  const Ended ended = scratch.shell("mote train --positives with.png --negatives without.png --out d.txt");
  ASSERT_EQ(ended.code, 0) << ended.err;
  cv::Mat scene = vision::testing::texture({320, 240}, 9, 5);
  with(cv::Rect(64, 64, 64, 64)).copyTo(scene(cv::Rect(150, 90, 64, 64)));
  for (int k = 1; k < 4; ++k) cv::imwrite(scratch.file("s" + std::to_string(k) + ".png"), scene);
  const Ended tracked = scratch.shell("mote track s%d.png --detect --detector d.txt --out b.csv -n 100");
  ASSERT_EQ(tracked.code, 0) << tracked.err;
  std::stringstream lines(scratch.read("b.csv"));
  std::string line;
  std::getline(lines, line);
  for (int k = 1; k < 3; ++k) {  // what is seen once may be no target
    std::getline(lines, line);
    EXPECT_EQ(line, std::to_string(k) + ",nan,nan,nan,nan,0,1,nan,nan,nan,nan,nan,nan");
  }
  std::getline(lines, line);
  double box[5];
  ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", box, box + 1, box + 2, box + 3, box + 4), 5) << line;
  EXPECT_GT(vision::overlap({box[1], box[2], box[3], box[4]}, {150, 90, 64, 64}), 0.5) << line;
}

}  // namespace
}  // namespace mote::testing
