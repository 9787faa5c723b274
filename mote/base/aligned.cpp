#include "mote/base/aligned.hpp"

#include <new>

#include <sys/mman.h>

namespace mote {
namespace {

constexpr std::size_t kVector = 64;
constexpr std::size_t kHugePage = std::size_t{2} << 20U;

std::align_val_t alignment(std::size_t bytes) { return std::align_val_t{bytes < kHugePage ? kVector : kHugePage}; }

/// A huge page that is used in part is a huge page, too.
std::size_t padded(std::size_t bytes) {
  return bytes < kHugePage ? bytes : (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  void* memory = ::operator new(padded(bytes), alignment(bytes));
  // advice: what the kernel makes of it changes no result
  if (bytes >= kHugePage) madvise(memory, padded(bytes), MADV_HUGEPAGE);
  return memory;
}

void free_aligned(void* memory, std::size_t bytes) noexcept { ::operator delete(memory, alignment(bytes)); }

}  // namespace mote
