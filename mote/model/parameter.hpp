#pragma once
/// Parameters of a model as data: one list gives `--set`, its checks, `mote models` and the docs.

#include <string_view>

namespace mote {

/// The values a parameter may take.
enum class Range { kAny, kPositive, kNotNegative, kFraction };  // kFraction: at least 0, below 1

/// One parameter of a model: its name, where it lives in the struct, what it means.
template <class P>
struct Parameter {
  std::string_view name;
  double P::*value;
  Range range;
  std::string_view unit;
  std::string_view meaning;
};

}  // namespace mote
