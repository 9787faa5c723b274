#include "mote/vision/pattern.hpp"

#include <regex>

namespace mote::vision {

std::string Pattern::name(std::size_t number) const {
  std::string text = std::to_string(number);
  if (text.size() < digits) text.insert(0, digits - text.size(), '0');
  return before + text + after;
}

std::optional<Pattern> pattern_in(const std::string& path) {
  std::smatch found;
  if (!std::regex_match(path, found, std::regex("([^%]*)%(0([1-9]))?d([^%]*)"))) return std::nullopt;
  return Pattern{found[1], found[4], found[3].matched ? static_cast<std::size_t>(std::stoi(found[3])) : 0};
}

}  // namespace mote::vision
