#include "mote/software/pipeline/rank_stages.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "mote/base/draws.hpp"

namespace mote {
namespace {

constexpr std::size_t kUnderWay = 4;  // messages that a rank has made room for

std::size_t bytes_of(const Memory& memory) {
  std::size_t bytes = 0;
  for (const auto& part : memory) bytes += part.size();
  return bytes;
}

void read(const Memory& memory, const std::byte* from) {
  for (const auto& part : memory) {
    std::copy_n(from, part.size(), part.begin());
    from += part.size();
  }
}

}  // namespace

std::size_t message_block(std::size_t count, const Cast& cast) {
  const std::size_t wanted = count / (8 * std::max(cast.proposers, cast.weighers));
  return std::clamp<std::size_t>(std::bit_floor(wanted), 16, kBlock);
}

void RankStages::run(const Stages& stages) {
  if (!stages.weigh) return stages.propose(0, 0, stages.all);  // nothing to hand on: each rank does it all
  cut(stages);
  const std::size_t rank = team_->rank();
  if (rank < cast_.chains) {
    take(stages, rank);
    if (stages.take) collect_outcomes(stages, rank);
  } else if (rank < cast_.weigher(0)) {
    propose(stages, rank - cast_.proposer(0));
  } else {
    weigh(stages, rank - cast_.weigher(0));
  }
}

std::uint64_t RankStages::agreed(const std::function<std::uint64_t()>& find) {
  std::uint64_t number = team_->rank() == 0 ? find() : 0;
  team_->share(std::as_writable_bytes(std::span(&number, 1)));
  return number;
}

/// A block of each line in turn, so that all have something to take early.
void RankStages::cut(const Stages& stages) {
  const std::size_t length = block_ != 0 ? block_ : message_block(stages.all.size(), cast_);
  std::vector<std::vector<Block>> lines(stages.lines.size());
  std::size_t longest = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    for (const Stretch& stretch : stages.lines[k])
      for (std::size_t first = stretch.first; first < stretch.last; first += length)
        lines[k].push_back({{first, std::min(first + length, stretch.last)}, k});
    longest = std::max(longest, lines[k].size());
  }
  blocks_.clear();
  for (std::size_t i = 0; i < longest; ++i)
    for (const auto& line : lines)
      if (i < line.size()) blocks_.push_back(line[i]);
}

void RankStages::send(std::size_t to, const Memory& memory) {
  message_.clear();
  for (const auto& part : memory) message_.insert(message_.end(), part.begin(), part.end());
  team_->send(to, message_);
}

/// Receives blocks in order, with room for some ahead.
template <class Do>
void RankStages::receive_each(const Stages& stages, const std::vector<Visit>& visits, const Do& work) {
  std::array<std::vector<std::byte>, kUnderWay> rooms;
  const auto expect = [&](std::size_t i) {
    std::vector<std::byte>& room = rooms[i % kUnderWay];
    room.resize(bytes_of(stages.memory(visits[i].block->stretch)));
    team_->expect(visits[i].from, room);
  };
  for (std::size_t i = 0; i < std::min(kUnderWay, visits.size()); ++i) expect(i);
  for (std::size_t i = 0; i < visits.size(); ++i) {
    team_->await();
    read(stages.memory(visits[i].block->stretch), rooms[i % kUnderWay].data());
    if (i + kUnderWay < visits.size()) expect(i + kUnderWay);
    work(*visits[i].block);
  }
}

void RankStages::propose(const Stages& stages, std::size_t proposer) {
  for (std::size_t i = proposer; i < blocks_.size(); i += cast_.proposers) {
    stages.propose(0, blocks_[i].line, blocks_[i].stretch);
    send(cast_.weigher(i % cast_.weighers), stages.memory(blocks_[i].stretch));
  }
}

void RankStages::weigh(const Stages& stages, std::size_t weigher) {
  std::vector<Visit> visits;
  for (std::size_t i = weigher; i < blocks_.size(); i += cast_.weighers)
    visits.push_back({&blocks_[i], cast_.proposer(i % cast_.proposers)});
  receive_each(stages, visits, [&](const Block& block) {
    stages.weigh(block.stretch);
    const Memory memory = stages.memory(block.stretch);
    if (stages.take && block.line > 0) send(block.line, memory);
    send(0, memory);
  });
}

void RankStages::take(const Stages& stages, std::size_t line) {
  std::vector<Visit> visits;
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    if (line == 0 || (stages.take && blocks_[i].line == line))
      visits.push_back({&blocks_[i], cast_.weigher(i % cast_.weighers)});
  receive_each(stages, visits, [&](const Block& block) {
    if (stages.take && block.line == line) stages.take(block.stretch);
  });
}

void RankStages::collect_outcomes(const Stages& stages, std::size_t line) {
  if (line > 0) return send(0, stages.outcome(line));
  for (std::size_t other = 1; other < cast_.chains; ++other) {
    const Memory memory = stages.outcome(other);
    message_.resize(bytes_of(memory));
    team_->expect(other, message_);
    team_->await();
    read(memory, message_.data());
  }
}

}  // namespace mote
