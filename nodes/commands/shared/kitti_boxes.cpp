// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "kitti_boxes.h"

#include <algorithm>

#include "values.h"

namespace pcl_bv::detail {

void check_kitti_boxes(const std::string& option, const PipelineConfig& config) {
  const Eigen::Vector3d& up = config.ground.up;
  if (up.x() != 0 || up.y() != 0 || up.z() < 0)
    throw UsageError(option + ": boxes rotate only about z, so --up must be z");
  const std::vector<const Method*> methods = config.methods();
  const bool any = std::any_of(methods.begin(), methods.end(), [](const Method* m) {
    return m->shape == "aabb" || (m->shape == "obb" && m->upright);
  });
  if (!any) throw UsageError(option + ": needs boxes: --volume obb-yaw, obb-lshape or aabb");
}

}  // namespace pcl_bv::detail
