#include "mote/engine/stream.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "mote/model/bearings.hpp"
#include "mote/software/engines.hpp"
#include "mote/software/simd/here.hpp"

namespace {
std::atomic<std::size_t> allocations{0};
}

[[gnu::noinline]] void* operator new(std::size_t bytes) {
  ++allocations;
  void* memory = std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
  ++allocations;
  void* memory = std::aligned_alloc(static_cast<std::size_t>(alignment),
                                    (bytes + 4095) / 4096 * 4096 + static_cast<std::size_t>(alignment));
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace mote {
namespace {

/// Allocations of twenty steps, after as many to get used to them.
std::size_t allocations_of(const SelectionOptions& selection, std::size_t particles = 10000, std::size_t threads = 1,
                           FilterKind filter = FilterKind::kSisr) {
  const Bearings model;
  Plan plan;
  plan.filter = filter;
  plan.particles = particles;
  plan.precision = Precision::kFloat;
  plan.selection = selection;
  plan.on_collapse = OnCollapse::kKeep;
  plan.threads = threads;
  Stream stream(simd_filter<Bearings, kIsaHere>(model, plan, "test"), model.states(), model.columns());
  auto row = blank_row(model);
  row.values[0] = 0.8;
  std::size_t before = 0;
  for (int k = 0; k < 40; ++k) {
    if (k == 20) before = allocations;
    row.present[0] = k % 5 != 4;  // now and then nothing is seen
    stream.step({&row, 1});
  }
  return allocations - before;
}

TEST(Stream, AllocatesNothingWhileItRuns) { EXPECT_EQ(allocations_of({}), 0U); }

TEST(Stream, AllocatesNothingOnSeveralThreads) { EXPECT_EQ(allocations_of({}, 100000, 3), 0U); }

TEST(Stream, AllocatesNothingWithPoints) {
  EXPECT_EQ(allocations_of({}, 10000, 1, FilterKind::kSqmc), 0U);
  EXPECT_EQ(allocations_of({}, 100000, 3, FilterKind::kSqmc), 0U);
}

TEST(Stream, TwinAResamplerThatListsAncestorsIsCaught) { EXPECT_GT(allocations_of({find_scheme("alias"), 1, 1}), 0U); }

}  // namespace
}  // namespace mote
