// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds in the memory of a graphics card.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "pcl_bv/gpu/gpu_device.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
class DevicePoints;
}

/// Where a fit reads the few points that the processor decides on.
enum class HostPoints : std::uint8_t {
  keep,    ///< From the view that was uploaded. Its memory or source must outlive the cloud and not change.
  release  ///< From the device. The view may be freed as soon as the cloud is made. For float points only.
};

/// Layout of points in memory of another program: records of x, y, z as float, as PointView describes them.
struct ImportedPoints {
  std::size_t bytes = 0;    ///< Size of the memory.
  std::size_t offset = 0;   ///< Bytes before x of the first point; a multiple of 4.
  std::size_t stride = 12;  ///< Bytes from one point to the next; a multiple of 4 from 12 to 1024.
  std::size_t count = 0;    ///< Number of points, at most GpuCloud::max_points.
};

/// Points in the memory of a device, in the order of the view from which they were made. Copies refer to the
/// same points. The points never change, except for imported memory.
///
/// A float point takes 12 bytes, a double point too: the device sees doubles only as rounded differences from
/// one of the points, which is enough to reject points. Points without finite coordinates are kept, and fits
/// drop them.
class GpuCloud {
 public:
  static constexpr std::size_t max_points = std::size_t{1} << 30;

  /// Copies the points to the device. `execution` says how many threads prepare the copy. O(n), one pass.
  ///
  /// Throws GpuError if the device has too little memory or was lost, and std::invalid_argument for more than
  /// max_points points and for double points with HostPoints::release. Exceptions of the points' source are
  /// passed on.
  GpuCloud(const GpuDevice& device, const PointView& points, HostPoints host = HostPoints::keep,
           const Execution& execution = {});

  /// Uses memory that another program or library has exported (VK_KHR_external_memory_fd, opaque handles:
  /// Vulkan; CUDA with CU_MEM_HANDLE_TYPE_POSIX_FILE_DESCRIPTOR). Copies nothing. The memory must be of the
  /// same device, in its own memory (device-local), and ImportedPoints::bytes must be the size that the
  /// exporter has allocated.
  ///
  /// On success the cloud owns `fd` and closes it; after an exception the caller still owns it. The memory
  /// lives until the exporter and all copies of the cloud have released it. The exporter must have finished
  /// writing before a fit starts, and must not write before the fit returns; between fits, points may change.
  ///
  /// Throws std::invalid_argument for a layout that is outside its ranges or its memory, and GpuError if the
  /// device cannot import memory (GpuInfo::imports) or refuses this handle.
  static GpuCloud import_memory(const GpuDevice& device, int fd, const ImportedPoints& layout);

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  const GpuDevice& device() const { return device_; }

  /// Returns the points as fits for the processor read them: the uploaded view, or a view that loads points
  /// from the device. The latter is valid while a copy of the cloud lives, and its loads throw GpuError.
  PointView points() const;

  const detail::DevicePoints& on_device() const { return *points_; }  ///< Private.

 private:
  GpuCloud(const GpuDevice& device, std::shared_ptr<const detail::DevicePoints> points);

  GpuDevice device_;
  std::shared_ptr<const detail::DevicePoints> points_;
};

}  // namespace pcl_bv
