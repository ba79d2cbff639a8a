// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Outcome of a fit.
enum class EstimationStatus : std::uint8_t {
  ok,               ///< The points span three dimensions.
  degenerate,       ///< The points lie in a plane, on a line or in one point: rank < 3.
  no_valid_points,  ///< There is no valid point, and the volume is empty.
  failed            ///< The fit failed, and the volume is empty. This version never returns `failed`.
};

/// Status, rank and point counts of a fit.
///
/// `rank` is the number of dimensions that the points span, to within 2^-36 of the extent: 0 for one point, 1
/// for points on a line, 2 for points in a plane, otherwise 3. The rank does not depend on the fitted volume
/// or on the order of the points. Flat points are recognised in any orientation.
///
/// The exact definition is as follows. p0 is the first valid point in lexicographic order of (x, y, z). p1 is
/// the point farthest from p0, p2 the point farthest from the line p0 p1, and p3 the point farthest from the
/// plane p0 p1 p2. Of equally far points the first in lexicographic order is taken. Let d1, d2 and d3 be the
/// three distances, and e = 2^-36 units. The rank is 0 if d1 <= e, otherwise 1 if d2 <= e, otherwise 2 if
/// d3 <= e, otherwise 3. The unit is the longest side of the points' box, rounded down to a power of two, but
/// at least 2^-1000. Consequently, points within 2^-41 units of a plane have rank 2 or less, and points of
/// rank 2 are within 2^-36 units of a plane.
struct EstimationResult {
  EstimationStatus status = EstimationStatus::no_valid_points;
  int rank = 0;               ///< 0 to 3, as defined above.
  std::size_t used = 0;       ///< Number of valid points, which the volume encloses.
  std::size_t dropped = 0;    ///< Number of points that are not valid (is_valid() in coordinates.h).
  std::string_view reason{};  ///< Reason of a failure, a string with static lifetime. Empty without failure.
};

/// A fitted volume, with the status, rank and point counts of the fit.
template <typename VolumeT>
struct Fitted : EstimationResult {
  VolumeT volume{};  ///< The volume; empty without a valid point and after a failure.

  /// Whether there is a volume: there are valid points, and the fit did not fail.
  explicit operator bool() const {
    return status == EstimationStatus::ok || status == EstimationStatus::degenerate;
  }

  const VolumeT& operator*() const& { return volume; }
  VolumeT& operator*() & { return volume; }
  VolumeT&& operator*() && { return std::move(volume); }  ///< `Hull hull = *fit_hull(points)` moves.
  const VolumeT* operator->() const { return &volume; }
  VolumeT* operator->() { return &volume; }
};

/// A fitted volume with a proof of how small it is.
template <typename VolumeT, typename CertificateT>
struct Certified : Fitted<VolumeT> {
  CertificateT certificate{};  ///< The proof.
};

}  // namespace pcl_bv
