// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Inflates volumes by a padding.
#pragma once

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// Returns the volume inflated as Region documents. Padding 0 returns the volume unchanged. For a Hull only
/// the planes move, so use contains() of the result, not member functions that use the vertices.
AnyVolume inflated(const AnyVolume& volume, double padding);

}  // namespace pcl_bv::detail
