#include "mote/base/filled_in.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace mote {
namespace {

bool is_place(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_';
  });
}

}  // namespace

std::string filled_in(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t opens = std::min(text.find('@', at), text.size());
    filled += text.substr(at, opens - at);
    const std::size_t closes = text.find('@', opens + 1);
    const std::string_view name =
        closes < text.size() ? text.substr(opens + 1, closes - opens - 1) : std::string_view{};
    if (!is_place(name)) {
      filled += text.substr(opens, 1);
      at = opens + 1;
      continue;
    }
    const auto value = values.find(std::string(name));
    if (value == values.end()) throw std::logic_error("no value for the place " + std::string(name));
    filled += value->second;
    at = closes + 1;
  }
  return filled;
}

}  // namespace mote
