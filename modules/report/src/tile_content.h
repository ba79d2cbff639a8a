// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the points of contents of 3D Tiles.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {

/// Returns x, y, z of all points of a .pnts file (POSITION or POSITION_QUANTIZED, RTC_CENTER), or of all
/// vertices of the scene of a .glb or .b3dm file, in the frame of the tile (z up). Throws IoError with the
/// reason for other formats, for compressed positions and for damaged files.
std::vector<double> tile_points(std::string_view content);

/// Returns the matrix whose columns are 16 numbers. Throws std::invalid_argument, which names the key.
Eigen::Matrix4d column_major(const char* key, const UntrustedJson& value);

}  // namespace pcl_bv::detail
