// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A synthetic cloud with a ground-truth label for each point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points and their ground-truth labels. A vector of labels is empty if the scene does not have these labels.
/// The simple shapes have no labels.
struct SynthCloud {
  std::vector<float> xyz;                 ///< Three per point, row by row, metres.
  std::vector<std::uint32_t> object;      ///< Id (>= 1) of the object that returned the ray; 0: none.
  std::vector<std::uint32_t> ground;      ///< 1 for a return from the ground, else 0.
  std::vector<std::uint32_t> vegetation;  ///< 1 for a return from grass, else 0. Rural road only.
  std::vector<std::uint32_t> kind;        ///< 1 + the SynthObjectKind; 0: no object. Rural road only.
  std::size_t height = 1;                 ///< Number of rows. A sweep has one row per beam.

  std::size_t size() const { return xyz.size() / 3; }  ///< Number of points.
};

/// Converts to a RawCloud for writing to a file: float32 fields `x`, `y`, `z` and, for labels that are not
/// empty, uint32 fields `object`, `ground`, `vegetation` and `class` (the kind).
RawCloud to_raw_cloud(const SynthCloud& cloud);

}  // namespace pcl_bv
