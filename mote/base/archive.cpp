#include "mote/base/archive.hpp"

#include <utility>

namespace mote {

Archive::Archive(Sink sink, Source source, std::uint64_t bytes)
    : sink_(std::move(sink)), source_(std::move(source)), left_(bytes) {}

Archive Archive::to(Sink sink) { return {std::move(sink), nullptr, 0}; }

Archive Archive::from(Source source, std::uint64_t bytes) { return {nullptr, std::move(source), bytes}; }

void Archive::pass(std::string& text) {
  std::uint64_t length = text.size();
  pass(length);
  if (reads()) text.resize(possible(length, 1));
  bytes(text.data(), text.size());
}

void Archive::bytes(void* data, std::size_t count) {
  if (!reads()) return sink_(data, count);
  if (count > left_) throw ArchiveMismatch("it ends too early");
  source_(data, count);
  left_ -= count;
}

void Archive::check_length(std::size_t expected) {
  std::uint64_t length = expected;
  pass(length);
  if (length != expected)
    throw ArchiveMismatch("it has " + std::to_string(length) + " numbers where there are " + std::to_string(expected));
}

std::size_t Archive::possible(std::uint64_t length, std::size_t size) const {
  if (length > left_ / size) throw ArchiveMismatch("it ends too early");
  return static_cast<std::size_t>(length);
}

}  // namespace mote
