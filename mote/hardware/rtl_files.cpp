#include <cctype>
#include <map>

#include "mote/hardware/rtl_library.hpp"

namespace mote::hardware {
namespace {

/// Whether a text uses a word, not only as a part of a longer one or in a comment.
bool names(std::string_view text, std::string_view word) {
  const auto inside = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if (text.substr(0, at).find("//", text.rfind('\n', at) + 1) != std::string_view::npos) continue;
    if ((at == 0 || !inside(text[at - 1])) && (end == text.size() || !inside(text[end]))) return true;
  }
  return false;
}

}  // namespace

std::vector<RtlFile> needed_of_library(const std::string& text) {
  std::map<std::string_view, RtlFile> needed;
  std::vector<std::string_view> unread{text};
  while (!unread.empty()) {
    const std::string_view reading = unread.back();
    unread.pop_back();
    for (const RtlFile& file : rtl_library())
      if (names(reading, file.name.substr(0, file.name.size() - 3)) && needed.emplace(file.name, file).second)
        unread.push_back(file.text);
  }
  std::vector<RtlFile> files;
  for (const auto& [name, file] : needed) files.push_back(file);
  return files;
}

}  // namespace mote::hardware
