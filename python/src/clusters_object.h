// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of Python's Clusters and Ground.
#pragma once

#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/segmentation/ground.h"
#include "precompiled.h"

namespace pcl_bv::python {
using namespace detail;

/// The data of Python's Clusters.
struct ClustersObject {
  Clusters found;
  std::size_t points = 0;
  std::vector<std::int64_t> class_of{};  ///< Class of each cluster; empty without classes.
  std::vector<std::int32_t> labels{};    ///< Label of each point, or -1. Empty after unpickling.

  /// Returns the labels. The first call after unpickling computes the labels. Unpickling itself does not,
  /// because a pickle of a few bytes may claim to have 2^31 points. Needs the GIL.
  const std::vector<std::int32_t>& computed_labels() {
    if (labels.size() != points) label_points();
    return labels;
  }

  void label_points() {
    labels.assign(points, -1);
    for (std::size_t id = 0; id < found.size(); ++id) {
      for (std::size_t i = found.offsets[id]; i < found.offsets[id + 1]; ++i)
        labels[static_cast<std::size_t>(found.indices[i])] = static_cast<std::int32_t>(id);
    }
  }
};

/// The data of Python's Ground: the ground's points, and the plane near the sensor.
struct GroundObject {
  GroundSplit split;
  std::size_t points = 0;
};

}  // namespace pcl_bv::python
