#pragma once
/// The memory a run may take: 64 bytes x N x states + 64 MB, told by the operating system's account of the child.

#include <sstream>

#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace mote::testing {

struct MemoryCase {
  std::string model;
  std::size_t particles, states;
  std::string options;
};

inline std::ostream& operator<<(std::ostream& out, const MemoryCase& c) { return out << c.model << ' ' << c.options; }

/// Runs three simulated steps and holds the peak to the bound.
inline void expect_within_bound(const MemoryCase& c) {
  if (!kMemoryIsMoteOwn) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const Scratch scratch;
  ASSERT_EQ(scratch.shell("mote simulate " + c.model + " --steps 3 --out d.csv").code, 0);
  std::vector<std::string> words{"run", c.model, "--data", "d.csv", "-n", std::to_string(c.particles)};
  std::stringstream options(c.options);
  for (std::string word; options >> word;) words.push_back(word);
  const auto end = Child(scratch, words).end();
  ASSERT_EQ(end.code, 0) << end.err;
  const auto n = static_cast<double>(c.particles);
  EXPECT_LE(end.peak_bytes, 64 * n * static_cast<double>(c.states) + 64e6) << end.peak_bytes / n << " bytes a particle";
}

}  // namespace mote::testing
