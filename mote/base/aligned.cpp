#include "mote/base/aligned.hpp"

#include <new>

#include <sys/mman.h>

namespace mote {
namespace {

constexpr std::size_t kVector = 64;
constexpr std::size_t kHugePage = std::size_t{2} << 20U;
constexpr std::size_t kLong = 2 * kHugePage;

std::align_val_t alignment(std::size_t bytes) { return std::align_val_t{bytes < kLong ? kVector : kHugePage}; }

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  void* memory = ::operator new(bytes, alignment(bytes));
  if (bytes >= kLong) madvise(memory, bytes, MADV_HUGEPAGE);  // advice: what the kernel makes of it changes no result
  return memory;
}

void free_aligned(void* memory, std::size_t bytes) noexcept { ::operator delete(memory, alignment(bytes)); }

}  // namespace mote
