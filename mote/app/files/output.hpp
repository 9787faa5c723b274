#pragma once
/// Output files that appear whole or not at all.

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace mote {

/// One output file: written aside, moved to its name by commit(). Something that is no regular file (a pipe, a device)
/// is written in place. "-" is standard output. Dropped without commit(), it leaves nothing.
///
/// error   Refusal (kCannotWrite) naming the path, on opening, writing (disk full) or moving
class Output {
 public:
  explicit Output(std::string path);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  Output(Output&&) = delete;
  Output& operator=(Output&&) = delete;

  void write(std::string_view text);
  /// Flushes to the disk: after this only commit() is left that can fail.
  void finish();
  void commit();

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_, target_, aside_;
  std::FILE* file_ = nullptr;
};

/// The outputs of one command: opened before the work starts, committed together after it.
class OutputSet {
 public:
  /// Opens an output, or does nothing for an empty path and returns nullptr.
  ///
  /// error   Refusal (kWrongUse) when two outputs go to the same file
  Output* open(const std::string& path);
  void commit();

 private:
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<Output>> outputs_;
};

/// A number as text that reads back to the same bits; "nan" and "inf" as such.
std::string exact(double value);

}  // namespace mote
