// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Computes the smallest sphere of points that are not in memory but can be queried, for example points in a
// file, in a tree or on many machines. For points in memory or in a PointSource use fit_smallest_sphere()
// (fit.h).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/distances.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

class DistanceScan;

/// A point outside a sphere. If squared_distance < 0, there is no such point.
struct FarPoint {
  double squared_distance = -1;  ///< From the centre, as squared_distance() (kernels/distances.h) returns it.
  std::size_t index = 0;         ///< Index of the point in the cloud.
  Coordinates point{};           ///< Coordinates of the point.
};

/// The farthest point in each octant() around a centre. Of equally far points the one with the smallest index
/// is taken.
using OctantPoints = std::array<FarPoint, 8>;

/// Replaces `best` by `other` if `other` is farther, or equally far with a smaller index. The overload for
/// OctantPoints does this in each octant.
void update_farthest(const FarPoint& other, FarPoint& best);
void update_farthest(const OctantPoints& other, OctantPoints& best);

/// Returns n: about one of n blocks of a cloud is in its sample. n is a power of two, or 1 for clouds that
/// are too small for a sample. `points` is the number of valid points of the whole cloud.
std::size_t blocks_per_sampled(std::size_t points);

/// Returns whether block number `block` is in the sample: the kBlockPoints indices from kBlockPoints * block
/// on. `one_of` is the result of blocks_per_sampled(). If it is 1, the sample has all points.
bool in_sample(std::size_t block, std::size_t one_of);

/// A query for the farthest points of a sample.
struct FarQuery {
  DistanceCenter center;
  double limit = 0;        ///< Points with a smaller squared distance are ignored.
  std::size_t one_of = 1;  ///< As in in_sample().
};

/// A query that overwrites `found` with the farthest point in each octant, among the valid points of the
/// sample with a squared distance of at least FarQuery::limit. Returns whether there is any such point.
using FarthestQuery = std::function<bool(const FarQuery& query, OctantPoints& found)>;

/// Answers queries for the points of a view. The indices are those of PointView::index(). Keeps the points of
/// the sample and those near the surface. So usually one query takes a pass over the sample, and one takes a
/// pass over all points. The points must outlive the finder and must not change. One thread at a time may use
/// it.
class FarthestFinder {
 public:
  /// Copies the view and the execution, not the points. Throws std::invalid_argument for a view with an index
  /// list.
  explicit FarthestFinder(const PointView& points, const Execution& execution = {});
  ~FarthestFinder();
  FarthestFinder(FarthestFinder&&) noexcept;

  /// Answers as FarthestQuery does. Exceptions of the points' source are passed on.
  bool operator()(const FarQuery& query, OctantPoints& found);

 private:
  std::unique_ptr<DistanceScan> scan_;
};

/// Computes the smallest sphere of a cloud from the cloud's supports and a query for its points. Throws
/// std::invalid_argument unless `supports` has the set dop26 and SupportDetail::points. The result has the
/// same bits as that of fit_smallest_sphere(). Without a valid point the sphere is empty. Calls `farthest`
/// certificate.passes times. Exceptions of `farthest` are passed on.
Sphere smallest_sphere(const Supports& supports, const FarthestQuery& farthest,
                       SphereCertificate& certificate);

/// Fits the smallest sphere of all points of a Partial. If the Partial does not store all points, calls
/// `farthest`, which must answer for all points of the Partial, with their numbers in the whole cloud as
/// indices. For any number of points, the result has the same bits as pcl_bv::fit_smallest_sphere() for the
/// whole cloud. Exceptions of `farthest` are passed on.
Certified<Sphere, SphereCertificate> fit_smallest_sphere(const Partial& partial,
                                                         const FarthestQuery& farthest,
                                                         const Execution& execution = {});

}  // namespace detail
}  // namespace pcl_bv
