#include "mote/app/files/checkpoint_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <boost/crc.hpp>
#include <fmt/format.h>
#include <sys/stat.h>

#include "mote/app/files/output.hpp"
#include "mote/base/refusal.hpp"

namespace mote {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "mote checkpoint\n";
constexpr std::uint32_t kVersion = 1;
constexpr std::uint64_t kHeaderBytes = kMagic.size() + sizeof(std::uint32_t) + sizeof(std::uint64_t);
constexpr std::uint64_t kChecksumBytes = sizeof(std::uint32_t);
constexpr std::chrono::seconds kPause{10};
constexpr int kLeastShare = 20;  // a checkpoint takes at most one part in so many of the time

const std::string kElsewhere = "Name another --checkpoint, or remove the file to begin anew.";

/// Writes or reads facts.
void keep(Archive& archive, RunFacts& facts) {
  std::uint64_t count = facts.size();
  archive(count);
  if (count > std::max<std::uint64_t>(archive.left(), facts.size())) throw ArchiveMismatch("it ends too early");
  facts.resize(static_cast<std::size_t>(count));
  for (auto& [name, value] : facts) archive(name, value);
}

std::uint64_t bytes_of(const std::function<void(Archive&)>& keep_all) {
  std::uint64_t bytes = 0;
  Archive archive = Archive::to([&](const void*, std::size_t count) { bytes += count; });
  keep_all(archive);
  return bytes;
}

/// An archive that reads the next `bytes` of a file.
Archive reader(std::ifstream& file, std::uint64_t bytes) {
  return Archive::from(
      [&file](void* data, std::size_t count) {
        if (!file.read(static_cast<char*>(data), static_cast<std::streamsize>(count)))
          throw ArchiveMismatch("it ends too early");
      },
      bytes);
}

/// The CRC-32 of the next `bytes` of a file.
std::uint32_t checksum_of(std::ifstream& file, std::uint64_t bytes) {
  boost::crc_32_type checksum;
  std::vector<char> chunk(std::size_t{1} << 20U);
  while (bytes > 0 && file) {
    file.read(chunk.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(bytes, chunk.size())));
    checksum.process_bytes(chunk.data(), static_cast<std::size_t>(file.gcount()));
    bytes -= static_cast<std::uint64_t>(file.gcount());
  }
  return checksum.checksum();
}

template <class T>
T number_from(std::ifstream& file) {
  T number{};
  file.read(reinterpret_cast<char*>(&number), sizeof number);
  return number;
}

}  // namespace

CheckpointFile::CheckpointFile(std::string path, RunFacts facts, std::optional<std::size_t> every)
    : path_(std::move(path)), facts_(std::move(facts)), every_(every), pause_(kPause) {
  struct stat info {};
  const bool exists = stat(path_.c_str(), &info) == 0;
  if ((exists && !S_ISREG(info.st_mode)) || names_stream(path_))
    throw Refusal(ExitCode::kWrongUse, {path_, "", "a file to keep the run in", "something that is no regular file",
                                        "Name another --checkpoint."});
  if (exists) check_file();
  const Output can_be_written(path_);
}

void CheckpointFile::check_file() {
  const auto refuse = [&](const std::string& expected, const std::string& got) {
    throw Refusal(ExitCode::kBadData, {path_, "", expected, got, kElsewhere});
  };
  std::ifstream file(path_, std::ios::binary);
  if (!file) refuse("a checkpoint that can be read", std::strerror(errno));
  const std::uint64_t size = fs::file_size(path_);
  std::array<char, kMagic.size()> magic{};
  file.read(magic.data(), magic.size());
  const auto seen = static_cast<std::size_t>(file.gcount());
  if (std::string_view(magic.data(), seen) != kMagic.substr(0, seen))
    refuse("a checkpoint of mote run", "a file of another kind");
  const auto version = number_from<std::uint32_t>(file);
  const auto length = number_from<std::uint64_t>(file);
  if (!file) refuse("a whole checkpoint", fmt::format("one cut short after {} bytes", size));
  if (version != kVersion)
    refuse(fmt::format("a checkpoint of version {}", kVersion),
           fmt::format("one of version {}, which another mote wrote", version));
  if (size < length) refuse("a whole checkpoint", fmt::format("one cut short after {} of {} bytes", size, length));
  const bool possible = size == length && size >= kHeaderBytes + kChecksumBytes;
  file.seekg(0);
  const std::uint32_t sum = possible ? checksum_of(file, size - kChecksumBytes) : 0;
  if (!possible || sum != number_from<std::uint32_t>(file))
    refuse("a whole checkpoint", "one that is damaged: its checksum is wrong");
  file.seekg(static_cast<std::streamoff>(kHeaderBytes));
  Archive archive = reader(file, size - kHeaderBytes - kChecksumBytes);
  RunFacts kept;
  keep(archive, kept);
  check_facts(kept);
  state_bytes_ = archive.left();
  state_at_ = size - kChecksumBytes - state_bytes_;
}

void CheckpointFile::check_facts(const RunFacts& kept) const {
  if (const auto differs = difference(facts_, kept))
    throw Refusal(ExitCode::kWrongUse,
                  {path_, "", "a checkpoint of this run, with " + differs->first, "one with " + differs->second,
                   "Give the options that it was made with, or name another --checkpoint."});
}

bool CheckpointFile::resume(const KeepRun& run) {
  if (!state_at_) return false;
  std::ifstream file(path_, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(*state_at_));
  Archive archive = reader(file, state_bytes_);
  try {
    run(archive);
    if (archive.left() > 0) throw ArchiveMismatch("it goes on too long");
  } catch (const ArchiveMismatch& mismatch) {
    throw Refusal(ExitCode::kBadData, {path_, "", "the state of this run",
                                       fmt::format("that of another one: {}", mismatch.what()), kElsewhere});
  }
  last_ = Clock::now();
  return true;
}

bool CheckpointFile::due() {
  ++steps_;
  return every_ ? steps_ >= *every_ : Clock::now() - last_ >= pause_;
}

void CheckpointFile::write(const KeepRun& run) {
  const Clock::time_point start = Clock::now();
  const auto keep_all = [&](Archive& archive) {
    keep(archive, facts_);
    run(archive);
  };
  Output output(path_);
  boost::crc_32_type checksum;
  const auto put = [&](const void* data, std::size_t count) {
    checksum.process_bytes(data, count);
    output.write({static_cast<const char*>(data), count});
  };
  const std::uint32_t version = kVersion;
  const std::uint64_t length = kHeaderBytes + bytes_of(keep_all) + kChecksumBytes;
  put(kMagic.data(), kMagic.size());
  put(&version, sizeof version);
  put(&length, sizeof length);
  Archive archive = Archive::to(put);
  keep_all(archive);
  const std::uint32_t sum = checksum.checksum();
  output.write({reinterpret_cast<const char*>(&sum), sizeof sum});
  output.commit_to_disk();
  steps_ = 0;
  last_ = Clock::now();
  pause_ = std::max<Clock::duration>(kPause, kLeastShare * (last_ - start));
}

void CheckpointFile::remove() const {
  std::error_code gone;
  fs::remove(path_, gone);
}

}  // namespace mote
