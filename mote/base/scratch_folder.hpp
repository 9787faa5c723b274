#pragma once
/// A folder for files that nobody keeps.

#include <filesystem>
#include <string>

namespace mote {

/// A new folder among the system's temporary ones, which goes with the object and whatever is in it.
///
/// error   Refusal (kCannotWrite) when none can be made
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace mote
