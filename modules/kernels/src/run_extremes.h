// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The minimum and maximum of a run before they are converted to a RunBox.
#pragma once

#include <cstddef>
#include <limits>

#include "pcl_bv/kernels/run_boxes.h"
#include "pcl_bv/numeric/directed.h"

namespace pcl_bv::detail {

/// A RunBox in the points' own scalar type.
template <typename T>
struct RunExtremes {
  static constexpr T kMost = std::numeric_limits<T>::infinity();
  T low[3] = {kMost, kMost, kMost}, high[3] = {-kMost, -kMost, -kMost};

  // Adds 0 to turn -0 into +0. Otherwise the order of the points would decide which zero is the minimum.
  RunBox box() const {
    RunBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      if constexpr (sizeof(T) == 4) {
        box.low[k] = low[k] + T(0);
        box.high[k] = high[k] + T(0);
      } else {
        box.low[k] = float_down(low[k]) + 0.0F;
        box.high[k] = float_up(high[k]) + 0.0F;
      }
    }
    return box;
  }
};

}  // namespace pcl_bv::detail
