// mote track as a user meets it: made video with exact truth, files, bad input; real clips where there are any.

#include <cmath>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

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
        Case{"NoVideo", "none.mp4 --init 1,2,30,30 --out b.csv", 3, "none.mp4: expected a video file"},
        Case{"Corrupt", "truth.csv --init 1,2,30,30 --out b.csv", 3, "truth.csv: expected a video"},
        Case{"Gaussian", "f%03d.png --init 1,2,30,30 --filter ekf", 2, "a picture has no slope"},
        Case{"VectorEngine", "f%03d.png --init 1,2,30,30 --engine simd", 2, "--engine: expected reference"},
        Case{"NoDisplay", "f%03d.png --init 1,2,30,30 --show", 5, "--show: expected a display"},
        Case{"DetectorAlone", "f%03d.png --init 1,2,30,30 --detector people", 2, "--detect beside it"},
        Case{"NoDetector", "f%03d.png --detect --detector truth.csv", 3, "truth.csv: expected a detector"},
        Case{"TruthLine", "f%03d.png --init 1,2,30,30 --truth f001.png", 3, "f001.png"},
        Case{"VideoNowhere", "f%03d.png --init 1,2,30,30 --video no/v.mp4", 6, "no/v.mp4"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Train, ADetectorOfSquaresFindsThem) {
  const Scratch scratch;
  // targets: a bright square with a dark frame; others: texture
  cv::Mat with(256, 512, CV_8UC3);
  for (int k = 0; k < 32; ++k) {
    cv::Mat patch = with(cv::Rect(k % 8 * 64, k / 8 * 64, 64, 64));
    vision::testing::texture({64, 64}, 9, static_cast<unsigned>(k)).copyTo(patch);
    cv::rectangle(patch, {12, 12, 40, 40}, {240, 240, 240}, cv::FILLED);
    cv::rectangle(patch, {12, 12, 40, 40}, {10, 10, 10}, 4);
  }
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
