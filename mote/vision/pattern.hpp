#pragma once
/// Names of numbered pictures: shot%04d.png.

#include <optional>
#include <string>

namespace mote::vision {

/// A name with a place for a number: "%d", or "%04d" for at least four digits.
struct Pattern {
  std::string before, after;
  std::size_t digits = 0;

  std::string name(std::size_t number) const;
};

/// The pattern that a path is, if it has exactly one place for a number.
std::optional<Pattern> pattern_in(const std::string& path);

}  // namespace mote::vision
