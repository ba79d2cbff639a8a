// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/byte_buffer.h"

#include <sys/mman.h>

namespace pcl_bv::internal {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;

// Minimum size for huge pages: in smaller blocks the unused rest of the last page would be too large a part.
constexpr std::size_t least_huge = 2 * huge_page;

}  // namespace

void* allocate_buffer(std::size_t bytes) {
  if (bytes < least_huge) return ::operator new(bytes);
  void* memory = ::operator new (bytes, std::align_val_t{huge_page});
  ::madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
  return memory;
}

void free_buffer(void* memory, std::size_t bytes) noexcept {
  if (bytes < least_huge) return ::operator delete(memory);
  ::operator delete (memory, std::align_val_t{huge_page});
}

}  // namespace pcl_bv::internal
