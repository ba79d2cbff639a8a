// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace [[gnu::visibility("default")]] pcl_bv {

/// The part of a ray inside a volume: origin + t direction for enter <= t <= exit, t >= 0, in units of the
/// direction. So a segment (t <= 1) meets the volume if enter <= 1.
struct RayInterval {
  double enter;  ///< 0 if the ray starts inside.
  double exit;   ///< Infinity if the direction is zero.
};

}  // namespace pcl_bv
