// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "box/box_frame.h"
#include "box/silhouette.h"

namespace pcl_bv {

/// The box of least volume around a hull, to 1e-10 of it (of a hull thinner than 1e-4 of its size, to 1e-14
/// of size over thickness). `known` is some box; the nearer its volume is to the least, the sooner pairs of
/// edges are discarded. O'Rourke 1985.
BoxFrame smallest_box(const BoxFrame& known, const Silhouette& shape);

}  // namespace pcl_bv
