#include "mote/app/files/output.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

namespace fs = std::filesystem;

/// The number of the program's stream that a path names, else -1. Streams are written to as they are: opening them
/// again by name would start a file anew that a shell appends to.
int stream_named(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return 1;
  if (path == "/dev/stderr") return 2;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    int number = -1;
    const char* end = path.data() + path.size();
    const auto [rest, error] = std::from_chars(path.data() + folder.size(), end, number);
    if (error == std::errc() && rest == end) return number;
  }
  return -1;
}

bool no_regular_file(const std::string& path) {
  struct stat info {};
  return stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
}

/// The file a path means once symbolic links are followed, also one that leads to nothing yet.
std::string followed(const std::string& path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  fs::path real = fs::absolute(path, error);
  for (int i = 0; i < kMostLinks && fs::is_symlink(real, error); ++i)
    real = real.parent_path() / fs::read_symlink(real, error);
  const fs::path canonical = fs::weakly_canonical(real, error);
  return error ? path : canonical.string();
}

/// Lets a new file be of the mode and, where one may, of the owner of the one it replaces.
void dress_like(int descriptor, const struct stat& old) {
  [[maybe_unused]] const int ignored = fchown(descriptor, old.st_uid, old.st_gid);
  fchmod(descriptor, old.st_mode & 07777U);
}

}  // namespace

Output::Output(std::string path) : path_(std::move(path)), target_(path_), stream_(stream_named(path_)) {
  if (stream_ >= 0 || no_regular_file(target_)) {
    open_in_place();
  } else {
    open_aside();
  }
}

void Output::open_in_place() {
  if (stream_ >= 0) {
    const int descriptor = fcntl(stream_, F_DUPFD_CLOEXEC, 3);
    if (descriptor < 0) fail(errno);
    file_ = fdopen(descriptor, "wb");
  } else {
    file_ = std::fopen(target_.c_str(), "wbe");
  }
  if (file_ == nullptr) fail(errno);
}

void Output::open_aside() {
  target_ = followed(target_);
  struct stat old {};
  const bool exists = stat(target_.c_str(), &old) == 0;
  if (exists && access(target_.c_str(), W_OK) != 0) fail(errno);
  const std::string folder = fs::path(target_).parent_path().string();
  int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  nameless_ = descriptor >= 0 && access("/proc/self/fd", X_OK) == 0;
  const std::string aside = fmt::format("{}.{}.part", target_, getpid());
  if (!nameless_) {
    if (descriptor >= 0) close(descriptor);
    descriptor = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(errno);
  }
  aside_ = aside;
  if (exists) dress_like(descriptor, old);
  file_ = fdopen(descriptor, "wb");
}

Output::~Output() {
  if (file_ != nullptr) std::fclose(file_);
  if (!aside_.empty() && !nameless_) unlink(aside_.c_str());
}

void Output::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(errno);
}

void Output::finish() {
  if (file_ == nullptr) return;
  if (std::fflush(file_) != 0) fail(errno);
  if (nameless_) return;  // its descriptor is all that holds it
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) fail(errno);
}

void Output::commit() {
  finish();
  if (aside_.empty()) return;
  if (nameless_) {
    const std::string self = fmt::format("/proc/self/fd/{}", fileno(file_));
    if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, aside_.c_str(), AT_SYMLINK_FOLLOW) != 0) fail(errno);
    nameless_ = false;
  }
  if (std::rename(aside_.c_str(), target_.c_str()) != 0) fail(errno);
  aside_.clear();
}

void Output::commit_to_disk() {
  if (std::fflush(file_) != 0) fail(errno);
  while (fsync(fileno(file_)) != 0)
    if (errno != EINTR) fail(errno);
  commit();
  const int folder = ::open(fs::path(target_).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // a folder that may be written but not read
  fsync(folder);
  close(folder);
}

void Output::fail(int error) const {
  if (error == EINTR) throw Refusal(ExitCode::kInterrupted, path_ + ": interrupted while it was written.");
  const std::string next = error == ENOSPC  ? "Free some space."
                           : error == EPIPE ? "Let its reader read to the end."
                                            : "Check that the folder exists and can be written.";
  throw Refusal(ExitCode::kCannotWrite, {stream_ == 1 ? "standard output" : path_, "", "an output that can be written",
                                         std::strerror(error), next});
}

void OutputSet::protect(const std::string& path) {
  if (!path.empty()) inputs_.insert(followed(path));
}

void OutputSet::reserve(const std::string& path) {
  if (path.empty()) return;
  const std::string real = stream_named(path) == 1 ? "-" : followed(path);
  const auto among = [&](const std::set<std::string>& all) { return all.contains(real) && !no_regular_file(real); };
  if (among(inputs_))
    throw Refusal(ExitCode::kWrongUse,
                  {path, "", "an output in a file of its own", "a file that this command reads", "Name another file."});
  if (among(paths_))
    throw Refusal(ExitCode::kWrongUse, {path, "", "every output in a file of its own", "the same file for two outputs",
                                        "Name another file."});
  paths_.insert(real);
}

Output* OutputSet::open(const std::string& path) {
  if (path.empty()) return nullptr;
  reserve(path);
  outputs_.push_back(std::make_unique<Output>(path));
  return outputs_.back().get();
}

void OutputSet::commit() {
  for (const auto& output : outputs_) output->finish();
  for (const auto& output : outputs_) output->commit();
}

bool OutputSet::on_standard_output() const {
  return std::any_of(outputs_.begin(), outputs_.end(), [](const auto& o) { return o->is_standard_output(); });
}

bool names_stream(const std::string& path) { return stream_named(path) >= 0; }

std::string exact(double value) { return fmt::format("{}", value); }

}  // namespace mote
