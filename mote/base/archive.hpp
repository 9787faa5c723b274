#pragma once
/// An archive: the state of something, written and read back by one and the same function.

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace mote {

/// What is read does not have the shape of what is to take it in.
class ArchiveMismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes on their way out of, or into, the members of something. Whatever has a state says once which members these
/// are, in an order of its choice, and the direction is the archive's:
///
///   void keep(Archive& archive) { archive(seed_, weights_);  archive.fill(column); }
///
/// Numbers are kept as they lie in memory, so that they come back bit by bit, on machines of one byte order.
///
/// error   ArchiveMismatch where less is left to read than asked for, or a fixed length is another; what the source or
///         sink throws
/// cost    one call of the sink or source for a number, or for a whole column
class Archive {
 public:
  using Sink = std::function<void(const void* bytes, std::size_t count)>;
  using Source = std::function<void(void* bytes, std::size_t count)>;

  /// An archive that writes.
  static Archive to(Sink sink);
  /// An archive that reads, `bytes` at most.
  static Archive from(Source source, std::uint64_t bytes);

  bool reads() const { return source_ != nullptr; }
  /// Bytes that a reading archive has left.
  std::uint64_t left() const { return left_; }

  template <class... Parts>
  void operator()(Parts&... parts) {
    (pass(parts), ...);
  }

  /// As many elements as the span has: the length is kept with them, and must be the same on reading.
  template <class T, std::size_t kExtent>
  requires std::is_trivially_copyable_v<T>
  void fill(std::span<T, kExtent> elements) {
    check_length(elements.size());
    bytes(elements.data(), elements.size_bytes());
  }

 private:
  Archive(Sink sink, Source source, std::uint64_t bytes);

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void pass(T& number) { bytes(&number, sizeof number); }
  template <class T, class Allocator>
  void pass(std::vector<T, Allocator>& elements) {
    std::uint64_t length = elements.size();
    pass(length);
    if constexpr (std::is_arithmetic_v<T>) {
      if (reads()) elements.resize(possible(length, sizeof(T)));
      bytes(elements.data(), elements.size() * sizeof(T));
    } else {
      if (reads()) elements.resize(possible(length, 1));
      for (T& element : elements) pass(element);
    }
  }
  void pass(std::string& text);
  /// Things that keep themselves.
  template <class T>
  requires requires(T& thing, Archive& archive) { thing.keep(archive); }
  void pass(T& thing) { thing.keep(*this); }

  void bytes(void* data, std::size_t count);
  void check_length(std::size_t expected);
  /// `length`, if so many elements of at least `size` bytes can be left to read.
  std::size_t possible(std::uint64_t length, std::size_t size) const;

  Sink sink_;
  Source source_;
  std::uint64_t left_;
};

}  // namespace mote
