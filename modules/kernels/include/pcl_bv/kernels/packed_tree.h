// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes of boxes of packets of points, without pointers: what stands at which place follows from the numbers
// of what is below. And the questions to it that a vector unit answers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points in a packet, and boxes in a group.
inline constexpr std::size_t kTreeWidth = 16;

/// Boxes of neighbours, side by side. Those that a group lacks are empty: low is infinity, high -infinity.
struct alignas(64) BoxGroup {
  float low[3][kTreeWidth];
  float high[3][kTreeWidth];
};

/// Points of neighbours, side by side, as PointOrder::groups has them: one group of floats, two of doubles.
/// Those that a packet lacks are NaN.
template <typename T>
struct alignas(64) PointPacket {
  static constexpr std::size_t kLanes = kGroupBytes / sizeof(T);

  T lanes[3 * kTreeWidth];

  /// Coordinate `axis` of point k; those of the points up to a multiple of kLanes follow.
  const T* at(std::size_t axis, std::size_t k) const {
    return lanes + (k / kLanes * 3 + axis) * kLanes + k % kLanes;
  }
  T* at(std::size_t axis, std::size_t k) { return lanes + (k / kLanes * 3 + axis) * kLanes + k % kLanes; }
};

/// Groups of boxes around items in a row, level by level: box k of group g of level 0 holds item 16 g + k, of
/// level n group 16 g + k of level n - 1; the topmost level is one group. Boxes are in a frame of their own,
/// in which all coordinates are within 1 of 0: a place p of the items is at (p - origin) * scale there. They
/// are rounded outward.
struct BoxLevels {
  static constexpr std::size_t kMostLevels = 9;

  std::vector<BoxGroup> groups;
  /// By group, in this frame and squared: the radius of the smallest ball that surely holds a point of one of
  /// its boxes, at the best place for it. Of a PackedTree; else empty.
  std::vector<float> least_reached;
  std::array<std::size_t, kMostLevels + 1> first{};  ///< The number, among all groups, of each level's first.
  std::array<std::size_t, kMostLevels + 1>
      below{};             ///< How many there are below: items, groups of level 0, ...
  std::size_t levels = 0;  ///< 0: no items.
  Coordinates origin{};
  double scale = 1;  ///< A power of two.
};

/// A cloud's valid points in the order of a k-d tree's leaves, 16 to a packet, and boxes around the packets.
struct PackedTree {
  BoxLevels boxes;
  std::vector<PointPacket<float>> floats;    ///< Of a cloud of floats.
  std::vector<PointPacket<double>> doubles;  ///< Of a cloud of doubles.
  std::vector<std::int32_t> numbers;         ///< The point's number in its cloud, by packet and lane.
  std::size_t count = 0;                     ///< Points.
  ScalarType scalar = ScalarType::float32;

  /// The points in their order here; index() is the place in that order.
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

/// A point of a cloud and how far it is: (dx dx + dy dy) + dz dz in double, each step rounded, of the
/// differences to the place asked about.
struct Neighbor {
  std::int32_t index;
  double squared_distance;
};

/// The nearer one first; of equal ones that with the smaller number.
inline bool operator<(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.index < b.index);
}

/// Whether a point has a squared distance, as Neighbor says, of at most `limit`. These four give the same for
/// every `isa`. They run in the caller's floating-point environment: hold a FloatEnvironment. The centre is
/// valid.
bool any_in_ball(UsableIsa isa, const PackedTree& tree, const Coordinates& center, double limit);

/// Appends all such points, in the tree's order.
void list_in_ball(UsableIsa isa, const PackedTree& tree, const Coordinates& center, double limit,
                  std::vector<Neighbor>& found);

/// The first of all such points in Neighbor's order, if there is one.
std::optional<Neighbor> find_nearest(UsableIsa isa, const PackedTree& tree, const Coordinates& center,
                                     double limit);

/// Of all such points the `most` nearest, ascending: replaces what is in `found`.
void list_nearest(UsableIsa isa, const PackedTree& tree, const Coordinates& center, std::size_t most,
                  double limit, std::vector<Neighbor>& found);

}  // namespace pcl_bv
