// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {

/// The volume grown as Region says; with padding 0 itself. Of a hull only the planes grow: the result's
/// contains() is of use, not what goes by the vertices.
AnyVolume grown(const AnyVolume& volume, double padding);

}  // namespace pcl_bv
