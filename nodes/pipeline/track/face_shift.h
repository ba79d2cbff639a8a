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

}  // namespace pcl_bv::detail
