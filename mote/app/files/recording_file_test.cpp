#include "mote/app/files/recording_file.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/local_level.hpp"

namespace mote {
namespace {

Recording level(const std::string& text) {
  return recording_from(parse_table("d.csv", text), LocalLevel{}.columns(), "local-level");
}
Recording bearings(const std::string& text) {
  return recording_from(parse_table("d.csv", text), Bearings{}.columns(), "bearings");
}
Truth truth(const std::string& text) { return truth_from(parse_table("t.csv", text), Bearings{}.states()); }

TEST(RecordingFrom, GroupsRowsOfOneTime) {
  const Recording recording = level("t,y\n2,1\n2,3\n5,\n5,nan\n7,4\n7,\n");
  ASSERT_EQ(recording.steps.size(), 3U);
  EXPECT_EQ(recording.steps[0].t, 2);
  EXPECT_EQ(recording.steps[0].rows.size(), 2U);
  EXPECT_TRUE(recording.steps[1].rows.empty()) << "nothing observed: predict only";
  EXPECT_EQ(recording.steps[2].rows.size(), 1U);
}

TEST(RecordingFrom, FillsInInputsThatAreNotThere) {
  const Recording recording = bearings("t,bearing\n1,0.5\n");
  ASSERT_EQ(recording.steps[0].rows.size(), 1U);
  EXPECT_EQ(recording.steps[0].rows[0].values, (std::vector<double>{0.5, 0, 0, 0}));
}

TEST(RecordingFrom, FindsColumnsByName) {
  const Recording recording = bearings("t,sensor_y,note,bearing\n1,2,9,0.5\n");
  EXPECT_EQ(recording.steps[0].rows[0].values, (std::vector<double>{0.5, 0, 2, 0}));
}

TEST(RecordingFrom, NeedsInputsWhereItIsObserved) {
  EXPECT_THROW(bearings("t,bearing,sensor_x\n1,0.5,\n"), Refusal);
  EXPECT_NO_THROW(bearings("t,bearing,sensor_x\n1,,\n"));
}

TEST(RecordingFrom, RefusesTimesThatGoBackOrTooFar) {
  EXPECT_THROW(level("t,y\n2,1\n1,1\n"), Refusal);
  EXPECT_NO_THROW(level("t,y\n10000000,1\n20000000,1\n"));
  EXPECT_THROW(level("t,y\n10000001,1\n"), Refusal);
  EXPECT_THROW(level("t,y\n1,1\n10000002,1\n"), Refusal);
}

TEST(TruthFrom, KnowsSomeStates) {
  const Truth some = truth("t,y,x\n3,2,1\n9,,4\n");
  EXPECT_EQ(some.known, (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(some.states.at(3)[0], 1);
  EXPECT_EQ(some.states.at(3)[2], 2);
  EXPECT_TRUE(std::isnan(some.states.at(3)[1]));
  EXPECT_TRUE(std::isnan(some.states.at(9)[2]));
}

TEST(TruthFrom, RefusesEqualTimesAndNoStates) {
  EXPECT_THROW(truth("t,x\n1,1\n1,2\n"), Refusal);
  EXPECT_THROW(truth("t,z\n1,1\n"), Refusal);
}

TEST(UnusedColumns, AreThoseNobodyReads) {
  EXPECT_EQ(unused_columns(parse_table("d.csv", "t,a,b,c\n1,1,1,1\n"), {"b"}), (std::vector<std::string>{"a", "c"}));
}

}  // namespace
}  // namespace mote
