#pragma once
/// Output files that appear whole or not at all.

#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

/// One output: a file is written without a name in its folder and gets its name by commit(); dropped before, even by
/// SIGKILL, it leaves nothing. Something that is no regular file (a pipe, a device) and the streams of the program ("-"
/// is standard output) are written in place.
///
/// Linux cannot let a file without a name replace one that has it, so commit() first links it as NAME.mote.part, then
/// renames that. A SIGKILL in between, some microseconds, leaves NAME.mote.part. A writer holds a lock on its file as
/// long as it lives, so a NAME.mote.part whose lock is free is an orphan: the next output for NAME removes it when it
/// is opened, or at the latest when it needs the name itself. A living writer's is waited for, then.
///
/// Where the file system has no files without names or no locks, an output is NAME.PID.part until commit(), and SIGKILL
/// leaves that for good.
///
/// error   Refusal (kCannotWrite) naming the path, on opening, writing (disk full) or naming;
///         Refusal (kInterrupted) when a signal ends a wait for a reader
class Output {
 public:
  explicit Output(std::string path);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  Output(Output&&) = delete;
  Output& operator=(Output&&) = delete;

  void write(std::string_view text);
  /// Hands everything to the system: after this only commit() is left that can fail.
  void finish();
  void commit();
  /// As commit(), and returns when the file is on the disk under its name: it outlives the machine's end, too.
  void commit_to_disk();
  bool is_standard_output() const { return stream_ == 1; }

 private:
  void open_in_place();
  void open_aside();
  /// A locked file without a name beside the target; -1 where there cannot be one.
  int open_nameless() const;
  void give_name();
  [[noreturn]] void fail(int error) const;

  std::string path_, target_, aside_;
  int stream_;             // 1 for standard output and so on; -1 for what the file system knows by name
  bool nameless_ = false;  // a file that commit() has still to name
  std::FILE* file_ = nullptr;
};

/// The outputs of one command: opened before the work starts, committed together after it.
class OutputSet {
 public:
  /// Keeps an input from being written over; nothing for an empty path.
  void protect(const std::string& path);
  /// Keeps a file that is written by others from being an output, too; nothing for an empty path.
  ///
  /// error   as open()
  void reserve(const std::string& path);
  /// Opens an output, or does nothing for an empty path and returns nullptr.
  ///
  /// error   Refusal (kWrongUse) when two outputs go to the same file, or one goes over an input
  Output* open(const std::string& path);
  void commit();
  /// Whether one of them goes to standard output, so that nothing else should.
  bool on_standard_output() const;

 private:
  std::set<std::string> inputs_, paths_;
  std::vector<std::unique_ptr<Output>> outputs_;
};

/// Whether a path names a stream of the program ("-" is standard output) rather than a file.
bool names_stream(const std::string& path);

/// A number as text that reads back to the same bits; "nan" and "inf" as such.
std::string exact(double value);

}  // namespace mote
