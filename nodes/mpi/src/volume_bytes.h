// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Serialization of fitted volumes, for messages between ranks.
#pragma once

#include <string>

#include "pcl_bv/fitting/result.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// Serializes a Sphere or an Obb with its exact bits. `sphere-exact` and the methods that need all points
/// give only these two kinds of volumes. Throws std::invalid_argument for other volumes.
std::string bytes_of(const Fitted<AnyVolume>& fitted);

/// Inverse of bytes_of(), on a machine with the same memory layout.
Fitted<AnyVolume> fitted_from(const std::string& bytes);

}  // namespace pcl_bv::detail
