// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

#include "pcl_bv/fitting/result.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {

/// What a fit gave.
struct Fitted {
  EstimationResult result;
  AnyVolume volume;
};

/// For another rank, bit by bit: of spheres and boxes, as the methods give that pass over all points. Throws
/// std::invalid_argument for other shapes.
std::string bytes_of(const Fitted& fitted);

/// What bytes_of() gave on the same kind of machine.
Fitted fitted_from(const std::string& bytes);

}  // namespace pcl_bv
