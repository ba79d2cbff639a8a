// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest box around a convex hull.
#pragma once

#include "box/box_frame.h"
#include "box/silhouette.h"

namespace pcl_bv::detail {

/// Returns the box of minimum volume around a hull, to a relative tolerance of 1e-10. If the hull is thinner
/// than 1e-4 of its size, the tolerance is 1e-14 times size / thickness. `known` is any box around the hull.
/// The smaller `known` is, the faster the search discards pairs of edges. O'Rourke 1985.
BoxFrame smallest_box(const BoxFrame& known, const Silhouette& shape);

}  // namespace pcl_bv::detail
