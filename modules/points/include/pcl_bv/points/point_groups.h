// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A copy of points as structure of arrays (Karlsson, Winberg and Larsson 2010, Figure 1). The coordinates are
// in the order in which vector registers load them. The copy is useful if several volumes are fitted to one
// cloud.
#pragma once

#include <cstddef>
#include <vector>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An owning copy of points in groups. A group has 64 bytes of x, 64 bytes of y and 64 bytes of z (16 float
/// points or 8 double points). The memory is aligned to 64 bytes. The last group is padded with a valid
/// point, if there is one.
///
/// Coordinates keep their bits, NaN and infinity included, and points keep their order. Point i of view() is
/// the i-th point visited by the assigned view. So PointView::index() of view() is the index in the cloud if
/// a whole cloud was assigned. If a slice or a view with an index list was assigned, PointView::index() is
/// the position in the slice or in the list.
///
/// Every kernel and fit accepts view() and returns the same bits as for the assigned view. For an index list
/// that is not ascending, only boxes and k-DOPs have the same bits. Other results may differ: if points have
/// equal projections, the support point is the point with the smallest PointView::index(), which in the copy
/// may be another point. Spheres, for example, are computed from support points.
class PointGroups {
 public:
  PointGroups() = default;
  /// Copies the points; see assign().
  explicit PointGroups(const PointView& points, UsableIsa isa = {});

  /// Replaces the contents by a copy of the points. `points` must not be a view of this object. Allocates
  /// memory only if the points need more than capacity(). O(n), one pass. `isa` changes no bit. Throws
  /// std::invalid_argument if the points are not in memory, and std::bad_alloc if an allocation fails. After
  /// an exception, the object is unchanged or empty.
  void assign(const PointView& points, UsableIsa isa = {});

  /// Returns a view of all points, or an empty view after a move. The view is valid until the next assign(),
  /// a move or destruction.
  PointView view() const;

  std::size_t size() const { return groups_.empty() ? 0 : size_; }  // groups_ is empty after a move
  bool empty() const { return groups_.empty(); }

  /// Number of bytes that points may take without another allocation. A point takes 3 coordinates; the total
  /// is rounded up to whole groups.
  std::size_t capacity() const { return groups_.capacity() * sizeof(Group); }

 private:
  struct alignas(kGroupBytes) Group {
    Group() {}  // leaves the memory uninitialised, because assign() writes all of it
    std::byte lanes[3 * kGroupBytes];
  };

  std::vector<Group> groups_;
  std::size_t size_ = 0;
  ScalarType scalar_ = ScalarType::float32;
};

}  // namespace pcl_bv
