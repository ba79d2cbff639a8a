// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every allocation of this test program passes here. In a file of its own: where g++ 12 inlines the replaced
// operators, it takes their malloc and free for a mismatch.
#include "largest_allocation.h"

#include <cstdlib>
#include <new>

namespace pcl_bv {

std::atomic<std::size_t> largest_allocation{0};

}  // namespace pcl_bv

namespace {

void note(std::size_t bytes) {
  std::size_t largest = pcl_bv::largest_allocation;
  while (bytes > largest && !pcl_bv::largest_allocation.compare_exchange_weak(largest, bytes)) {
  }
}

}  // namespace

void* operator new(std::size_t bytes) {
  note(bytes);
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  note(bytes);
  const auto multiple = static_cast<std::size_t>(alignment);
  if (bytes <= static_cast<std::size_t>(-1) - multiple) {
    if (void* memory = std::aligned_alloc(multiple, (bytes + multiple - 1) / multiple * multiple))
      return memory;
  }
  throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
