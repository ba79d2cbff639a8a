// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The tree of a GpuTree.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "device_buffer.h"
#include "device_points.h"
#include "pcl_bv/gpu/gpu_cloud.h"
#include "pcl_bv/trees/point_tree.h"
#include "submission.h"
#include "support_pass.h"

namespace pcl_bv::detail {

/// The tree of one part of a cloud.
struct TreePart {
  static constexpr std::size_t kMaxLevels = 6;

  TreePart(GpuContext& context, const PointPart& points);

  std::size_t first, count;  ///< Range of the points in the cloud.
  std::uint32_t levels = 0;
  std::array<std::uint32_t, kMaxLevels + 1> first_group{};  ///< Of each level, and the number of all groups.
  std::unique_ptr<DeviceBuffer> order;    ///< Numbers of the points, sorted along the curve.
  std::unique_ptr<DeviceBuffer> packets;  ///< Coordinates in this order, as in PointPacket<float>.
  std::unique_ptr<DeviceBuffer> numbers;  ///< Number of each point of a packet.
  std::unique_ptr<DeviceBuffer> boxes;    ///< As BoxGroup, relative to the centre of the tree.
};

class DeviceTree {
 public:
  /// Throws as GpuTree's constructor.
  explicit DeviceTree(const GpuCloud& cloud);

  void refit(const GpuCloud& cloud);

  std::size_t size() const { return cloud_.size() - dropped_; }
  std::size_t dropped() const { return dropped_; }
  const GpuCloud& cloud() const { return cloud_; }
  const std::vector<TreePart>& parts() const { return parts_; }
  const std::array<float, 3>& center() const { return cloud_.on_device().center(); }
  /// The largest difference of a coordinate of a point and of the centre; 0 without a valid point.
  double extent() const { return extent_; }

  /// Returns the tree for queries that the device leaves to the processor. Builds it at the first call.
  const PointTree& on_host(const Execution& execution) const;

 private:
  void take_extremes(const DeviceExtremes& extremes);
  void fill_packets(Submission& submission, const DevicePoints& points) const;

  GpuCloud cloud_;
  std::vector<TreePart> parts_;
  std::size_t dropped_ = 0;
  double extent_ = 0;
  mutable std::mutex mutex_;  // protects host_
  mutable std::unique_ptr<PointTree> host_;
};

}  // namespace pcl_bv::detail
