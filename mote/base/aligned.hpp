#pragma once
/// Memory for long columns of numbers: aligned to a vector's 64 bytes, in huge pages when it is long.

#include <cstddef>
#include <vector>

namespace mote {

/// Bytes on a 64-byte boundary; from 2 MB on, whole huge pages of 2 MB, if the kernel has them to give.
///
/// error   std::bad_alloc
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory, std::size_t bytes) noexcept;

/// The allocator of AlignedVector.
template <class T>
struct AlignedAllocator {
  using value_type = T;  // NOLINT(readability-identifier-naming): as the standard names it

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT(google-explicit-constructor): rebinding, as allocators do

  T* allocate(std::size_t n) { return static_cast<T*>(allocate_aligned(n * sizeof(T))); }
  void deallocate(T* memory, std::size_t n) noexcept { free_aligned(memory, n * sizeof(T)); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace mote
