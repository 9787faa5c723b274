#pragma once
/// A small item for tests: two filters on directions of arrival, compared by their means.

#include <string>

namespace mote::testing {

/// Lines that a test adds or replaces.
struct ItemLines {
  std::string run = {};                   ///< added to the second run, line 17
  std::string compare = "at_most = 3\n";  ///< the condition
  std::string end = {};
};

inline std::string sample_item(const ItemLines& lines = {}) {
  return R"(item = "Fig. 0"
title = "two filters"
source = "a test"
printed = "nothing"
[simulate]
model = "doa"
steps = 30
seed = 5
columns = 6
set = ["sigma_o=0.2"]
[[run]]
name = "right"
options = ["--filter", "sisr", "-n", "500"]
[[run]]
name = "other"
options = ["--filter", "imh", "-n", "500"]
)" + lines.run +
         R"(
[[figure]]
title = "mean"
state = "theta"
[[compare]]
name = "difference"
kind = "mean-difference"
runs = ["right", "other"]
state = "theta"
repeats = 20
)" + lines.compare +
         lines.end;
}

}  // namespace mote::testing
