#include "mote/app/files/team_checkpoint.hpp"

#include <algorithm>

namespace mote {
namespace {

std::vector<char> bytes_of(const KeepRun& run) {
  std::vector<char> bytes;
  Archive archive = Archive::to([&](const void* data, std::size_t count) {
    const char* const begin = static_cast<const char*>(data);
    bytes.insert(bytes.end(), begin, begin + count);
  });
  run(archive);
  return bytes;
}

}  // namespace

void TeamCheckpoint::hand_over(std::size_t from, std::size_t to, std::vector<char>& bytes) {
  std::uint64_t size = bytes.size();
  const auto parcel = [&](std::span<char> what) {
    std::vector<ParcelOut> out;
    std::vector<ParcelIn> in;
    if (team_->rank() == from) out.push_back({to, std::as_bytes(what)});
    if (team_->rank() == to) in.push_back({from, std::as_writable_bytes(what)});
    team_->exchange(out, in);
  };
  parcel({reinterpret_cast<char*>(&size), sizeof size});
  if (team_->rank() == to) bytes.resize(static_cast<std::size_t>(size));
  parcel(bytes);
}

bool TeamCheckpoint::resume(const KeepRun& run) {
  if (!told(file_ != nullptr && file_->found())) return false;
  std::vector<char> mine;
  if (file_ != nullptr) {
    return file_->resume([&](Archive& archive) {
      run(archive);
      for (std::size_t r = 1; r < team_->ranks(); ++r) {
        archive(mine);
        hand_over(0, r, mine);
      }
    });
  }
  for (std::size_t r = 1; r < team_->ranks(); ++r) hand_over(0, r, mine);
  auto at = mine.cbegin();
  Archive archive = Archive::from(
      [&](void* data, std::size_t count) {
        std::copy_n(at, count, static_cast<char*>(data));
        at += static_cast<std::ptrdiff_t>(count);
      },
      mine.size());
  run(archive);
  return true;
}

void TeamCheckpoint::step_done(const KeepRun& run) {
  constexpr std::uint32_t kDue = 1;
  constexpr std::uint32_t kStop = 2;
  const auto all = team_->gather((file_ != nullptr && file_->due() ? kDue : 0U) | (signalled_->load() ? kStop : 0U));
  stop_ = std::any_of(all.begin(), all.end(), [](std::uint32_t one) { return (one & kStop) != 0; });
  if (!stop_ && (all[0] & kDue) != 0) write(run);
}

void TeamCheckpoint::write(const KeepRun& run) {
  std::vector<char> bytes;
  if (file_ != nullptr) {
    file_->write([&](Archive& archive) {
      run(archive);
      for (std::size_t r = 1; r < team_->ranks(); ++r) {
        hand_over(r, 0, bytes);
        archive(bytes);
      }
    });
    return;
  }
  bytes = bytes_of(run);
  std::vector<char> of_others;
  for (int pass = 0; pass < CheckpointFile::kPasses; ++pass)
    for (std::size_t r = 1; r < team_->ranks(); ++r) hand_over(r, 0, r == team_->rank() ? bytes : of_others);
}

}  // namespace mote
