// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bytes of clouds. Where a reader fills them at once, zeros first and a page fault for each 4 KiB would
// take longer than the reading itself.
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

/// A standard allocator. Elements that are given no value are left uninitialised; from 4 MiB on, memory
/// begins at a multiple of 2 MiB and the system is asked to back it with pages of that size.
template <typename T>
class BufferAllocator {
 public:
  using value_type = T;

  BufferAllocator() = default;
  template <typename U>
  BufferAllocator(const BufferAllocator<U>&) noexcept {}

  /// Throws std::bad_alloc.
  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(internal::allocate_buffer(n * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t n) noexcept { internal::free_buffer(memory, n * sizeof(T)); }

  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }

  friend bool operator==(const BufferAllocator&, const BufferAllocator&) { return true; }
  friend bool operator!=(const BufferAllocator&, const BufferAllocator&) { return false; }
};

/// Bytes that resize() leaves as they are: only for what is written before it is read.
using ByteBuffer = std::vector<std::byte, BufferAllocator<std::byte>>;

}  // namespace pcl_bv
