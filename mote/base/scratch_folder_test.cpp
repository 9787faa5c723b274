#include "mote/base/scratch_folder.hpp"

#include <fstream>
#include <optional>

#include <gtest/gtest.h>

namespace mote {
namespace {

TEST(ScratchFolder, GoesWithWhatIsInIt) {
  std::optional<ScratchFolder> folder(std::in_place);
  const ScratchFolder other;
  const std::filesystem::path path = folder->path();
  EXPECT_NE(path, other.path());
  std::ofstream(folder->file("a")) << "text";
  EXPECT_TRUE(std::filesystem::exists(path / "a"));
  folder.reset();
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace mote
