#include "mote/app/files/text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

std::string line_of(const std::string& path, std::string_view text, std::string_view::const_iterator place) {
  return path + ":" + std::to_string(1 + std::count(text.begin(), place, '\n'));
}

Refusal refuse_bytes(const std::string& path, std::string_view text) {
  return {ExitCode::kBadData,
          {line_of(path, text, std::find(text.begin(), text.end(), '\0')), "", "text", "a byte 0, as in a binary file",
           "Save it as text in ASCII or UTF-8."}};
}

}  // namespace

std::string read_text(const std::string& path) {
  const auto refuse = [&](const std::string& got) {
    return Refusal(ExitCode::kBadData, {path, "", "a file that can be read", got, "Check the path."});
  };
  const auto refuse_by = [&](int number) {
    if (number == EINTR) return Refusal(ExitCode::kInterrupted, path + ": interrupted while it was read.");
    return refuse(number == ENOENT ? "no such file" : std::strerror(number));
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw refuse("a folder");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) throw refuse_by(errno);
  std::string text;
  char buffer[1U << 16U];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file.get())) {
    text.append(buffer, n);
    if (std::memchr(buffer, 0, n) != nullptr) throw refuse_bytes(path, text);  // also ends with /dev/zero
  }
  if (std::ferror(file.get()) != 0) throw refuse_by(errno);
  return text;
}

void refuse_other_than_ascii(const std::string& path, std::string_view text) {
  const auto* const found =
      std::find_if(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 127; });
  if (found == text.end()) return;
  throw Refusal(ExitCode::kBadData, {line_of(path, text, found), "", "plain ASCII text", "another character",
                                     "Write names and comments without accents."});
}

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return text;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 60;
  return "\"" + printable(std::string(text.substr(0, kMost))) + (text.size() > kMost ? "...\"" : "\"");
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // 1e-400 is zero, 1e400 infinity: strtod tells which
  if (error == std::errc::result_out_of_range && end == text.data() + text.size())
    return std::strtod(std::string(text).c_str(), nullptr);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<long long> integer_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

}  // namespace mote
