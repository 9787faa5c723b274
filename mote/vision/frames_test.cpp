#include "mote/vision/frames.hpp"

#include <filesystem>
#include <fstream>

#include <opencv2/imgcodecs.hpp>

#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/vision/drawing.hpp"
#include "mote/vision/synthetic.hpp"

namespace mote::vision {
namespace {

namespace fs = std::filesystem;

class FramesTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  /// A grey picture of one level.
  void picture(const std::string& name, int level, cv::Size size = {40, 30}) const {
    cv::imwrite(file(name), cv::Mat(size, CV_8U, cv::Scalar(level)));
  }
  static std::vector<int> levels(const std::string& path) {
    std::vector<int> all;
    const auto frames = open_frames(path);
    while (const auto frame = frames->next()) all.push_back(frame->at<unsigned char>(0, 0));
    return all;
  }
  static std::string refusal(const std::string& path) {
    try {
      levels(path);
    } catch (const Refusal& refused) {
      EXPECT_EQ(refused.code(), ExitCode::kBadData);
      return refused.what();
    }
    return "";
  }

  ScratchFolder folder_;
};

TEST_F(FramesTest, AFolderInTheOrderOfItsNumbers) {
  picture("shot10.png", 3);
  picture("shot9.png", 2);
  picture("shot1.png", 1);
  std::ofstream(file("notes.txt")) << "no picture";
  EXPECT_EQ(levels(folder_.path().string()), (std::vector<int>{1, 2, 3}));
}

TEST_F(FramesTest, APatternFromOneToItsFirstGap) {
  for (const int k : {1, 2, 3, 5}) picture("s000" + std::to_string(k) + ".png", k);
  EXPECT_EQ(levels(file("s%04d.png")), (std::vector<int>{1, 2, 3}));
}

TEST_F(FramesTest, AVideo) {
  {
    Film film(file("v.avi"), 25);
    for (int k = 0; k < 5; ++k) film.add(testing::texture({64, 48}, 6, static_cast<unsigned>(k)));
    EXPECT_FALSE(fs::exists(file("v.avi")));
    film.commit();
  }
  const auto frames = open_frames(file("v.avi"));
  EXPECT_EQ(frames->count(), 5U);
  EXPECT_DOUBLE_EQ(frames->rate(), 25);
  std::size_t count = 0;
  while (const auto frame = frames->next()) {
    EXPECT_EQ(frame->size(), cv::Size(64, 48));
    ++count;
  }
  EXPECT_EQ(count, 5U);
}

TEST_F(FramesTest, AFilmThatIsDroppedLeavesNothing) {
  {
    Film film(file("v.avi"), 25);
    film.add(testing::texture({64, 48}, 6, 1));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(FramesTest, RefusesWhatIsNoVideo) {
  EXPECT_NE(refusal(file("none.mp4")).find("got nothing of that name"), std::string::npos);
  EXPECT_NE(refusal(folder_.path().string()).find("a folder without any"), std::string::npos);
  EXPECT_NE(refusal(file("x%03d.png")).find("no such file"), std::string::npos);
  std::ofstream(file("empty.mp4")) << "";
  EXPECT_NE(refusal(file("empty.mp4")).find("cannot be decoded"), std::string::npos);
  std::ofstream(file("bad.png")) << "no picture";
  EXPECT_NE(refusal(folder_.path().string()).find("bad.png"), std::string::npos);
}

TEST_F(FramesTest, RefusesAFrameOfAnotherSize) {
  picture("a1.png", 1);
  picture("a2.png", 2, {41, 30});
  const std::string sentence = refusal(folder_.path().string());
  EXPECT_NE(sentence.find("a2.png"), std::string::npos);
  EXPECT_NE(sentence.find("40 x 30"), std::string::npos);
  EXPECT_NE(sentence.find("41 x 30"), std::string::npos);
}

TEST_F(FramesTest, RefusesAFilmThatCannotBeWritten) { EXPECT_THROW(Film(file("no/such/folder/v.mp4"), 25), Refusal); }

}  // namespace
}  // namespace mote::vision
