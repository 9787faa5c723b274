#include "mote/vision/choice.hpp"

namespace mote::vision {
namespace {

using Frame = std::vector<Detection>;

Detection at(double x, double score, double side = 40) { return {{x, 50, side, 2 * side}, score}; }

TEST(Choice, WhatIsSeenOnceIsNotChosen) {
  Choice choice;
  EXPECT_FALSE(choice.note(Frame{at(10, 9), at(200, 1)}));
  EXPECT_TRUE(choice.watching());
  EXPECT_FALSE(choice.note(Frame{at(203, 1)}));
  const auto chosen = choice.note(Frame{at(100, 9), at(206, 1)});
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->x, 206);
}

TEST(Choice, AGapStartsAnew) {
  Choice choice;
  for (int k = 0; k < 2; ++k) EXPECT_FALSE(choice.note(Frame{at(10, 1)}));
  EXPECT_FALSE(choice.note(Frame{}));
  EXPECT_FALSE(choice.watching());
  for (int k = 0; k < 2; ++k) EXPECT_FALSE(choice.note(Frame{at(10, 1)}));
  EXPECT_TRUE(choice.note(Frame{at(10, 1)}));
}

TEST(Choice, OfTwoThatStayTheLargerUnlessItIsFarLessSure) {
  for (const double score : {0.9, 0.3}) {
    Choice choice;
    const Frame frame{at(10, 1), at(200, score, 60)};
    choice.note(frame);
    choice.note(frame);
    EXPECT_EQ(choice.note(frame)->x, score > 0.5 ? 200 : 10);
  }
}

}  // namespace
}  // namespace mote::vision
