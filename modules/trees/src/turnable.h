// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {

/// The volume, or one around it by some 1e-14 of the coordinates, of a kind whose transformed() is that body
/// turned: those of an Aabb and a Kdop are boxes and slabs along the old axes. 20 us for a 26-DOP. A Kdop
/// whose slabs have no common point becomes empty.
AnyVolume turnable(const AnyVolume& volume);

}  // namespace pcl_bv
