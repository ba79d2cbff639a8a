// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes around a cloud that is divided into parts, on many machines or in many files.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
struct PartialAccess;
struct PartialState;
}  // namespace detail

/// The contribution of some points of a cloud to volumes around the whole cloud. A Partial with at most
/// kMaxStored points stores all its points. Of more points, a Partial stores the support points along 26
/// directions, sums for the covariance, and the extreme points, which are the vertices of the convex hull.
/// The points with the numbers 1024 k to 1024 k + 1023 are a block. If a Partial has only some of the points
/// of a block, it also stores these points. Copies share their data.
///
/// How the cloud was cut into parts, and in which order they were merged, changes no bit of the volumes or of
/// the serialised bytes. The volumes have the same bits as a fit to the whole cloud. There are two
/// exceptions: for more than kMaxStored points, sphere-exact and obb-yaw are fitted to the extreme points
/// only. Without rounding, the extreme points determine these two volumes. With rounding, points very near
/// to an extreme point can change the last bits of a fit to all points.
class Partial {
 public:
  /// Maximum number of points that are all stored.
  static constexpr std::size_t kMaxStored = 4096;

  /// Holds no points.
  Partial();

  /// Holds the points of a view. The i-th point of the view has the number `first` + PointView::first + i in
  /// the whole cloud. The view may have no valid points. Takes the time of fit_hull() and summarize()
  /// together, and no more memory than these. Throws std::invalid_argument for a view with an index list.
  /// Other errors are as for fit_hull().
  explicit Partial(const PointView& points, std::size_t first = 0, const Execution& execution = {});

  /// Adds the points of `other`. Associative and commutative. O(m log m) for m extreme points. Throws
  /// std::invalid_argument, and changes nothing, if the same point is in both Partials, or if one Partial has
  /// float and the other double coordinates.
  void merge(const Partial& other);

  /// Returns whether the method can be fitted to parts. This is true for all methods except obb-lshape, the
  /// spheres other than sphere-exact, and a prism with a concave outline. Those volumes can depend on points
  /// deep inside the cloud.
  static bool can_fit(const Method& method, const MethodOptions& options = {});

  /// Fits the volume around all points. Status, rank and counts are those of all points. O(m log m) for m
  /// extreme points. Throws std::invalid_argument unless can_fit(method, options).
  Fitted<AnyVolume> fit(const Method& method, const MethodOptions& options = {},
                        const Execution& execution = {}) const;

  /// Number of points, valid or not.
  std::size_t size() const;

  /// Returns the state as bytes for a file or a message, with a version and a checksum. The size is about
  /// 2 kB, plus 32 bytes for each stored point. The bytes are the same on every machine.
  std::vector<std::byte> to_bytes() const;

  /// Restores a Partial from the bytes of to_bytes(). Throws std::invalid_argument, with the reason, for any
  /// other bytes.
  static Partial from_bytes(const std::byte* bytes, std::size_t size);

 private:
  friend struct detail::PartialAccess;
  std::shared_ptr<const detail::PartialState> state_;
};

}  // namespace pcl_bv
