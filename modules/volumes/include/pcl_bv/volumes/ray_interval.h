// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace [[gnu::visibility("default")]] pcl_bv {

/// The part of a ray inside a volume: origin + t direction for enter <= t <= exit, t >= 0, in units of the
/// direction. So a segment (t <= 1) meets the volume if enter <= 1.
///
/// Every volume's intersect() gives it, or nothing where the ray misses, for an empty volume and for numbers
/// that are not finite. It encloses the exact interval: a ray that hits by exact arithmetic, be it in one
/// point or along a face, is never a miss. How far the ends may be off each volume says. A zero direction
/// tests the origin.
struct RayInterval {
  double enter;  ///< 0 if the ray starts inside.
  double exit;   ///< Infinity if the direction is zero.
};

}  // namespace pcl_bv
