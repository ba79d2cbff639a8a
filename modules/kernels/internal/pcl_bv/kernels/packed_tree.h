// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A bounding volume hierarchy of axis-aligned boxes over packets of points, and ball and nearest-neighbour
// queries on it. The hierarchy has no pointers, because the index of a box follows from the number of
// children per level.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Number of points in a packet, and number of boxes in a group.
inline constexpr std::size_t kTreeWidth = 16;

/// Neighbouring boxes as structure of arrays. Unused boxes of a group are empty, that is, `low` is +infinity
/// and `high` is -infinity.
struct alignas(64) BoxGroup {
  float low[3][kTreeWidth];
  float high[3][kTreeWidth];
};

/// Neighbouring points in the layout of PointOrder::groups. A packet is one group of floats or two groups of
/// doubles. Unused points of a packet are NaN.
template <typename T>
struct alignas(64) PointPacket {
  static constexpr std::size_t kLanes = kGroupBytes / sizeof(T);

  T lanes[3 * kTreeWidth];

  /// Returns the address of coordinate `axis` (0 to 2) of point k. The same coordinate of points k + 1, k +
  /// 2, ... follows in memory, for point numbers below the next multiple of kLanes.
  const T* at(std::size_t axis, std::size_t k) const {
    return lanes + (k / kLanes * 3 + axis) * kLanes + k % kLanes;
  }
  T* at(std::size_t axis, std::size_t k) { return lanes + (k / kLanes * 3 + axis) * kLanes + k % kLanes; }
};

/// Groups of boxes around a sequence of items, such as the packets of a PackedTree. The groups are stored
/// level by level. On level 0, box k of group g contains item 16 g + k. On level n > 0, box k of group g
/// contains group 16 g + k of level n - 1. The topmost level has one group.
///
/// In the frame of the boxes, all coordinates are between -1 and 1. A point p of an item has the coordinates
/// (p - origin) * scale in this frame. The boxes are rounded outward.
struct BoxLevels {
  static constexpr std::size_t kMaxLevels = 9;

  std::vector<BoxGroup> groups;
  /// For each group: the squared radius, in the frame of the boxes, of the smallest ball that contains a
  /// whole side of one of the group's boxes. Each side of a box touches a point, so the ball certainly
  /// contains a point. Empty if the items are not the packets of a PackedTree.
  std::vector<float> min_side_radius;
  std::array<std::size_t, kMaxLevels + 1> first{};  ///< Index in `groups` of the first group of each level.
  /// Number of children of each level. The children of level 0 are the items. The children of level n > 0 are
  /// the groups of level n - 1.
  std::array<std::size_t, kMaxLevels + 1> child_counts{};
  std::size_t levels = 0;  ///< 0 if there are no items.
  Coordinates origin{};
  double scale = 1;  ///< A power of two.
};

/// The valid points of a cloud in the order of the leaves of a k-d tree, in packets of 16 points, and boxes
/// around the packets.
struct PackedTree {
  BoxLevels boxes;
  std::vector<PointPacket<float>> floats;    ///< Packets of a float cloud.
  std::vector<PointPacket<double>> doubles;  ///< Packets of a double cloud.
  std::vector<std::int32_t> indices;         ///< Index of each point in its cloud, by packet and lane.
  std::size_t count = 0;                     ///< Number of points.
  ScalarType scalar = ScalarType::float32;

  /// Returns a view of the points in the order of the tree. PointView::index() of this view gives the
  /// position in `indices`, not the index in the cloud.
  PointView view() const {
    PointView points;
    points.data = scalar == ScalarType::float32 ? reinterpret_cast<const std::byte*>(floats.data())
                                                : reinterpret_cast<const std::byte*>(doubles.data());
    points.count = count;
    points.scalar = scalar;
    points.order = PointOrder::groups;
    return points;
  }
};

/// Returns whether any point has a squared distance (see Neighbor) of at most `limit` from `center`.
///
/// This function and the three functions below give the same result for every `isa`. They find no point in an
/// empty tree. `center` must be valid (is_valid()). The caller must hold a FloatEnvironment.
bool any_in_ball(UsableIsa isa, const PackedTree& tree, const Coordinates& center, double limit);

/// Appends to `found` all points whose squared distance from `center` is at most `limit`, in the order of the
/// tree.
void list_in_ball(UsableIsa isa, const PackedTree& tree, const Coordinates& center, double limit,
                  std::vector<Neighbor>& found);

/// Returns the nearest point if its squared distance is at most `limit`, else nothing. If several points are
/// equally near, the one with the smallest index is returned.
std::optional<Neighbor> find_nearest(UsableIsa isa, const PackedTree& tree, const Coordinates& center,
                                     double limit);

/// Replaces the contents of `found` by the `most` nearest points that have a squared distance of at most
/// `limit`, or by all such points if there are fewer. The points are in the order of Neighbor.
void list_nearest(UsableIsa isa, const PackedTree& tree, const Coordinates& center, std::size_t most,
                  double limit, std::vector<Neighbor>& found);

}  // namespace detail
}  // namespace pcl_bv
