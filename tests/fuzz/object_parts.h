// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of objects with right check sums, from any bytes.
#pragma once

#include <string>
#include <string_view>

#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv::detail {

/// How an input is read: its first byte.
struct ObjectChoices {
  explicit ObjectChoices(unsigned char byte)
      : repair(byte & 3U),
        known((byte & 4U) != 0),
        own_cells((byte & 8U) != 0),
        own_components((byte & 16U) != 0),
        few_in_memory((byte & 32U) != 0),
        scalar((byte & 64U) != 0 ? ScalarType::float64 : ScalarType::float32),
        min_points((byte & 128U) != 0 ? 3 : 1) {}

  enum : unsigned { kNothing, kCheckSums };  ///< Values of `repair`; for others, all is repaired.

  unsigned repair;
  bool known;           ///< Whether components with a text are not read.
  bool own_cells;       ///< Whether runs keep the cells of the input. Else they have those of their points.
  bool own_components;  ///< Whether components keep the points of the input. Else they have those of their
                        ///< runs.
  bool few_in_memory;
  ScalarType scalar;  ///< Of the points, if all is repaired.
  std::size_t min_points;
};

ClusterOptions fuzzed_options(const ObjectChoices& choices);

/// Returns a file of objects. If all is repaired, the input has the shares without their headers.
std::string repaired_objects(std::string_view content, const ObjectChoices& choices);

/// Returns a file of objects as an input of repaired_objects().
std::string without_headers(std::string_view file);

}  // namespace pcl_bv::detail
