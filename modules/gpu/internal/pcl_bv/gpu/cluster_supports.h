// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Supports of the clusters of a frame, found on a graphics card.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/gpu/gpu_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

class DevicePoints;

/// Returns the supports of points on a device, with the support points or, if `detail` is `bounds` and the
/// device has the coordinates themselves, without. Returns nothing if the processor has to search them.
/// Throws GpuError, and std::invalid_argument if the points have changed since they were uploaded.
std::optional<Supports> supports_on_device(const DevicePoints& cloud, DirectionSet set, SupportDetail detail,
                                           const FitExecution& execution);

/// Returns an object that rejects blocks of the cloud on its device, or null if the device cannot (double
/// points). The cloud must outlive the object.
std::unique_ptr<FarBlocks> far_blocks_on_device(const DevicePoints& cloud);

/// Uploads each view of at least kFewestPoints points and finds its supports on the device.
class ClusterSupports : public SupportFinder {
 public:
  /// Smaller views take longer to upload than to search.
  static constexpr std::size_t kFewestPoints = 32768;

  explicit ClusterSupports(const GpuDevice& device) : device_(device) {}

  void find(const std::vector<PointView>& views, DirectionSet set, const Execution& execution) override;
  FitExecution known(std::size_t i, const Execution& execution) const override;

 protected:
  void forget() { found_.clear(); }

 private:
  // What is known about a view that was uploaded.
  struct Found {
    GpuCloud cloud;
    std::optional<Supports> supports;
    std::unique_ptr<FarBlocks> far_blocks;
  };

  GpuDevice device_;
  std::vector<std::optional<Found>> found_;
};

}  // namespace detail
}  // namespace pcl_bv
