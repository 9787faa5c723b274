#include "mote/base/scratch_folder.hpp"

#include <cstdlib>

#include "mote/base/refusal.hpp"

namespace mote {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "mote-XXXXXX").string();  // what mkdtemp() fills in
  if (mkdtemp(name.data()) == nullptr)
    throw Refusal(ExitCode::kCannotWrite, {name, "", "a folder that can be made", "none", "Set TMPDIR."});
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace mote
