#include "mote/vision/confidence.hpp"

namespace mote::vision {
namespace {

TEST(Confidence, LosesAfterPatienceAndFindsAgain) {
  const ConfidenceOptions options;
  Confidence confidence(options, 1.0);
  EXPECT_EQ(confidence.note(0.5, 0.05), Sighting::kSure);
  for (int k = 0; k < options.patience; ++k) {
    EXPECT_FALSE(confidence.lost());
    EXPECT_EQ(confidence.note(0.1, 0.6), Sighting::kHidden);
  }
  EXPECT_TRUE(confidence.lost());
  confidence.note_search(false);
  EXPECT_EQ(confidence.gone(), 1);
  EXPECT_FALSE(confidence.is_found(0.2, 0.0, 10));
  EXPECT_TRUE(confidence.is_found(0.45, 0.1, 10));
  confidence.note_search(true);
  EXPECT_FALSE(confidence.lost());
}

TEST(Confidence, OneGoodFrameEndsADoubt) {
  const ConfidenceOptions options;
  Confidence confidence(options, 1.0);
  for (int k = 1; k < options.patience; ++k) confidence.note(0.1, 0.6);
  confidence.note(0.5, 0.05);
  for (int k = 1; k < options.patience; ++k) confidence.note(0.1, 0.6);
  EXPECT_FALSE(confidence.lost());
}

TEST(Confidence, NearAPlaceLessIsAsked) {
  Confidence confidence({}, 1.0);
  EXPECT_TRUE(confidence.is_found(0.28, 0.05, 0.5));
  EXPECT_FALSE(confidence.is_found(0.28, 0.05, 5));
}

TEST(Confidence, AResponseThatIsNoNumberHides) {
  Confidence confidence({}, 1.0);
  EXPECT_EQ(confidence.note(0.0 / 0.0, 1), Sighting::kHidden);
}

}  // namespace
}  // namespace mote::vision
