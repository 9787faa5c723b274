#include "mote/software/threads.hpp"

#include <algorithm>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace mote {
namespace {

constexpr std::size_t kLeastShare = 8;  // blocks: some ten microseconds of work, a few times what a start costs

}  // namespace

struct Crew::Arena {
  // so that K shares run on K threads even where the machine has fewer cores
  tbb::global_control control;
  tbb::task_arena arena;
  explicit Arena(std::size_t threads)
      : control(tbb::global_control::max_allowed_parallelism, threads), arena(static_cast<int>(threads)) {
    arena.initialize();
  }
};

Crew::Crew(std::size_t threads) : threads_(std::max<std::size_t>(threads, 1)) {
  if (threads_ > 1) arena_ = std::make_unique<Arena>(threads_);
}
Crew::~Crew() = default;
Crew::Crew(Crew&&) noexcept = default;
Crew& Crew::operator=(Crew&&) noexcept = default;

std::size_t Crew::shares(std::size_t blocks) const {
  return std::clamp<std::size_t>(blocks / kLeastShare, 1, threads_);
}

void Crew::run_shares(std::size_t blocks, const void* work,
                      void (*call)(const void*, std::size_t, std::size_t, std::size_t)) {
  const std::size_t all = shares(blocks);
  arena_->arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, all, [&](std::size_t k) { call(work, k, blocks * k / all, blocks * (k + 1) / all); },
        tbb::static_partitioner());
  });
}

}  // namespace mote
