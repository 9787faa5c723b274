#include "mote/base/archive.hpp"

#include <gtest/gtest.h>

#include "mote/base/aligned.hpp"

namespace mote {
namespace {

enum class Colour { kRed, kBlue };

struct Thing {
  double number = 0;
  bool flag = false;
  Colour colour = Colour::kRed;
  std::string name;
  AlignedVector<float> column;
  std::vector<std::vector<std::uint32_t>> nested;
  std::array<double, 3> fixed{};

  void keep(Archive& archive) {
    archive(number, flag, colour, name, column, nested);
    archive.fill(std::span(fixed));
  }
  friend bool operator==(const Thing&, const Thing&) = default;
};

const Thing kThing{0.1, true, Colour::kBlue, "a b", {1, 2, 3}, {{7}, {}, {8, 9}}, {4, 5, 6}};

std::string written(Thing thing) {
  std::string bytes;
  Archive archive =
      Archive::to([&](const void* data, std::size_t count) { bytes.append(static_cast<const char*>(data), count); });
  EXPECT_FALSE(archive.reads());
  archive(thing);
  return bytes;
}

Thing read(const std::string& bytes, Thing thing = {}) {
  std::size_t at = 0;
  Archive archive = Archive::from(
      [&](void* data, std::size_t count) {
        ASSERT_LE(at + count, bytes.size());
        std::copy_n(bytes.data() + at, count, static_cast<char*>(data));
        at += count;
      },
      bytes.size());
  archive(thing);
  EXPECT_EQ(archive.left(), bytes.size() - at);
  return thing;
}

TEST(Archive, ReadsBackWhatItWrote) {
  EXPECT_EQ(read(written(kThing)), kThing);
  EXPECT_EQ(read(written({}), kThing), Thing{}) << "whatever was there goes";
}

TEST(Archive, NeverReadsPastTheEnd) {
  const std::string whole = written(kThing);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(read(whole.substr(0, length)), ArchiveMismatch) << length;
}

// A length that the bytes left cannot hold is refused before memory is asked for.
TEST(Archive, BelievesNoImpossibleLength) {
  std::string bytes = written(kThing);
  const std::size_t name = sizeof(double) + sizeof(bool) + sizeof(Colour);
  for (std::size_t i = 0; i < 8; ++i) bytes[name + i] = '\x7f';
  EXPECT_THROW(read(bytes), ArchiveMismatch);
}

TEST(Archive, RefusesAnotherFixedLength) {
  std::vector<double> four(4);
  std::string bytes;
  Archive::to([&](const void* data, std::size_t count) {
    bytes.append(static_cast<const char*>(data), count);
  }).fill(std::span(four));
  std::size_t at = 0;
  Archive archive = Archive::from(
      [&](void* data, std::size_t count) {
        std::copy_n(bytes.data() + at, count, static_cast<char*>(data));
        at += count;
      },
      bytes.size());
  EXPECT_THROW(archive.fill(std::span(four).first(3)), ArchiveMismatch);
}

}  // namespace
}  // namespace mote
