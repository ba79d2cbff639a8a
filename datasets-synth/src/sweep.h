// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The azimuth columns of a sweep and the objects that the rays of each column may hit.
#pragma once

#include <cstddef>
#include <vector>

#include "street_layout.h"

namespace pcl_bv::detail {

/// Returns the azimuth of the middle of a column, radians. Azimuths decrease from pi (backward) to -pi, which
/// is clockwise as seen from above.
double azimuth_of(double column, std::size_t columns);

struct ColumnCandidate {
  double min_range;  ///< Lower bound on the range of the object's returns, metres.
  const PlacedObject* object;
};

/// Returns for each column the objects that the rays of the column may hit, nearest first. The result points
/// into `objects`.
std::vector<std::vector<ColumnCandidate>> candidates_by_column(const std::vector<PlacedObject>& objects,
                                                               std::size_t columns);

}  // namespace pcl_bv::detail
