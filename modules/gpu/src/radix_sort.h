// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Radix sort on a device (Satish, Harris, Garland 2009).
#pragma once

#include <cstdint>

#include "device_buffer.h"
#include "submission.h"

namespace pcl_bv::detail {

/// Buffers of a sort. Each has space for the largest number of keys.
class SortBuffers {
 public:
  SortBuffers(GpuContext& context, std::size_t most_keys);

  const DeviceBuffer& keys() const { return keys_; }

 private:
  friend void sort_by_keys(Submission& submission, GpuContext& context, const SortBuffers& buffers,
                           const DeviceBuffer& numbers, std::uint32_t count, std::uint32_t key_bits);

  ScratchBuffer keys_, other_keys_, other_numbers_, counts_;
};

/// Adds commands that sort `numbers` by SortBuffers::keys(). Equal keys keep their order. `key_bits` must be
/// a multiple of 8; higher bits of the keys are ignored.
void sort_by_keys(Submission& submission, GpuContext& context, const SortBuffers& buffers,
                  const DeviceBuffer& numbers, std::uint32_t count, std::uint32_t key_bits);

}  // namespace pcl_bv::detail
