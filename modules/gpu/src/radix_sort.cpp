// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "radix_sort.h"

#include <utility>

namespace pcl_bv::detail {
namespace {

// As in radix.glsl.
constexpr std::uint32_t kDigits = 16, kDigitBits = 4, kTile = 512;
// More runs occupy more of a card, but a single workgroup adds up the counts of all runs.
constexpr std::uint32_t kMostRuns = 2048;

// Push constants of the shaders.
struct PassPush {
  std::uint32_t count, run, runs, shift;
};
struct SumsPush {
  std::uint32_t size;
};

}  // namespace

SortBuffers::SortBuffers(GpuContext& context, std::size_t most_keys)
    : keys_(context, 4 * most_keys, BufferUse::device),
      other_keys_(context, 4 * most_keys, BufferUse::device),
      other_numbers_(context, 4 * most_keys, BufferUse::device),
      counts_(context, std::size_t{4} * kDigits * kMostRuns, BufferUse::device) {}

void sort_by_keys(Submission& submission, GpuContext& context, const SortBuffers& buffers,
                  const DeviceBuffer& numbers, std::uint32_t count, std::uint32_t key_bits) {
  const std::uint32_t tiles = (count + kTile - 1) / kTile;
  const std::uint32_t run = (tiles + kMostRuns - 1) / kMostRuns * kTile;
  const std::uint32_t runs = (count + run - 1) / run;
  const ComputePipeline& counts = context.pipeline(Shader::digit_counts, {});
  const ComputePipeline& sums = context.pipeline(Shader::digit_sums, {});
  const ComputePipeline& scatter = context.pipeline(Shader::scatter, {});
  const DeviceBuffer* keys = buffers.keys_.get();
  const DeviceBuffer* other_keys = buffers.other_keys_.get();
  const DeviceBuffer* from = &numbers;
  const DeviceBuffer* to = buffers.other_numbers_.get();
  const Binding begins{buffers.counts_.get()};
  for (std::uint32_t shift = 0; shift < key_bits; shift += kDigitBits) {
    const PassPush push{count, run, runs, shift};
    submission.dispatch(counts, {{keys}, begins}, push, runs);
    submission.dispatch(sums, {begins}, SumsPush{kDigits * runs}, 1);
    submission.dispatch(scatter, {{keys}, {from}, begins, {other_keys}, {to}}, push, runs);
    std::swap(keys, other_keys);
    std::swap(from, to);
  }
}

}  // namespace pcl_bv::detail
