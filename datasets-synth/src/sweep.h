// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The columns of a sweep, and what its rays may meet.
#pragma once

#include <cstddef>
#include <vector>

#include "street_layout.h"

namespace pcl_bv {

/// Azimuth of the middle of a column: from pi (backward) clockwise to -pi.
double azimuth_of(double column, std::size_t columns);

struct Candidate {
  double nearest;  ///< Metres; no return is nearer.
  const PlacedObject* object;
};

/// For each column the objects its rays may meet, nearest first. Views the objects.
std::vector<std::vector<Candidate>> candidates_by_column(const std::vector<PlacedObject>& objects,
                                                         std::size_t columns);

}  // namespace pcl_bv
