// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud in parts, on many machines or in many files: what of each part is needed for volumes around all.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/smallest_sphere.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct PartialState;

/// What some of a cloud's points contribute to volumes around all of them: of up to kAllKept points all, of
/// more the extreme ones (the vertices of their hull), those that reach farthest along the 26 directions, and
/// sums for the covariance. Copies share what they hold.
///
/// Which parts a cloud was cut into, and in what order they were merged, changes no bit, neither of volumes
/// nor of bytes. The volumes are those of a fit of the whole cloud, bit by bit, but for two methods on more
/// than kAllKept points: sphere-exact and obb-yaw are fits of the extreme points, which are also theirs, but
/// points within rounding of them may have turned the last bits of a fit of all.
class Partial {
 public:
  /// Points up to which all are kept.
  static constexpr std::size_t kAllKept = 4096;

  /// Of no points.
  Partial();

  /// Of points that the whole cloud numbers from `first` + PointView::first on. Time as for fit_hull() and
  /// summarize() together; no memory beyond theirs is kept. No point, or none that is valid, is fine. Throws
  /// std::invalid_argument for a view with an index list, and as fit_hull().
  explicit Partial(const PointView& points, std::size_t first = 0, const Execution& execution = {});

  /// Of the points of both: associative and commutative. O(m log m) for m extreme points. Throws
  /// std::invalid_argument, and changes nothing, if a point is in both or if one has floats and the other
  /// doubles.
  void merge(const Partial& other);

  /// Whether the method can be fitted to parts: not spheres that grow and obb-lshape, which depend on all
  /// points, also those deep inside.
  static bool serves(const Method& method);

  /// The volume around all points, and their status, rank and counts. Throws std::invalid_argument unless
  /// serves(method), and for Execution::supports. O(m log m).
  EstimationResult fit(const Method& method, AnyVolume& volume, const Execution& execution = {},
                       const MethodOptions& options = {}) const;

  /// The smallest sphere of all points, which answer questions where they are: the bits of
  /// fit_smallest_sphere() of the whole cloud, whatever the number of points, if `farthest` speaks of these
  /// points by the numbers that they have here. Asks nothing where all points are kept. Throws what it
  /// throws.
  EstimationResult fit_smallest_sphere(Sphere& sphere, SphereCertificate& certificate,
                                       const FarthestPoints& farthest, const Execution& execution = {}) const;

  /// Points, valid or not.
  std::size_t size() const;

  /// For a file or a message: some 2 kB and 32 bytes for each extreme or kept point, with a version and a
  /// check sum; the same on every machine.
  std::vector<std::byte> to_bytes() const;

  /// Throws std::invalid_argument, saying what is wrong, for anything but what to_bytes() gave.
  static Partial from_bytes(const std::byte* bytes, std::size_t size);

 private:
  std::shared_ptr<const PartialState> state_;
};

}  // namespace pcl_bv
