#include "tests/hardware/cosim.hpp"

namespace mote::hardware {
namespace {

// claim    see cosim.hpp; 10^5 rows of every pipeline
TEST(DatapathCircuits, EqualTheirTwins) { EXPECT_GE(expect_equal_to_circuits(subjects(), 50, 2000), 2'000'000U); }

// claim    the same where costly operators take turns, and their words are those of operators of their own
// design   every operation, and what has most to share; a row every third clock
TEST(DatapathCircuits, EqualTheirTwinsWhereOperatorsTakeTurns) {
  const ScratchFolder folder;
  const auto model = catalogue_model(file_of(folder, "every.toml", kEveryOperation));
  const Subject apart = subject("every", *model);
  std::vector<Subject> all;
  all.push_back(subject("every", *model, {.interval = 3}));
  all.push_back(subject("ungm2", *catalogue_model("ungm", {"copies=2"}), {.interval = 3}));
  EXPECT_GE(expect_equal_to_circuits(all, 10, 2000), 100'000U);
  Xoshiro bits = keyed_generator({2, 0, Purpose::kTest, 0}, 0);
  const Table rows = stimuli(apart.datapath.propose.circuit(), 1000, bits);
  EXPECT_EQ(computed(apart.datapath.propose, rows, 1000), computed(all.front().datapath.propose, rows, 1000));
}

}  // namespace
}  // namespace mote::hardware
