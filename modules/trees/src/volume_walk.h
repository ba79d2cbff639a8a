// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the points of a tree that are inside a volume. All points of a box inside the volume are found
// without a test. If a box crosses the surface, its points are tested one by one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "box_relation.h"
#include "convex_region.h"
#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/kernels/region_states.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// A non-empty volume, prepared for tests against the boxes and packets of a tree.
class VolumeProbe {
 public:
  explicit VolumeProbe(const AnyVolume& volume)
      : volume_(volume), region_(convex_region(volume)), tests_({region_}) {}

  Relation relation_to(const BoxLevels& boxes, const BoxGroup& group, std::size_t k) const {
    return relation(region_, plain_box(boxes, group, k));
  }

  /// Returns a bit mask of the points of a packet for which contains() holds. Lanes without a point are NaN,
  /// so their bits are 0.
  std::uint32_t inside(UsableIsa isa, const PackedTree& tree, std::size_t packet) const {
    const PointView points = tree.view().slice(packet * kTreeWidth, kTreeWidth);
    std::array<std::uint8_t, kTreeWidth> states;
    region_states(isa, points, tests_, states.data());
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      bool in = states[k] == static_cast<std::uint8_t>(RegionState::inside);
      if (states[k] == static_cast<std::uint8_t>(RegionState::unclear)) {
        const Coordinates p = load_point(points, k);
        in = contains(volume_, {p.x, p.y, p.z});
      }
      bits |= static_cast<std::uint32_t>(in) << k;
    }
    return bits;
  }

 private:
  const AnyVolume& volume_;
  ConvexRegion region_;
  RegionTests tests_;
};

/// Calls found(packet, bits) for each packet with points inside the volume, in the order of the packets.
/// Stops and returns true when found() returns true.
template <typename Found>
class VolumeWalk {
 public:
  VolumeWalk(UsableIsa isa, const PackedTree& tree, const VolumeProbe& volume, const Found& found)
      : isa_(isa), tree_(tree), volume_(volume), found_(found) {}

  bool run() const { return tree_.count != 0 && visit(tree_.boxes.levels - 1, 0); }

 private:
  bool visit(std::size_t level, std::size_t number) const {
    const BoxLevels& boxes = tree_.boxes;
    const BoxGroup& group = boxes.groups[boxes.first[level] + number];
    const std::size_t first = number * kTreeWidth,
                      end = std::min(first + kTreeWidth, boxes.child_counts[level]);
    for (std::size_t item = first; item < end; ++item) {
      switch (volume_.relation_to(boxes, group, item - first)) {
        case Relation::outside:
          break;
        case Relation::inside:
          if (report_all(level, item)) return true;
          break;
        case Relation::crossing:
          if (level == 0 ? report(item, volume_.inside(isa_, tree_, item)) : visit(level - 1, item))
            return true;
      }
    }
    return false;
  }

  bool report(std::size_t packet, std::uint32_t bits) const { return bits != 0 && found_(packet, bits); }

  bool report_all(std::size_t level, std::size_t item) const {
    const std::size_t packets = std::size_t{1} << 4 * level;
    const std::size_t end = std::min((item + 1) * packets, tree_.boxes.child_counts[0]);
    for (std::size_t packet = item * packets; packet < end; ++packet) {
      if (report(packet, valid_points(packet))) return true;
    }
    return false;
  }

  // Returns a bit mask of the lanes of a packet that are not NaN.
  std::uint32_t valid_points(std::size_t packet) const {
    const auto bits_of = [](const auto& points) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < kTreeWidth; ++k)
        bits |= static_cast<std::uint32_t>(*points.at(0, k) == *points.at(0, k)) << k;
      return bits;
    };
    return tree_.scalar == ScalarType::float32 ? bits_of(tree_.floats[packet])
                                               : bits_of(tree_.doubles[packet]);
  }

  UsableIsa isa_;
  const PackedTree& tree_;
  const VolumeProbe& volume_;
  const Found& found_;
};

/// Runs a VolumeWalk for a volume that may be empty. An empty volume has no points, so the result is false.
template <typename Found>
bool walk_inside(UsableIsa isa, const PackedTree& tree, const AnyVolume& volume, const Found& found) {
  if (empty(volume)) return false;
  const VolumeProbe probe(volume);
  return VolumeWalk<Found>(isa, tree, probe, found).run();
}

}  // namespace pcl_bv::detail
