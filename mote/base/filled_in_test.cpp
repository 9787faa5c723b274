#include "mote/base/filled_in.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace mote {
namespace {

TEST(FilledIn, FillsEveryPlaceOrSaysWhich) {
  EXPECT_EQ(filled_in("a @b@ c @(posedge) @b@", {{"b", "x"}}), "a x c @(posedge) x");
  EXPECT_THROW(filled_in("@c@", {{"b", "x"}}), std::logic_error);
}

}  // namespace
}  // namespace mote
