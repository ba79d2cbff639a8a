// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "pcl_bv/gpu/cluster_supports.h"
#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/numeric/directed.h"
#include "support_pass.h"

namespace pcl_bv::detail {
namespace {

// What the shader declares.
struct DistancePush {
  float center[3], rest[3], limit;
  std::uint32_t first_word, points, first_block, capacity;
};

// Returns the limit for the squared distances of the device, or nothing if floats cannot reject any point. A
// point whose squared distance in double is at least `limit` has one of at least the result on the device.
std::optional<float> limit_on_device(const DistanceCenter& center, double limit) {
  const double magnitude = std::abs(center.x) + std::abs(center.y) + std::abs(center.z);
  // The second term is for what two floats cannot hold of the centre, the third one for denormal numbers.
  const double radius = std::sqrt(std::max(limit, 0.0)) * (1 - 0x1p-18) - magnitude * 0x1p-44 - 0x1p-100;
  if (!(radius > 0x1p-45 && radius < 0x1p60)) return std::nullopt;
  return float_down(radius * radius);
}

class DeviceFarBlocks : public FarBlocks {
 public:
  explicit DeviceFarBlocks(const DevicePoints& cloud)
      : cloud_(cloud), capacity_(max_candidates(block_count(cloud.size()))) {}

  bool find(const DistanceCenter& center, double limit, std::vector<std::uint32_t>& blocks) const override {
    const std::optional<float> float_limit = limit_on_device(center, limit);
    if (!float_limit || center.scale != 1) return false;
    const ScratchBuffer answer(*cloud_.context(), 4 * (1 + capacity_), BufferUse::download);
    list_blocks(center, *float_limit, answer);
    std::uint32_t listed;
    std::memcpy(&listed, answer.mapped(), sizeof listed);
    if (listed > capacity_) return false;
    blocks.resize(listed);
    if (listed > 0) std::memcpy(blocks.data(), answer.mapped() + 4, 4 * blocks.size());
    std::sort(blocks.begin(), blocks.end());
    return true;
  }

 private:
  // Writes the number of blocks, and then the numbers of as many as the capacity allows.
  void list_blocks(const DistanceCenter& center, float limit, const ScratchBuffer& answer) const {
    const std::shared_ptr<GpuContext>& context = cloud_.context();
    const std::size_t bytes = 4 * (1 + capacity_);
    const ScratchBuffer list(*context, bytes, BufferUse::device);
    const ComputePipeline& pipeline = context->pipeline(Shader::distances, {cloud_.stride_words()});
    DistancePush push{};
    const double exact[3] = {center.x, center.y, center.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      push.center[axis] = static_cast<float>(exact[axis]);
      push.rest[axis] = static_cast<float>(exact[axis] - push.center[axis]);
    }
    push.limit = limit;
    push.capacity = static_cast<std::uint32_t>(capacity_);
    Submission submission(context);
    submission.fill(list, 0, 4, 0);
    for (const PointPart& part : cloud_.parts()) {
      push.first_word = part.first_word;
      push.points = static_cast<std::uint32_t>(part.count);
      push.first_block = static_cast<std::uint32_t>(part.first / kBlockPoints);
      submission.dispatch(pipeline, {part.binding, {list.get()}}, push,
                          static_cast<std::uint32_t>(block_count(part.count)), order_in(cloud_, part));
    }
    submission.copy(list, 0, answer, 0, bytes);
    submission.run();
  }

  const DevicePoints& cloud_;
  std::size_t capacity_;
};

}  // namespace

std::unique_ptr<FarBlocks> far_blocks_on_device(const DevicePoints& cloud) {
  if (cloud.rounded() || cloud.size() == 0) return nullptr;
  return std::make_unique<DeviceFarBlocks>(cloud);
}

}  // namespace pcl_bv::detail
