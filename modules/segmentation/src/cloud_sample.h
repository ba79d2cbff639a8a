// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace pcl_bv {

/// Replaces `sample` with up to `sample_size` valid points in an order that has no beat with the rows of a
/// sensor: steps of the golden section around the cloud visit each point once and cover it evenly at any
/// moment.
void draw_sample(const PointView& points, std::uint32_t seed, std::size_t sample_size,
                 std::vector<Eigen::Vector3d>& sample);

}  // namespace pcl_bv
