#include "tests/hardware/cosim.hpp"

namespace mote::hardware {
namespace {

// claim    see cosim.hpp; 10^5 rows of every pipeline
TEST(DatapathCircuits, EqualTheirTwins) { EXPECT_GE(expect_equal_to_circuits(subjects(), 50, 2000), 2'000'000U); }

}  // namespace
}  // namespace mote::hardware
