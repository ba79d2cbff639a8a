// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {

/// Whether two volumes overlap, as VolumeTree asks it: overlaps() of two of a kind that have it, else whether
/// their boxes do.
bool volumes_overlap(const AnyVolume& a, const AnyVolume& b);

}  // namespace pcl_bv
