// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points to volumes. Everything here keeps the promises of docs/numerics.md: each finite point is inside by
// exact real arithmetic; the same bits on every instruction set and thread count.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv {

/// How a bounding sphere is found.
enum class SphereMethod {
  epos26  ///< Larsson 2008: the smallest ball of the 26 extremal points, grown over the points left outside.
};

/// The axis-aligned box of the points: their exact minimum and maximum. Paper §2.
///
/// Empty input or no finite point: an empty box and `no_valid_points`. One point: a box of that point. O(n),
/// one pass. Throws std::invalid_argument only for an unusable instruction set.
EstimationResult fit_aabb(const PointView& points, Aabb& box, const Execution& execution = {});

/// The k-DOP of the points along the directions of `set` (not null): each slab is the true extreme, rounded
/// outward to the next double where it is none itself. Paper §2, Figure 2. Same rules as fit_aabb(),
/// and std::invalid_argument for a null set. The rank is that of the points, even where a projection that is
/// no double leaves a flat slab one step wide. O(n) for each direction; your own take about twice the time of
/// the built-in ones.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          const Execution& execution = {});

/// The extremal points of a k-DOP: per slab the index, in the cloud, of the point that touches it at its min
/// and at its max side; of several the smallest. Paper §3.
struct SlabPoints {
  std::vector<std::size_t> min;
  std::vector<std::size_t> max;
};

/// The same, and which points touch the slabs; `touching` is empty if there is no valid point.
EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          SlabPoints& touching, const Execution& execution = {});

/// A sphere around the points, centre and radius in the points' unit. Paper §3. Same rules as fit_aabb(); one
/// point or equal points: radius 0.
EstimationResult fit_sphere(const PointView& points, SphereMethod method, Sphere& sphere,
                            const Execution& execution = {});

}  // namespace pcl_bv
