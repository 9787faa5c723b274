#include "mote/vision/container.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/base/scratch_folder.hpp"
#include "mote/vision/drawing.hpp"
#include "mote/vision/frames.hpp"
#include "mote/vision/synthetic.hpp"

namespace mote::vision {
namespace {

namespace fs = std::filesystem;

class ContainerTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  Container of(const std::string& bytes) const {
    std::ofstream(file("v"), std::ios::binary) << bytes;
    return container_of(file("v"));
  }
  std::string film(const std::string& name, unsigned frames) const {
    Film film(file(name), 25);
    for (unsigned k = 0; k < frames; ++k) film.add(testing::texture({64, 48}, 6, k));
    film.commit();
    return file(name);
  }

  ScratchFolder folder_;
};

/// A number of four bytes, the most significant first (boxes) or last (RIFF).
std::string big(std::uint32_t n) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(n >> static_cast<unsigned>(shift) & 0xFFU);
  return bytes;
}
std::string little(std::uint32_t n) {
  const std::string bytes = big(n);
  return {bytes.rbegin(), bytes.rend()};
}

TEST_F(ContainerTest, WhatTheProgramWritesIsWholeUntilItIsCut) {
  for (const std::string name : {"v.avi", "v.mp4"}) {
    const std::string path = film(name, 10);
    EXPECT_TRUE(container_of(path).counts) << name;
    EXPECT_FALSE(container_of(path).cut) << name;
    fs::resize_file(path, fs::file_size(path) - 1);
    EXPECT_TRUE(container_of(path).cut) << name;
  }
}

TEST_F(ContainerTest, SizesThatSayNothing) {
  EXPECT_FALSE(of("RIFF" + little(0) + "AVI LIST").cut);
  EXPECT_FALSE(of("RIFF" + little(0xFFFFFFFF) + "AVI LIST").cut);
  EXPECT_FALSE(of(big(8) + "ftyp" + big(0) + "mdatabcd").cut);
  EXPECT_FALSE(of("\x1A\x45\xDF\xA3\x81" + std::string("a\x18\x53\x80\x67\xFF", 6) + "abc").cut);
  EXPECT_FALSE(of("no container at all").cut);
  EXPECT_FALSE(of("").cut);
  EXPECT_FALSE(container_of(file("none")).cut);
}

TEST_F(ContainerTest, SizesBeyondTheEnd) {
  EXPECT_FALSE(of("RIFF" + little(8) + "AVI LIST").cut);
  EXPECT_TRUE(of("RIFF" + little(9) + "AVI LIST").cut);
  EXPECT_FALSE(of(big(8) + "ftyp" + big(12) + "mdatabcd").cut);
  EXPECT_TRUE(of(big(8) + "ftyp" + big(13) + "mdatabcd").cut);
  EXPECT_TRUE(of(big(8) + "ftyp" + big(1) + "mdat" + big(0) + big(21) + "abcd").cut);
  EXPECT_FALSE(of(big(8) + "ftyp" + big(1) + "mdat" + big(0) + big(20) + "abcd").cut);
  EXPECT_FALSE(of("\x1A\x45\xDF\xA3\x81" + std::string("a\x18\x53\x80\x67\x83", 6) + "abc").cut);
  EXPECT_TRUE(of("\x1A\x45\xDF\xA3\x81" + std::string("a\x18\x53\x80\x67\x84", 6) + "abc").cut);
}

TEST_F(ContainerTest, FragmentsAreNotCounted) {
  EXPECT_TRUE(of(big(8) + "ftyp" + big(8) + "moov").counts);
  EXPECT_FALSE(of(big(8) + "ftyp" + big(8) + "moov" + big(8) + "moof").counts);
}

TEST_F(ContainerTest, WhatWasAppendedIsNoFault) {
  EXPECT_FALSE(of(big(8) + "ftyp" + big(12) + "mdatabcd" + "\x7F\x01\x02\x03\x01\x02\x03\x04").cut);
  EXPECT_FALSE(of("RIFF" + little(8) + "AVI LISTmore").cut);
}

/// Reads to the end; the refusal there, or nothing.
std::string refusal_at_end(Frames& frames, std::size_t& read) {
  read = 0;
  try {
    while (frames.next()) ++read;
  } catch (const Refusal& refused) {
    EXPECT_EQ(refused.code(), ExitCode::kBadData);
    return refused.what();
  }
  return "";
}

TEST_F(ContainerTest, ACutVideoIsRefusedAfterItsLastFrame) {
  const std::string path = film("v.avi", 20);
  fs::resize_file(path, fs::file_size(path) / 2);
  const auto frames = open_frames(path);
  std::size_t read = 0;
  const std::string refusal = refusal_at_end(*frames, read);
  EXPECT_GT(read, 5U);
  EXPECT_LT(read, 15U);
  EXPECT_NE(refusal.find("v.avi: expected a whole video, got a file cut short after " + std::to_string(read)),
            std::string::npos)
      << refusal;
}

TEST_F(ContainerTest, AWholeVideoIsNotRefused) {
  for (const std::string name : {"v.avi", "v.mp4"}) {
    const auto frames = open_frames(film(name, 20));
    std::size_t read = 0;
    EXPECT_EQ(refusal_at_end(*frames, read), "");
    EXPECT_EQ(read, 20U);
    EXPECT_EQ(frames->note(), "");
  }
}

/// Damages the picture of a frame, from 0 on, of a film of motion JPEG, which has a chunk 00dc a frame: reading ends
/// there.
void damage(const std::string& path, std::size_t frame) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::size_t place = bytes.find("movi");
  for (std::size_t k = 0; k <= frame; ++k) place = bytes.find("00dc", place) + 8;
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(place), 400, '\0');
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST_F(ContainerTest, FewMissingFramesAreANoteManyAFault) {
  const std::string path = film("v.avi", 40);
  damage(path, 38);
  const auto few = open_frames(path);
  std::size_t read = 0;
  EXPECT_EQ(refusal_at_end(*few, read), "");
  EXPECT_EQ(read, 38U);
  EXPECT_EQ(few->note(), path + " announces 40 frames, and 38 could be decoded. The file is whole.");
  damage(path, 10);
  const auto many = open_frames(path);
  EXPECT_NE(refusal_at_end(*many, read).find("expected the 40 frames that it lists, got no more than 10 frames"),
            std::string::npos);
}

}  // namespace
}  // namespace mote::vision
