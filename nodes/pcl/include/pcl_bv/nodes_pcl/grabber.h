// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Connects PCL's grabbers to a StreamRunner.
#pragma once

#include <pcl/io/grabber.h>

#include <functional>
#include <stdexcept>

#include "pcl_bv/nodes/cluster_pipeline.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {

/// Registers a callback that passes every cloud of the grabber to runner.push(). The callback runs in the
/// grabber's thread. Call the grabber's start() afterwards. Disconnect the returned connection, or stop the
/// grabber, before the runner is destroyed.
///
/// Throws std::invalid_argument if the grabber does not provide clouds of this point type. The PCDGrabber of
/// PCL 1.13 skips a file that it cannot read, and does not report how many times it has repeated its files.
template <typename PointT>
boost::signals2::connection connect(pcl::Grabber& grabber, StreamRunner& runner) {
  using Callback = void(const typename pcl::PointCloud<PointT>::ConstPtr&);
  if (!grabber.providesCallback<Callback>())
    throw std::invalid_argument(grabber.getName() + " provides no clouds of this point type");
  return grabber.registerCallback(
      std::function<Callback>([&runner](const typename pcl::PointCloud<PointT>::ConstPtr& cloud) {
        runner.push(make_frame<PointT>(cloud));
      }));
}

}  // namespace pcl_bv
