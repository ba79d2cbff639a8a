// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts volumes to types that keep their shape when they are rotated.
#pragma once

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// Returns the volume as a type whose transformed() rotates the shape itself. This is an Obb for an Aabb and
/// a Hull for a Kdop, because transformed() of Aabb and Kdop would bound the rotated shape along the old
/// axes. Other types are returned unchanged. The Hull is larger than the Kdop by about 1e-14 of the
/// coordinates. Takes 20 us for a 26-DOP. A Kdop whose slabs have no common point becomes an empty Hull.
AnyVolume rotatable(const AnyVolume& volume);

}  // namespace pcl_bv::detail
