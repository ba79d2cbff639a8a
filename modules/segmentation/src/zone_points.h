// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "patch_fit.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/parallel/policy.h"
#include "plane_search.h"
#include "up_frame.h"
#include "zones.h"

namespace pcl_bv {

/// The cloud as seen by the zones.
struct ZoneFrame : UpFrame {
  Eigen::Vector3d sensor;

  ZoneFrame(const Eigen::Vector3d& direction, const Eigen::Vector3d& place)
      : UpFrame(direction), sensor(place) {}

  GroundPoint point(const Coordinates& p) const;
  Slope slope(const Plane& plane) const;
  Plane level(double height) const;
};

/// Points, a coordinate in a row.
struct ZoneColumns {
  std::vector<float> u, v, height;
  std::vector<std::int32_t> number;  ///< In the cloud.

  void resize(std::size_t count);
  void copy(const ZoneColumns& from, std::size_t begin, std::size_t count, std::size_t to);
};

/// Points in a row, all in one patch: a beam mostly stays in the patch of the point before.
struct ZoneRun {
  std::uint16_t patch;
  std::uint32_t begin;
};

/// Points of a view that one thread takes.
struct ZonePart {
  std::size_t begin, end;                       ///< In the view.
  std::size_t kept;                             ///< Valid ones, which lie from `begin` on.
  std::vector<ZoneRun> runs;                    ///< And one more at the end.
  std::array<std::uint32_t, patch_count> next;  ///< By patch, where the next one goes.
  std::vector<std::uint8_t> upright;            ///< By cell, whether something of it stands there.

  /// work(patch, begin, count) for each run.
  template <typename Work>
  void for_each_run(const Work& work) const {
    for (std::size_t r = 0; r + 1 < runs.size(); ++r)
      work(runs[r].patch, runs[r].begin, runs[r + 1].begin - runs[r].begin);
  }
};

/// The valid points of a view, in its order and patch by patch. The parts change no order.
struct ZonePoints {
  Parts<ZonePart> parts;
  ZoneColumns points;               ///< Part by part, as are cells.
  std::vector<std::uint16_t> cell;  ///< ZonePlace::cell.

  ZoneColumns sorted;                                ///< Patch by patch, in each in the order of the view.
  std::array<std::uint32_t, patch_count + 1> begin;  ///< Of each patch, there.

  /// Replaces all. O(n).
  void read(const PointView& view, const ZoneFrame& frame, const ParallelPolicy& policy);

  Patch patch(std::size_t i) const {
    const std::uint32_t from = begin[i];
    return {sorted.u.data() + from, sorted.v.data() + from, sorted.height.data() + from,
            begin[i + 1] - from,    patch_centers[i].u,     patch_centers[i].v};
  }

 private:
  void place_points(const PointView& view, const ZoneFrame& frame, ZonePart& part);
  void sort(ZonePart& part);
};

}  // namespace pcl_bv
