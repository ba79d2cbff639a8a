// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of a GpuCloud.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "device_buffer.h"
#include "pcl_bv/gpu/gpu_cloud.h"
#include "pcl_bv/points/point_source.h"
#include "submission.h"

namespace pcl_bv::detail {

/// Consecutive points of a cloud that one binding of a shader can see.
struct PointPart {
  Binding binding;
  std::uint32_t first_word;  ///< Of the first point in the binding, in units of 4 bytes.
  std::size_t first;         ///< Number of the first point; a multiple of kBlockPoints.
  std::size_t count;         ///< Number of points.
  std::size_t byte;          ///< Position of the first point in the buffer.
};

class DevicePoints : public PointSource {
 public:
  /// Uploads points.
  DevicePoints(std::shared_ptr<GpuContext> context, const PointView& points, HostPoints host,
               const Execution& execution);
  /// Imports memory.
  DevicePoints(std::shared_ptr<GpuContext> context, int fd, const ImportedPoints& layout);

  const std::shared_ptr<GpuContext>& context() const { return context_; }
  std::size_t size() const { return size_; }
  const std::vector<PointPart>& parts() const { return parts_; }
  /// Words of 4 bytes from one point to the next.
  std::uint32_t stride_words() const { return static_cast<std::uint32_t>(stride_ / 4); }
  /// The point that shaders subtract. Rounded points are relative to another one already.
  const std::array<float, 3>& center() const { return center_; }
  /// Whether the device has rounded copies of double points, relative to one of them.
  bool rounded() const { return rounded_; }

  /// GpuCloud::points().
  PointView points() const;

  /// Returns a view of each block, in memory or of the uploaded view's source. `storage` holds points that
  /// are downloaded, all at once, and must outlive the views.
  std::vector<PointView> blocks(const std::vector<std::uint32_t>& numbers,
                                std::vector<std::byte>& storage) const;

  /// Like blocks(), for any slices of points().
  std::vector<PointView> in_memory(std::vector<PointView> slices, std::vector<std::byte>& storage) const;

  /// Whether positions in the cloud are also the indices that IndexLists use, so that lists need no
  /// translation.
  bool numbered_from_zero() const { return !kept_ || (host_.indices == nullptr && host_.first == 0); }
  bool kept() const { return kept_; }

  /// Whether the processor can read single points of points(): they are in memory, with indices below 2^31.
  bool has_points_in_memory() const {
    return kept_ && host_.source == nullptr &&
           (host_.indices != nullptr || host_.first + size_ <= std::size_t{1} << 31);
  }

  /// Returns a view of points at ascending positions in the cloud. has_points_in_memory() must be true.
  /// `positions` must outlive the view and becomes the points' indices.
  PointView select(std::vector<std::int32_t>& positions) const;

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override;

 private:
  void divide(std::size_t offset);
  void upload(const PointView& points, const Coordinates& origin, const Execution& execution);
  const PointPart& part_of(std::size_t point) const;
  PointView view_of_bytes(const std::byte* bytes, std::size_t first, std::size_t count) const;
  // A range of a part's buffer, and where its bytes go.
  struct Download {
    const PointPart* part;
    std::size_t from, to, bytes;
  };
  void download(const std::vector<PointView>& slices, std::byte* to) const;
  void run_downloads(const std::vector<Download>& batch, std::size_t bytes, std::byte* to) const;
  std::size_t copied_bytes(std::size_t points) const { return (points - 1) * stride_ + 12; }

  std::shared_ptr<GpuContext> context_;
  std::vector<std::unique_ptr<DeviceBuffer>> buffers_;
  std::vector<PointPart> parts_;
  std::size_t size_;
  std::size_t stride_ = 12;
  bool rounded_ = false;
  std::array<float, 3> center_{};
  PointView host_;  // the uploaded view, if it is kept; otherwise without points
  bool kept_ = false;
};

/// Returns the order for a pass over all parts: the parts run beside one another.
inline Order order_in(const DevicePoints& cloud, const PointPart& part) {
  return &part == &cloud.parts().front() ? Order::after_earlier : Order::beside_previous;
}

}  // namespace pcl_bv::detail
