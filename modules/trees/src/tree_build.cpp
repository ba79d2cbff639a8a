// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree_build.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "box_levels.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/parallel/parts.h"

namespace pcl_bv::detail {
namespace {

constexpr PositionBounds kEmptyBounds = {{kInfinity, kInfinity, kInfinity},
                                         {-kInfinity, -kInfinity, -kInfinity}};

template <typename T>
std::vector<PointPacket<T>>& packets_of(PackedTree& tree) {
  if constexpr (sizeof(T) == 4) {
    return tree.floats;
  } else {
    return tree.doubles;
  }
}

void merge_into(PositionBounds& bounds, const PositionBounds& other) {
  bounds.low = {std::min(bounds.low.x, other.low.x), std::min(bounds.low.y, other.low.y),
                std::min(bounds.low.z, other.low.z)};
  bounds.high = {std::max(bounds.high.x, other.high.x), std::max(bounds.high.y, other.high.y),
                 std::max(bounds.high.z, other.high.z)};
}

template <typename T>
void load_part(const PointView& points, LoadPart& part, PositionedItem<T>* to) {
  std::size_t position = part.begin;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    PositionedItem<T>& item = to[position];
    load_point(points, i, item.position);
    item.index = static_cast<std::int32_t>(points.index(i));
    if (is_valid({item.position[0], item.position[1], item.position[2]})) ++position;
  }
  part.valid = position - part.begin;
}

// Loads the valid points and returns their number.
template <typename T>
std::size_t load(const PointView& points, const ParallelPolicy& policy, PointParts<LoadPart>& parts,
                 PositionedItem<T>* to) {
  parts.cut(points.count, policy);
  parts.for_each(policy, [&](LoadPart& part) { load_part(points, part, to); });
  std::size_t count = 0;
  for (const LoadPart& part : parts) {
    if (count != part.begin) std::copy_n(to + part.begin, part.valid, to + count);
    count += part.valid;
  }
  return count;
}

template <typename T>
PositionBounds bounds_of(const PointPacket<T>& packet) {
  Extremes<T> extremes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < kTreeWidth; ++k)
      extremes.add(axis, *packet.at(axis, k));
  }
  return extremes.bounds();
}

// Calls fill(p, packets[p]) for all packets, and then sets the boxes around their points.
template <typename T, typename Fill>
void fill_packets(PackedTree& tree, const ParallelPolicy& policy, PointParts<PacketPart>& parts,
                  const Fill& fill) {
  std::vector<PointPacket<T>>& packets = packets_of<T>(tree);
  parts.cut(packets.size(), policy);
  parts.for_each(policy, [&](PacketPart& part) {
    part.bounds = kEmptyBounds;
    for (std::size_t p = part.begin; p < part.end; ++p) {
      fill(p, packets[p]);
      merge_into(part.bounds, bounds_of(packets[p]));
    }
  });
  PositionBounds all = kEmptyBounds;
  for (const PacketPart& part : parts)
    merge_into(all, part.bounds);
  reset_levels(tree.boxes, packets.size(), all);
  parts.for_each(policy, [&](const PacketPart& part) {
    for (std::size_t p = part.begin; p < part.end; ++p) {
      const PositionBounds box = bounds_of(packets[p]);
      if (box.low.x <= box.high.x) set_item_box(tree.boxes, p, box.low, box.high);
    }
  });
  raise_levels(tree.boxes);
  find_min_side_radii(tree.boxes);
}

template <typename T>
void build(const PointView& points, const ParallelPolicy& policy, TreeScratch& scratch,
           SpatialOrder<T>& order, PackedTree& tree) {
  tree.count = load(points, policy, scratch.loads, order.reset(points.count));
  order.sort(tree.count, policy);
  const std::size_t packets = (tree.count + kTreeWidth - 1) / kTreeWidth;
  packets_of<T>(tree).resize(packets);
  tree.indices.resize(packets * kTreeWidth);
  fill_packets<T>(tree, policy, scratch.packets, [&](std::size_t p, PointPacket<T>& packet) {
    const std::size_t first = p * kTreeWidth, count = std::min(kTreeWidth, tree.count - first);
    for (std::size_t k = 0; k < count; ++k) {
      const PositionedItem<T>& item = order[first + k];
      for (std::size_t axis = 0; axis < 3; ++axis)
        *packet.at(axis, k) = item.position[axis];
      tree.indices[first + k] = static_cast<std::int32_t>(item.index);
    }
    for (std::size_t k = count; k < kTreeWidth; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        *packet.at(axis, k) = std::numeric_limits<T>::quiet_NaN();
      tree.indices[first + k] = -1;
    }
  });
}

template <typename T>
void refit(const PointView& cloud, const ParallelPolicy& policy, TreeScratch& scratch, PackedTree& tree) {
  fill_packets<T>(tree, policy, scratch.packets, [&](std::size_t p, PointPacket<T>& packet) {
    for (std::size_t k = 0; k < kTreeWidth && p * kTreeWidth + k < tree.count; ++k) {
      T xyz[3];
      load_point(cloud, static_cast<std::size_t>(tree.indices[p * kTreeWidth + k]) - cloud.first, xyz);
      const bool valid = is_valid({xyz[0], xyz[1], xyz[2]});
      for (std::size_t axis = 0; axis < 3; ++axis)
        *packet.at(axis, k) = valid ? xyz[axis] : std::numeric_limits<T>::quiet_NaN();
    }
  });
}

}  // namespace

void build_tree(const PointView& points, const ParallelPolicy& policy, TreeScratch& scratch,
                PackedTree& tree) {
  tree.scalar = points.scalar;
  if (points.scalar == ScalarType::float32) {
    tree.doubles.clear();
    build(points, policy, scratch, scratch.floats, tree);
  } else {
    tree.floats.clear();
    build(points, policy, scratch, scratch.doubles, tree);
  }
}

void refit_tree(const PointView& cloud, const ParallelPolicy& policy, TreeScratch& scratch,
                PackedTree& tree) {
  if (tree.scalar == ScalarType::float32) {
    refit<float>(cloud, policy, scratch, tree);
  } else {
    refit<double>(cloud, policy, scratch, tree);
  }
}

}  // namespace pcl_bv::detail
