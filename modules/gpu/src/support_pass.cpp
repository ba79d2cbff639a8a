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
  std::uint32_t listed_points;
};
struct PartPush {
  float center[3];
  std::uint32_t first_word, points, first_block;
};
struct LimitsPush {
  float center[3];
  std::uint32_t blocks, capacity;
};
struct NearPush {
  PartPush part;
  std::uint32_t capacity, points_capacity;
};
constexpr std::uint32_t kReducedBlocks = 256;    // that a workgroup reduces
constexpr std::uint32_t kNearPointGroups = 128;  // that share the listed blocks of a part
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

// The buffers and commands of one search.
class ExtremesPass {
 public:
  ExtremesPass(const DevicePoints& cloud, DirectionSet set, bool list)
      : cloud_(cloud),
        set_(static_cast<std::uint32_t>(set)),
        list_(list),
        list_points_(list && cloud.has_points_in_memory()),
        blocks_(static_cast<std::uint32_t>(block_count(cloud.size()))),
        capacity_(static_cast<std::uint32_t>(max_candidates(blocks_))),
        list_bytes_(list ? 4 * capacity_ : 4),
        points_bytes_(list_points_ ? 4 * max_near_points : 4),
        block_keys_(*cloud.context(), 8 * direction_count(set) * blocks_, BufferUse::device),
        results_(*cloud.context(), sizeof(CloudResults), BufferUse::device),
        candidates_(*cloud.context(), list_bytes_, BufferUse::device),
        near_points_(*cloud.context(), points_bytes_, BufferUse::device),
        answer_(*cloud.context(), sizeof(CloudResults) + list_bytes_ + points_bytes_, BufferUse::download) {}

  void run() {
    Submission submission(cloud_.context());
    submission.fill(results_, 0, offsetof(CloudResults, dropped), static_cast<std::uint32_t>(kNoKey));
    submission.fill(results_, offsetof(CloudResults, dropped), 12, 0, Order::beside_previous);
    find_block_extremes(submission);
    reduce_blocks(submission);
    if (list_) list_candidates(submission);
    if (list_points_) list_near_points(submission);
    submission.copy(results_, 0, answer_, 0, sizeof(CloudResults));
    submission.run();
  }

  DeviceExtremes found() const {
    CloudResults results;
    std::memcpy(&results, answer_.mapped(), sizeof results);
    DeviceExtremes found;
    found.dropped = results.dropped;
    for (std::size_t axis = 0; axis < 3 && results.dropped < cloud_.size(); ++axis) {
      found.low[axis] = float_of(~results.keys[2 * axis]);
      found.high[axis] = float_of(results.keys[2 * axis + 1]);
    }
    found.complete = list_ && results.listed <= capacity_ && sums_are_finite(found, cloud_.center());
    if (!found.complete || results.listed == 0) return found;
    found.candidates = sorted_list<std::uint32_t>(sizeof results, results.listed);
    if (list_points_ && results.listed_points <= max_near_points)
      found.near_points = sorted_list<std::int32_t>(sizeof results + list_bytes_, results.listed_points);
    return found;
  }

 private:
  template <typename T>
  std::vector<T> sorted_list(std::size_t byte, std::size_t size) const {
    std::vector<T> list(size);
    if (size > 0) std::memcpy(list.data(), answer_.mapped() + byte, sizeof(T) * size);
    std::sort(list.begin(), list.end());
    return list;
  }

  PartPush push_of(const PointPart& part) const {
    const std::array<float, 3>& center = cloud_.center();
    return {{center[0], center[1], center[2]},
            part.first_word,
            static_cast<std::uint32_t>(part.count),
            static_cast<std::uint32_t>(part.first / kBlockPoints)};
  }

  void find_block_extremes(Submission& submission) const {
    const ComputePipeline& pipeline =
        cloud_.context()->pipeline(Shader::extremes, {set_, cloud_.stride_words()});
    for (const PointPart& part : cloud_.parts()) {
      submission.dispatch(pipeline, {part.binding, {block_keys_.get()}, {results_.get()}}, push_of(part),
                          static_cast<std::uint32_t>(block_count(part.count)), order_in(cloud_, part));
    }
  }

  void reduce_blocks(Submission& submission) const {
    submission.dispatch(cloud_.context()->pipeline(Shader::cloud_keys, {set_}),
                        {{block_keys_.get()}, {results_.get()}}, blocks_,
                        (blocks_ + kReducedBlocks - 1) / kReducedBlocks);
  }

  void list_candidates(Submission& submission) const {
    const std::array<float, 3>& center = cloud_.center();
    const LimitsPush push{{center[0], center[1], center[2]}, blocks_, capacity_};
    submission.dispatch(cloud_.context()->pipeline(Shader::candidates, {set_}),
                        {{block_keys_.get()}, {results_.get()}, {candidates_.get()}}, push,
                        (blocks_ + kWorkgroup - 1) / kWorkgroup);
    submission.copy(candidates_, 0, answer_, sizeof(CloudResults), list_bytes_);
  }

  void list_near_points(Submission& submission) const {
    const ComputePipeline& pipeline =
        cloud_.context()->pipeline(Shader::near_points, {set_, cloud_.stride_words()});
    for (const PointPart& part : cloud_.parts()) {
      const NearPush push{push_of(part), capacity_, max_near_points};
      submission.dispatch(pipeline,
                          {part.binding, {results_.get()}, {candidates_.get()}, {near_points_.get()}}, push,
                          std::min(static_cast<std::uint32_t>(block_count(part.count)), kNearPointGroups),
                          order_in(cloud_, part));
    }
    submission.copy(near_points_, 0, answer_, sizeof(CloudResults) + list_bytes_, points_bytes_);
  }

  const DevicePoints& cloud_;
  std::uint32_t set_;
  bool list_, list_points_;
  std::uint32_t blocks_, capacity_;
  std::size_t list_bytes_, points_bytes_;
  ScratchBuffer block_keys_, results_, candidates_, near_points_, answer_;
};

}  // namespace

DeviceExtremes find_extremes(const DevicePoints& cloud, DirectionSet set, bool list) {
  ExtremesPass pass(cloud, set, list);
  pass.run();
  return pass.found();
}

}  // namespace pcl_bv::detail
