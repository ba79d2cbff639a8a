// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Memory for the bytes of clouds. It is not zeroed, and large blocks use huge pages, because zeroing and a
// page fault for each 4 KiB would take longer than reading the file.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {
namespace internal {
void* allocate_buffer(std::size_t bytes);
void free_buffer(void* memory, std::size_t bytes) noexcept;
}  // namespace internal

/// Standard allocator that leaves value-initialised elements uninitialised, such as the new elements of
/// std::vector::resize(). Blocks of 4 MiB or more are aligned to 2 MiB, and the operating system is advised
/// to use huge pages of 2 MiB for them.
template <typename T>
class BufferAllocator {
 public:
  using value_type = T;

  BufferAllocator() = default;
  template <typename U>
  BufferAllocator(const BufferAllocator<U>&) noexcept {}

  /// Returns uninitialised memory for `n` elements. Throws std::bad_alloc.
  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(internal::allocate_buffer(n * sizeof(T)));
  }
  /// Frees memory that allocate(n) returned.
  void deallocate(T* memory, std::size_t n) noexcept { internal::free_buffer(memory, n * sizeof(T)); }

  /// Leaves the element uninitialised if it is of a trivial type.
  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  /// Constructs an element from these values.
  template <typename U, typename... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }

  friend bool operator==(const BufferAllocator&, const BufferAllocator&) { return true; }
  friend bool operator!=(const BufferAllocator&, const BufferAllocator&) { return false; }
};

/// Vector of bytes. resize() leaves the new bytes uninitialised. Write them before reading them.
using ByteBuffer = std::vector<std::byte, BufferAllocator<std::byte>>;

}  // namespace pcl_bv
