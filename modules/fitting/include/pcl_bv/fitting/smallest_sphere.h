// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The solver of the smallest sphere, for points that only answer questions: those of a file, of a tree, of
// many machines. For points in memory and sources fit_smallest_sphere() (fit.h) asks and answers.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/distances.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A point outside, or none (squared_distance < 0).
struct FarPoint {
  double squared_distance = -1;  ///< As squared_distance() of kernels/distances.h says.
  std::size_t index = 0;         ///< The cloud's number of the point.
  Coordinates point{};
};

/// The farthest point in each octant() around a centre; of equally far ones that with the smallest index.
using OctantPoints = std::array<FarPoint, 8>;

/// Lets the farthest of some of the points compete with those of others.
void keep_farthest(const FarPoint& other, FarPoint& best);
void keep_farthest(const OctantPoints& other, OctantPoints& best);

/// Of the valid points with a squared distance of at least `limit` the farthest in each octant, in `found`,
/// whatever was there. Whether there is any.
using FarthestPoints = std::function<bool(const DistanceCenter& center, double limit, OctantPoints& found)>;

/// The answer of the points of a view: `found` becomes what FarthestPoints says, and its numbers are those of
/// PointView::index(). One pass over the points. Throws std::invalid_argument for a view with an index list.
bool farthest_points(const PointView& points, const DistanceCenter& center, double limit, OctantPoints& found,
                     const Execution& execution = {});

/// The smallest sphere of the points that `supports`, along dop26 with points, and `farthest` speak of. The
/// bits of fit_smallest_sphere(), whoever answers. Empty without a valid point. Throws std::invalid_argument
/// for other supports, and what `farthest` throws. One question for each of certificate.passes.
Sphere smallest_sphere(const Supports& supports, const FarthestPoints& farthest,
                       SphereCertificate& certificate);

}  // namespace pcl_bv
