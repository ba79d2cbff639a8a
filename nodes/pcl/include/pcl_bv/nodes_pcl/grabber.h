// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// PCL's grabbers as a source of a StreamRunner.
#pragma once

#include <pcl/io/grabber.h>

#include <functional>
#include <stdexcept>

#include "pcl_bv/nodes/cluster_pipeline.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {

/// Hands every cloud of the grabber to the runner, in the grabber's thread, which does nothing else there:
/// start() the grabber afterwards. Disconnect, or stop the grabber, before the runner ends.
///
/// Throws std::invalid_argument if the grabber does not provide clouds of this point type. Of PCL 1.13's
/// grabbers, PCDGrabber sends nothing for a file that it cannot read, and repeats by rate without saying how
/// often.
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
