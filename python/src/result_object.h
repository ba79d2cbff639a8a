// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of Python's Result and Cluster.
#pragma once

#include "arrays.h"
#include "pcl_bv/nodes/frame_result.h"

namespace pcl_bv::python {
using namespace detail;

/// The result for a frame, and the frame's points. Pictures and clusters of the result need these points.
struct ResultObject {
  FrameResult result;
  PointArray points;
  std::optional<Pose> pose{};

  Frame frame() const {
    Frame frame;
    frame.header = result.header;
    frame.points = points.view;
    frame.pose = pose;
    return frame;
  }
};

/// A cluster of a result. It keeps the result alive.
struct ClusterObject {
  std::shared_ptr<const ResultObject> owner_result;
  std::size_t id = 0;
};

}  // namespace pcl_bv::python
