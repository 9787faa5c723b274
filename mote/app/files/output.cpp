#include "mote/app/files/output.hpp"

#include <algorithm>
#include <cerrno>
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

bool written_in_place(const std::string& path) {
  struct stat info {};
  return stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
}

/// The file a path means once symbolic links are followed.
std::string followed(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(path), error);
  return error ? path : real.string();
}

}  // namespace

Output::Output(std::string path) : path_(std::move(path)), target_(path_) {
  if (path_ == "-" || path_ == "/dev/stdout") {  // whatever it is, a file that the shell opened is not ours to replace
    file_ = fdopen(dup(STDOUT_FILENO), "wb");
    if (file_ == nullptr) fail(errno);
    return;
  }
  if (written_in_place(target_)) {
    std::error_code error;
    if (fs::is_directory(target_, error)) fail(EISDIR);
    file_ = std::fopen(target_.c_str(), "wb");
    if (file_ == nullptr) fail(errno);
    return;
  }
  target_ = followed(target_);
  struct stat info {};
  const bool exists = stat(target_.c_str(), &info) == 0;
  if (exists && access(target_.c_str(), W_OK) != 0) fail(errno);
  aside_ = fmt::format("{}.{}.part", target_, getpid());
  const int descriptor =
      open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, exists ? info.st_mode & 07777U : 0666U);
  if (descriptor < 0) {
    const int error = errno;
    aside_.clear();
    fail(error);
  }
  file_ = fdopen(descriptor, "wb");
}

Output::~Output() {
  if (file_ != nullptr) std::fclose(file_);
  if (!aside_.empty()) unlink(aside_.c_str());
}

void Output::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(errno);
}

void Output::finish() {
  if (file_ == nullptr) return;
  std::FILE* file = file_;
  file_ = nullptr;
  const bool flushed = std::fflush(file) == 0;
  const int error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!flushed || !closed) fail(flushed ? errno : error);
}

void Output::commit() {
  finish();
  if (aside_.empty()) return;
  if (std::rename(aside_.c_str(), target_.c_str()) != 0) fail(errno);
  aside_.clear();
}

void Output::fail(int error) const {
  const std::string next = error == ENOSPC ? "Free some space." : "Check that the folder exists and can be written.";
  throw Refusal(ExitCode::kCannotWrite, {path_, "", "an output that can be written", std::strerror(error), next});
}

Output* OutputSet::open(const std::string& path) {
  if (path.empty()) return nullptr;
  const std::string real = path == "-" || path == "/dev/stdout" ? "-" : followed(path);
  if ((real == "-" || !written_in_place(real)) && std::find(paths_.begin(), paths_.end(), real) != paths_.end())
    throw Refusal(ExitCode::kWrongUse, {path, "", "every output in a file of its own", "the same file for two outputs",
                                        "Name another file."});
  paths_.push_back(real);
  outputs_.push_back(std::make_unique<Output>(path));
  return outputs_.back().get();
}

void OutputSet::commit() {
  for (const auto& output : outputs_) output->finish();
  for (const auto& output : outputs_) output->commit();
}

std::string exact(double value) { return fmt::format("{}", value); }

}  // namespace mote
