#include "mote/vision/container.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

namespace mote::vision {
namespace {

/// A file as outermost parts are read from it.
class Bytes {
 public:
  explicit Bytes(const std::string& path) : file_(path, std::ios::binary) {
    std::error_code unknown;
    const auto size = std::filesystem::file_size(path, unknown);
    if (!unknown) size_ = size;
  }
  std::uint64_t size() const { return size_; }
  /// What stands from a place on; zeros behind the end.
  std::array<unsigned char, 16> at(std::uint64_t place) {
    std::array<unsigned char, 16> bytes{};
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(place));
    file_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    return bytes;
  }

 private:
  std::ifstream file_;
  std::uint64_t size_ = 0;
};

using Head = std::array<unsigned char, 16>;

std::uint64_t number(const Head& head, std::size_t from, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t k = from; k < from + bytes; ++k) value = value << 8U | head[k];
  return value;
}

bool says(const Head& head, std::size_t from, std::string_view word) {
  return std::equal(word.begin(), word.end(), head.begin() + static_cast<std::ptrdiff_t>(from),
                    [](char c, unsigned char byte) { return static_cast<unsigned char>(c) == byte; });
}

/// RIFF chunks one after the other; sizes have their least byte first.
Container riff(Bytes& file) {
  constexpr std::uint64_t kNeverFilledIn = 0xFFFFFFFF;
  for (std::uint64_t place = 0; place < file.size();) {
    const Head head = file.at(place);
    if (!says(head, 0, "RIFF")) break;  // what follows the chunks is not part of the video
    const std::uint64_t size = head[4] | head[5] << 8U | head[6] << 16U | std::uint64_t{head[7]} << 24U;
    if (size == 0 || size == kNeverFilledIn) break;
    place += 8 + size;
    if (place > file.size()) return {true, true};
  }
  return {true, false};
}

bool names_a_box(const Head& head) {
  return std::all_of(head.begin() + 4, head.begin() + 8, [](unsigned char c) { return c >= ' ' && c <= '~'; });
}

/// Boxes one after the other. A film in fragments lists no frames at its head.
Container boxes(Bytes& file) {
  constexpr std::uint64_t kHead = 8;
  bool fragments = false;
  for (std::uint64_t place = 0; place + kHead <= file.size();) {
    const Head head = file.at(place);
    std::uint64_t size = number(head, 0, 4);
    if (size == 0 || !names_a_box(head)) break;  // to the end of the file; or no box: something was appended
    fragments = fragments || says(head, 4, "moof");
    if (size == 1) size = number(head, 8, 8);
    if (size < kHead || size > file.size() - place) return {!fragments, true};
    place += size;
  }
  return {!fragments, false};
}

/// A number of EBML: the first byte's leading zeros say how many bytes follow; all ones: unknown.
std::optional<std::uint64_t> ebml_size(const Head& head, std::size_t from, std::size_t& bytes) {
  bytes = 1;
  while (bytes <= 8 && (head[from] & 0x80U >> (bytes - 1)) == 0) ++bytes;
  if (bytes > 8) return std::nullopt;
  const std::uint64_t ones = (std::uint64_t{1} << 7 * bytes) - 1;
  const std::uint64_t value = number(head, from, bytes) & ones;
  if (value == ones) return std::nullopt;
  return value;
}

/// Matroska: a head, then the segment.
Container segment(Bytes& file) {
  std::size_t bytes = 0;
  const auto head = ebml_size(file.at(0), 4, bytes);
  if (!head || *head > file.size()) return {};
  const std::uint64_t place = 4 + bytes + *head;
  const Head found = file.at(place);
  const auto size = number(found, 0, 4) == 0x18538067 ? ebml_size(found, 4, bytes) : std::nullopt;
  return {false, size && place + 4 + bytes + *size > file.size()};
}

}  // namespace

Container container_of(const std::string& path) {
  Bytes file(path);
  const Head head = file.at(0);
  if (says(head, 0, "RIFF") && says(head, 8, "AVI ")) return riff(file);
  for (const std::string_view box : {"ftyp", "moov", "mdat", "free", "wide", "skip"})
    if (says(head, 4, box)) return boxes(file);
  if (number(head, 0, 4) == 0x1A45DFA3) return segment(file);
  return {};
}

}  // namespace mote::vision
