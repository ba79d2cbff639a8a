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

void* operator new(std::size_t bytes) {
  std::size_t largest = pcl_bv::largest_allocation;
  while (bytes > largest && !pcl_bv::largest_allocation.compare_exchange_weak(largest, bytes)) {
  }
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
