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

// The buffers and commands of one search.
class ExtremesPass {
 public:
  ExtremesPass(const DevicePoints& cloud, DirectionSet set, bool list)
      : cloud_(cloud),
        set_(static_cast<std::uint32_t>(set)),
        list_(list),
        blocks_(static_cast<std::uint32_t>(block_count(cloud.size()))),
        capacity_(static_cast<std::uint32_t>(max_candidates(blocks_))),
        list_bytes_(list ? 4 * capacity_ : 4),
        block_keys_(*cloud.context(), 8 * direction_count(set) * blocks_, BufferUse::device),
        results_(*cloud.context(), sizeof(CloudResults), BufferUse::device),
        candidates_(*cloud.context(), list_bytes_, BufferUse::device),
        answer_(*cloud.context(), sizeof(CloudResults) + list_bytes_, BufferUse::download) {}

  void run() {
    Submission submission(cloud_.context());
    submission.fill(results_, 0, offsetof(CloudResults, dropped), static_cast<std::uint32_t>(kNoKey));
    submission.fill(results_, offsetof(CloudResults, dropped), 8, 0, Order::beside_previous);
    find_extremes(submission);
    if (list_) list_candidates(submission);
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
    found.candidates.resize(results.listed);
    std::memcpy(found.candidates.data(), answer_.mapped() + sizeof results, 4 * found.candidates.size());
    std::sort(found.candidates.begin(), found.candidates.end());
    return found;
  }

 private:
  void find_extremes(Submission& submission) const {
    const std::array<float, 3>& center = cloud_.center();
    const ComputePipeline& pipeline =
        cloud_.context()->pipeline(Shader::extremes, {set_, cloud_.stride_words()});
    for (const PointPart& part : cloud_.parts()) {
      const PartPush push{{center[0], center[1], center[2]},
                          part.first_word,
                          static_cast<std::uint32_t>(part.count),
                          static_cast<std::uint32_t>(part.first / kBlockPoints),
                          blocks_};
      submission.dispatch(pipeline, {part.binding, {block_keys_.get()}, {results_.get()}}, push,
                          static_cast<std::uint32_t>(block_count(part.count)), order_in(cloud_, part));
    }
  }

  void list_candidates(Submission& submission) const {
    const std::array<float, 3>& center = cloud_.center();
    const LimitsPush push{{center[0], center[1], center[2]}, blocks_, capacity_};
    submission.dispatch(cloud_.context()->pipeline(Shader::candidates, {set_}),
                        {{block_keys_.get()}, {results_.get()}, {candidates_.get()}}, push,
                        (blocks_ + kWorkgroup - 1) / kWorkgroup);
    submission.copy(candidates_, 0, answer_, sizeof(CloudResults), list_bytes_);
  }

  const DevicePoints& cloud_;
  std::uint32_t set_;
  bool list_;
  std::uint32_t blocks_, capacity_;
  std::size_t list_bytes_;
  ScratchBuffer block_keys_, results_, candidates_, answer_;
};

}  // namespace

DeviceExtremes find_extremes(const DevicePoints& cloud, DirectionSet set, bool list) {
  ExtremesPass pass(cloud, set, list);
  pass.run();
  return pass.found();
}

}  // namespace pcl_bv::detail
