// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/raw_cloud.h"

#include <sys/mman.h>

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

// Minimum size for huge pages. In a smaller block, the unused rest of the last page would be a too large part
// of the block.
constexpr std::size_t kMinHugeBlock = 2 * kHugePage;

}  // namespace

void* allocate_buffer(std::size_t bytes) {
  if (bytes < kMinHugeBlock) return ::operator new(bytes);
  void* memory = ::operator new (bytes, std::align_val_t{kHugePage});
  ::madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
  return memory;
}

void free_buffer(void* memory, std::size_t bytes) noexcept {
  if (bytes < kMinHugeBlock) return ::operator delete(memory);
  ::operator delete (memory, std::align_val_t{kHugePage});
}

}  // namespace pcl_bv::detail
