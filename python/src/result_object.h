// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "arrays.h"
#include "pcl_bv/nodes/frame_result.h"

namespace pcl_bv::python {

/// What was found in a frame, and the frame's points, which its picture and its clusters are of.
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

/// One of the objects that were found. It shares what the result holds.
struct ClusterObject {
  std::shared_ptr<const ResultObject> of;
  std::size_t id = 0;
};

}  // namespace pcl_bv::python
