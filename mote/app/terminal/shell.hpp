#pragma once
/// Words as a shell takes them.

#include <string>

namespace mote {

/// The word as it is where a shell leaves it alone, else in single quotes.
std::string shell_word(const std::string& word);

}  // namespace mote
