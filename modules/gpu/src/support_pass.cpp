// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "support_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pcl_bv/kernels/distances.h"

namespace pcl_bv::detail {
namespace {

// What the shaders declare.
struct CloudResults {
  std::int32_t keys[26];
  std::uint32_t dropped;
  std::uint32_t listed;
};
struct PartPush {
  float center[3];
  std::uint32_t first_word, points, first_block, blocks;
};
struct LimitsPush {
  float center[3];
  std::uint32_t blocks, capacity;
};
constexpr std::int32_t kNoKey = INT32_MIN;

float float_of(std::int32_t key) {
  const std::int32_t bits = key ^ ((key >> 31) & 0x7fffffff);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// Sums of coordinates relative to the centre are finite on the device if their magnitudes sum up to less than
// this.
constexpr double kLargestSum = 0x1p126;

bool sums_are_finite(const DeviceExtremes& extremes, const std::array<float, 3>& center) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double c = center[axis];
    sum += std::max(std::abs(extremes.low[axis] - c), std::abs(extremes.high[axis] - c));
  }
  return sum < kLargestSum;
}

}  // namespace

DeviceExtremes find_extremes(const DevicePoints& cloud, DirectionSet set, bool list) {
  const std::shared_ptr<GpuContext>& context = cloud.context();
  const auto blocks = static_cast<std::uint32_t>(block_count(cloud.size()));
  const auto capacity = static_cast<std::uint32_t>(max_candidates(blocks));
  const std::size_t supports = 2 * direction_count(set);
  const auto directions = static_cast<std::uint32_t>(set);
  const std::array<float, 3>& center = cloud.center();
  const ComputePipeline& extremes = context->pipeline(Shader::extremes, {directions, cloud.stride_words()});

  const ScratchBuffer block_keys(*context, 4 * supports * blocks, BufferUse::device);
  const ScratchBuffer results(*context, sizeof(CloudResults), BufferUse::device);
  const std::size_t list_bytes = list ? 4 * capacity : 4;
  const ScratchBuffer candidates(*context, list_bytes, BufferUse::device);
  const ScratchBuffer answer(*context, sizeof(CloudResults) + list_bytes, BufferUse::download);

  Submission submission(context);
  submission.fill(results, 0, offsetof(CloudResults, dropped), static_cast<std::uint32_t>(kNoKey));
  submission.fill(results, offsetof(CloudResults, dropped), 8, 0, Order::beside_previous);
  for (const PointPart& part : cloud.parts()) {
    const PartPush push{{center[0], center[1], center[2]},
                        part.first_word,
                        static_cast<std::uint32_t>(part.count),
                        static_cast<std::uint32_t>(part.first / kBlockPoints),
                        blocks};
    submission.dispatch(extremes, {part.binding, {block_keys.get()}, {results.get()}}, push,
                        static_cast<std::uint32_t>(block_count(part.count)), order_in(cloud, part));
  }
  if (list) {
    const LimitsPush push{{center[0], center[1], center[2]}, blocks, capacity};
    submission.dispatch(context->pipeline(Shader::candidates, {directions}),
                        {{block_keys.get()}, {results.get()}, {candidates.get()}}, push,
                        (blocks + kWorkgroup - 1) / kWorkgroup);
    submission.copy(candidates, 0, answer, sizeof(CloudResults), list_bytes);
  }
  submission.copy(results, 0, answer, 0, sizeof(CloudResults));
  submission.run();

  CloudResults found;
  std::memcpy(&found, answer.mapped(), sizeof found);
  DeviceExtremes extremes_found;
  extremes_found.dropped = found.dropped;
  for (std::size_t axis = 0; axis < 3 && found.dropped < cloud.size(); ++axis) {
    extremes_found.low[axis] = float_of(~found.keys[2 * axis]);
    extremes_found.high[axis] = float_of(found.keys[2 * axis + 1]);
  }
  extremes_found.complete = list && found.listed <= capacity && sums_are_finite(extremes_found, center);
  if (!extremes_found.complete) return extremes_found;
  std::vector<std::uint32_t>& numbers = extremes_found.candidates;
  numbers.resize(found.listed);
  if (!numbers.empty()) std::memcpy(numbers.data(), answer.mapped() + sizeof found, 4 * numbers.size());
  std::sort(numbers.begin(), numbers.end());
  return extremes_found;
}

}  // namespace pcl_bv::detail
