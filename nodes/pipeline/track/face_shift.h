// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>

namespace pcl_bv::detail {

/// Returns the smaller displacement of two opposite faces of a box, `low` and `high`; 0 if the faces move
/// apart or towards each other. If a part of the object comes into or goes out of view, only one face moves,
/// so the shift is 0.
inline double face_shift(double low, double high) {
  if (low > 0 && high > 0) return std::min(low, high);
  if (low < 0 && high < 0) return std::max(low, high);
  return 0;
}

/// Extends the interval from `low` to `high` to the faces that are seen, or shrinks it towards them by 3 %: a
/// part that is not seen any more is usually hidden.
inline void follow_faces(double& low, double& high, double seen_low, double seen_high) {
  constexpr double kShrink = 0.03;
  low += (seen_low < low ? 1 : kShrink) * (seen_low - low);
  high += (seen_high > high ? 1 : kShrink) * (seen_high - high);
}

}  // namespace pcl_bv::detail
