// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A sample of the points of a cloud.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Replaces `sample` by at most `sample_size` valid points. Visits the points cyclically. The step is about
/// 0.618 times the size of the cloud, so the visited points are evenly spread at any time (golden section).
/// The step has no common divisor with the size, so no point is visited twice. Unlike every n-th point, the
/// visited points have no common period with the rows of a sensor.
void draw_sample(const PointView& points, std::uint32_t seed, std::size_t sample_size,
                 std::vector<Eigen::Vector3d>& sample);

}  // namespace pcl_bv::detail
