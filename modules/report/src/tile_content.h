// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the points of contents of 3D Tiles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {

/// The axis of glTF that becomes z of the tile (asset.gltfUpAxis). glTF itself has y up.
enum class UpAxis : std::uint8_t { x, y, z };

/// Returns x, y, z of all points of a .pnts file (POSITION or POSITION_QUANTIZED, RTC_CENTER), or of all
/// vertices of the scene of a .glb or .b3dm file, in the frame of the tile (z up). Only glTF is turned from
/// `up` to z up; points of .pnts and the RTC_CENTER of .b3dm are in the tile's frame. Vertices that several
/// primitives of a mesh share are returned once. Throws IoError with the reason for other formats, for
/// compressed positions, for damaged files, and for more points than the size of the file allows.
std::vector<double> tile_points(std::string_view content, UpAxis up = UpAxis::y);

/// Returns the matrix whose columns are 16 numbers. Throws std::invalid_argument, which names the key.
Eigen::Matrix4d column_major(const char* key, const UntrustedJson& value);

}  // namespace pcl_bv::detail
