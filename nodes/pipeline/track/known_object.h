// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is known of a tracked object before the next frame is segmented.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "face_shift.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pipeline/refine/geometry.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A tracked object, predicted to the time of a frame.
struct KnownObject {
  std::size_t slot = 0;  ///< Tracker::Assignment::slot
  /// Axis-aligned box, in the fixed frame, of all parts of the object that have been seen. It grows at once
  /// and shrinks slowly, because a part that is not seen is usually hidden.
  Eigen::AlignedBox3d box;
  std::size_t detections = 0, missed = 0;  ///< `missed`: frames since the last detection.
  std::size_t whole = 0;                   ///< Detections as a cluster that was neither cut nor joined.
  std::size_t cut = 0;                     ///< Detections as a part of a cluster since the last other one.
  bool has_id = false;

  /// Whether the object has the shape of a person: 0.9 m to 2.3 m high, at most 1.2 m wide, and 1.2 times
  /// higher than wide.
  bool upright() const {
    const double width = plan_width(box), height = box.sizes().z();
    return width <= 1.2 && height >= 0.9 && height <= 2.3 && height >= 1.2 * width;
  }

  /// Adds a detection, whose box in the fixed frame is `seen`.
  void add(const Eigen::AlignedBox3d& seen, Refinement refinement) {
    if (refinement == Refinement::none) ++whole;
    cut = refinement == Refinement::cut ? cut + 1 : 0;
    follow(seen);
  }

 private:
  // Moves the box with a measured box, as far as both faces moved in the same direction. Then extends or
  // shrinks it.
  void follow(const Eigen::AlignedBox3d& seen) {
    if (box.isEmpty()) box = seen;
    for (int i = 0; i < 3; ++i) {
      const double shift = face_shift(seen.min()[i] - box.min()[i], seen.max()[i] - box.max()[i]);
      box.min()[i] += shift;
      box.max()[i] += shift;
      follow_faces(box.min()[i], box.max()[i], seen.min()[i], seen.max()[i]);
    }
  }
};

/// Returns the objects whose centres have an x from `low` to `high`. `objects` is sorted by this x.
inline std::pair<const KnownObject*, const KnownObject*> objects_between(
    const std::vector<KnownObject>& objects, double low, double high) {
  const auto x_of = [](const KnownObject& object) { return object.box.center().x(); };
  const auto first = std::partition_point(objects.begin(), objects.end(),
                                          [&](const KnownObject& object) { return x_of(object) < low; });
  const auto last = std::partition_point(first, objects.end(),
                                         [&](const KnownObject& object) { return x_of(object) <= high; });
  return {objects.data() + (first - objects.begin()), objects.data() + (last - objects.begin())};
}

}  // namespace detail
}  // namespace pcl_bv
