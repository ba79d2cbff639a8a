// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "pcl_bv/kernels/packed_tree.h"

namespace pcl_bv {

/// A place between low and high in the frame of the boxes, and which squared distances there are to count.
///
/// A box's distance is computed from the near end of [low, high], so before rounding it is none too great;
/// three differences, three squares and two sums make it greater by a factor of 1 + 6 2^-24 at most, and by 3
/// 2^-149 where squares underflow. 1 + 2^-19 covers that and the rounding of the limit. Places beyond 2^100
/// are taken to be there: then all squares are infinite, and that is right for every limit which a float can
/// hold.
struct BoxProbe {
  float low[3], high[3];
  float outer;  ///< No point of a box whose nearest place is farther has a squared distance within the limit.
  float inner;  ///< A point that is as near in this frame surely has one. Negative: never.
  double unit;  ///< Squared distances there of squared distances here.

  // Inlined, and not in a loop: so all stays in registers, which is 2 ns of a question's 40.
  [[gnu::always_inline]] BoxProbe(const BoxLevels& boxes, const Coordinates& center, double limit)
      : unit(boxes.scale * boxes.scale) {
    set(0, (center.x - boxes.origin.x) * boxes.scale);
    set(1, (center.y - boxes.origin.y) * boxes.scale);
    set(2, (center.z - boxes.origin.z) * boxes.scale);
    narrow(limit);
    constexpr double most = std::numeric_limits<float>::max();
    inner = static_cast<float>(std::min(limit * unit * (1 - 0x1p-19) - 0x1p-120, most));
  }

  void narrow(double limit) { outer = static_cast<float>(limit * unit * (1 + 0x1p-19) + 0x1p-140); }

 private:
  [[gnu::always_inline]] void set(std::size_t axis, double place) {
    const float near = static_cast<float>(std::max(std::min(place, 0x1p100), -0x1p100));
    const float doubt = std::abs(near) * 0x1p-22F + std::numeric_limits<float>::min();
    low[axis] = near - doubt;
    high[axis] = near + doubt;
  }
};

}  // namespace pcl_bv
