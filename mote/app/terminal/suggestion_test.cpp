#include "mote/app/terminal/suggestion.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

const std::vector<std::string> kWords{"sisr", "imh", "auxiliary", "distributed", "--particles", "--parents", "a"};

TEST(Suggestion, IsTheNearestWord) {
  EXPECT_EQ(nearest("sis", kWords), "sisr");
  EXPECT_EQ(nearest("ihm", kWords), "") << "two letters changed of three";
  EXPECT_EQ(nearest("im", kWords), "imh");
  EXPECT_EQ(nearest("auxilliary", kWords), "auxiliary");
  EXPECT_EQ(nearest("distrubuted", kWords), "distributed");
  EXPECT_EQ(nearest("--partcles", kWords), "--particles");
}

TEST(Suggestion, MayBeTheRestOfTheWord) {
  EXPECT_EQ(nearest("aux", kWords), "auxiliary");
  EXPECT_EQ(nearest("--part", kWords), "--particles");
  EXPECT_EQ(nearest("--pa", kWords), "") << "two words begin so";
}

TEST(Suggestion, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest("kalman", kWords), "");
  EXPECT_EQ(nearest("", kWords), "");
  EXPECT_EQ(nearest("x", kWords), "") << "a word that shares no letter is not near";
  EXPECT_EQ(nearest("sisr", {}), "");
  EXPECT_EQ(nearest(std::string(100000, 's'), kWords), "");
}

TEST(Hint, AsksOrSaysWhatToDo) {
  EXPECT_EQ(hint("sis", kWords, "See mote --help."), "Did you mean sisr?");
  EXPECT_EQ(hint("kalman", kWords, "See mote --help."), "See mote --help.");
}

}  // namespace
}  // namespace mote
