// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fields between records and arrays: the one loop behind decompression, packing and new fields.
#pragma once

#include <cstddef>

namespace pcl_bv {

/// Where the elements of a strided copy lie: the first one `offset` bytes after `base`, each `stride` bytes
/// after the one before it. `base` may be null if there are none.
template <typename Byte>
struct Strided {
  Byte* base;
  std::size_t offset;
  std::size_t stride;
};
using StridedSource = Strided<const std::byte>;
using StridedTarget = Strided<std::byte>;

/// Copies `count` elements of `bytes` bytes each. The two must not overlap.
void copy_strided(StridedSource from, StridedTarget to, std::size_t bytes, std::size_t count);

}  // namespace pcl_bv
