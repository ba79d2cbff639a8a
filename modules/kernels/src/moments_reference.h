// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar reference of moments.cpp: what its vectors must agree with.
#pragma once

#include "pcl_bv/kernels/moments.h"

namespace pcl_bv {

void chunk_moments_reference(const PointView& chunk, const Coordinates& origin, Moments& out);

}  // namespace pcl_bv
