// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The structure of arrays of the paper (Figure 1): points copied once into the order in which vector
// registers want them, for those who fit several volumes to one cloud.
#pragma once

#include <cstddef>
#include <vector>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An owning copy of points as groups: 64 bytes of x, 64 of y, 64 of z (16 points of float, 8 of double), and
/// again. Memory is aligned to 64 bytes; the last group is filled up with a valid point.
///
/// The bits of every coordinate are kept, NaN and infinity in their place, and so is the order: point i of
/// view() is the i-th point visited by the view that was assigned. For a whole cloud index() of view() is
/// therefore the cloud's point number; for a slice or an index list it is the position in that slice or list
/// (list[i] names the cloud's point).
///
/// Every kernel and fit takes view() and gives the bits that it gives for the assigned view. Under an index
/// list that is not ascending this holds for boxes and k-DOPs only: of equal projections the smallest index()
/// wins, which is then another point, and spheres start from these points.
class PointGroups {
 public:
  PointGroups() = default;
  explicit PointGroups(const PointView& points, UsableIsa isa = {});

  /// Replaces the contents by the points, which must not be those of this object. Allocates only if they need
  /// more than capacity(). O(n), one pass. `isa` changes no bit. Throws std::invalid_argument unless the
  /// points are in memory, std::bad_alloc, and then the object is as before or empty.
  void assign(const PointView& points, UsableIsa isa = {});

  /// All points; a moved-from object has none. Valid until the next assign(), move or the end of this object.
  PointView view() const;

  std::size_t size() const { return groups_.empty() ? 0 : size_; }  // another may have taken the groups
  bool empty() const { return groups_.empty(); }

  /// Bytes that points may take without another allocation; a point takes 3 coordinates, rounded up to
  /// groups.
  std::size_t capacity() const { return groups_.capacity() * sizeof(Group); }

 private:
  struct alignas(kGroupBytes) Group {
    Group() {}  // leaves the memory as it is: assign() writes all of it
    std::byte lanes[3 * kGroupBytes];
  };

  std::vector<Group> groups_;
  std::size_t size_ = 0;
  ScalarType scalar_ = ScalarType::float32;
};

}  // namespace pcl_bv
