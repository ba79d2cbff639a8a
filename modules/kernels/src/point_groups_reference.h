// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar reference of point_groups.cpp: what its vectors must agree with.
#pragma once

#include <cstddef>

#include "pcl_bv/kernels/point_view.h"

namespace pcl_bv {

/// Writes the points as groups; the `pad`-th one (if there is any) fills the last group.
void fill_groups_reference(const PointView& points, std::size_t pad, std::byte* groups);

}  // namespace pcl_bv
