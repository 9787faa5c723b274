#include "mote/vision/confidence.hpp"

namespace mote::vision {
namespace {

TEST(Confidence, LosesAfterPatienceAndFindsAgain) {
  const ConfidenceOptions options;
  Confidence confidence(options, 1.0);
  EXPECT_EQ(confidence.note(0.5, -0.5), Sighting::kSure);
  for (int k = 0; k < options.patience; ++k) {
    EXPECT_FALSE(confidence.lost());
    EXPECT_EQ(confidence.note(0.1, -2), Sighting::kHidden);
  }
  EXPECT_TRUE(confidence.lost());
  confidence.note_search(false);
  EXPECT_EQ(confidence.gone(), 1);
  EXPECT_FALSE(confidence.is_found(0.2, -0.3, 1));
  EXPECT_TRUE(confidence.is_found(0.45, -0.5, 1));
  confidence.note_search(true);
  EXPECT_FALSE(confidence.lost());
}

TEST(Confidence, OneGoodFrameEndsADoubt) {
  const ConfidenceOptions options;
  Confidence confidence(options, 1.0);
  for (int k = 1; k < options.patience; ++k) confidence.note(0.1, -2);
  confidence.note(0.5, -0.5);
  for (int k = 1; k < options.patience; ++k) confidence.note(0.1, -2);
  EXPECT_FALSE(confidence.lost());
}

/// A post in front of the target keeps half of the response, because its edges are upright, too; its pixels betray it.
TEST(Confidence, AnOccluderLikeTheTargetHides) {
  Confidence confidence({}, 1.0);
  EXPECT_EQ(confidence.note(0.3, -0.6), Sighting::kSure);
  EXPECT_EQ(confidence.note(0.3, -1.9), Sighting::kHidden);
  EXPECT_EQ(confidence.note(0.05, -1.0), Sighting::kHidden);
}

TEST(Confidence, WhereItMayHaveGotToLessIsAsked) {
  Confidence confidence({}, 1.0);
  EXPECT_TRUE(confidence.is_found(0.28, -0.5, 0.5));
  EXPECT_FALSE(confidence.is_found(0.45, -0.5, 5));  // nothing leaps five sides in a frame
  for (int k = 0; k < 30; ++k) confidence.note_search(false);
  EXPECT_TRUE(confidence.is_near(3));
  EXPECT_FALSE(confidence.is_near(5));
  EXPECT_FALSE(confidence.is_found(0.28, -0.5, 5));
  EXPECT_TRUE(confidence.is_found(0.45, -0.5, 5));
}

/// What looks half like the target, for ever: the background that a wrong find is stuck on.
TEST(Confidence, ALongDoubtIsALossAndOnlyASurePlaceEndsIt) {
  const ConfidenceOptions options;
  Confidence confidence(options, 1.0);
  for (int k = 1; k < options.doubt; ++k) {
    EXPECT_EQ(confidence.note(0.25, -1.3), Sighting::kUnsure);
    EXPECT_FALSE(confidence.lost()) << k;
  }
  confidence.note(0.25, -1.3);
  EXPECT_TRUE(confidence.lost());
  EXPECT_FALSE(confidence.is_found(0.25, -1.3, 0));
  EXPECT_TRUE(confidence.is_found(0.25, -1.0, 0));
  confidence.note_search(true);
  EXPECT_FALSE(confidence.lost());
  EXPECT_EQ(confidence.note(0.25, -1.0), Sighting::kSure);
}

TEST(Confidence, AResponseThatIsNoNumberHides) {
  Confidence confidence({}, 1.0);
  EXPECT_EQ(confidence.note(0.0 / 0.0, -0.5), Sighting::kHidden);
}

}  // namespace
}  // namespace mote::vision
