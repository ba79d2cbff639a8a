// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Outlines around points that are known only up to rounding errors, and prisms over them.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "pcl_bv/volumes/prism.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A rectangle along the coordinate axes of the plane. It contains a point that is no pair of doubles.
struct PlaneBox {
  Eigen::Vector2d low, high;
};

/// Returns the corners of a convex polygon that contains all boxes, as Prism::outline() requires. If every
/// box is a point, the polygon is the exact convex hull. Otherwise the polygon exceeds the convex hull of the
/// boxes by a few times the size of the largest box: a corner that is not sharp moves outward so far that it
/// covers its box, and only the boxes of sharp corners become corners themselves. O(n log n).
std::vector<Eigen::Vector2d> outline_around(const std::vector<PlaneBox>& boxes);

/// Makes a prism without the tests of its constructor. The arguments must pass these tests and have no -0.
struct PrismAccess {
  static Prism make(const Eigen::Matrix3d& axes, std::vector<Eigen::Vector2d> outline, double low,
                    double high, bool is_convex = true) {
    Prism prism;
    prism.axes_ = axes;
    prism.outline_ = std::move(outline);
    prism.low_ = low;
    prism.high_ = high;
    prism.is_convex_ = is_convex;
    return prism;
  }
};

/// Returns the prism over the convex hull of the outline.
Prism convex_prism(const Prism& prism);

/// Returns the prism inflated by `padding`, which must not be negative. The result contains every point
/// within `padding` of the prism. It has a convex outline unless the padding is 0. The heights move by the
/// padding. The outline grows by a regular polygon of 16 sides around a circle of this radius, so that a side
/// moves by at most 1.02 times the padding.
Prism inflated_prism(const Prism& prism, double padding);

}  // namespace detail
}  // namespace pcl_bv
