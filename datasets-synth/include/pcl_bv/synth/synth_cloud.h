// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A generated cloud with the truth about each of its points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points and what each of them is. The labels are empty for scenes that have none (the shapes).
struct SynthCloud {
  std::vector<float> xyz;  ///< Three per point, metres.
  std::vector<std::uint32_t>
      object;  ///< 0: no object; else the id, >= 1, of the object that returned the ray.
  std::vector<std::uint32_t> ground;      ///< 1 for a return of the ground, else 0.
  std::vector<std::uint32_t> vegetation;  ///< 1 for a return of grass, else 0; scenes without have none.
  std::vector<std::uint32_t> kind;        ///< 1 + the StreetObjectKind of the object; 0: no object.
  std::size_t height = 1;                 ///< Rows of points, row by row: 64 beams for a sweep.

  std::size_t size() const { return xyz.size() / 3; }
};

/// The cloud as a file holds it: float32 x y z and, where there are labels, uint32 `object`, `ground`,
/// `vegetation` and `class` (the kind).
RawCloud to_raw_cloud(const SynthCloud& cloud);

}  // namespace pcl_bv
