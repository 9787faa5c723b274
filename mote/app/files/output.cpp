#include "mote/app/files/output.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
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

bool are_same_file(int descriptor, const std::string& path) {
  struct stat one {};
  struct stat other {};
  return fstat(descriptor, &one) == 0 && lstat(path.c_str(), &other) == 0 && one.st_dev == other.st_dev &&
         one.st_ino == other.st_ino;
}

/// The name that outputs for a target pass through, one at a time, each locked by its writer.
std::string shared_name(const std::string& target) { return target + ".mote.part"; }

/// A name that no other living process takes for an output.
std::string own_name(const std::string& target) { return fmt::format("{}.{}.part", target, getpid()); }

/// Takes the file of a shared name away if its lock is free: its writer was killed. While the lock is held here nobody
/// else takes the name from the file. With LOCK_NB a living writer's is left, without it waited for.
///
/// error   false and errno where there is something that may not be locked or removed, or is not to be waited for
bool remove_orphan(const std::string& name, int no_wait) {
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return errno == ENOENT;
  bool is_free = flock(descriptor, LOCK_EX | no_wait) == 0;
  if (is_free && are_same_file(descriptor, name)) is_free = unlink(name.c_str()) == 0;
  const int error = errno;
  close(descriptor);
  errno = error;
  return is_free;
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
  int descriptor = open_nameless();
  nameless_ = descriptor >= 0;
  if (nameless_) {
    remove_orphan(shared_name(target_), LOCK_NB);
  } else {
    descriptor = ::open(own_name(target_).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(errno);
  }
  aside_ = nameless_ ? shared_name(target_) : own_name(target_);
  if (exists) dress_like(descriptor, old);
  file_ = fdopen(descriptor, "wb");
}

int Output::open_nameless() const {
  const std::string folder = fs::path(target_).parent_path().string();
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return -1;
  if (access("/proc/self/fd", X_OK) == 0 && flock(descriptor, LOCK_EX) == 0) return descriptor;
  close(descriptor);
  return -1;
}

Output::~Output() {
  if (!aside_.empty() && !nameless_) unlink(aside_.c_str());  // while it is locked: then the name is another's
  if (file_ != nullptr) std::fclose(file_);
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
  if (nameless_) give_name();
  if (std::rename(aside_.c_str(), target_.c_str()) != 0) fail(errno);
  aside_.clear();
  if (file_ == nullptr) return;
  std::fclose(file_);  // and with it its lock
  file_ = nullptr;
}

void Output::give_name() {
  const std::string self = fmt::format("/proc/self/fd/{}", fileno(file_));
  while (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, aside_.c_str(), AT_SYMLINK_FOLLOW) != 0) {
    if (errno != EEXIST) fail(errno);
    if (remove_orphan(aside_, 0)) continue;
    if (errno == EINTR || aside_ == own_name(target_)) fail(errno);
    aside_ = own_name(target_);  // the shared one is somebody else's for good
  }
  nameless_ = false;
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
