// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Records that lie in a file as they lie in memory: where they begin and what they hold.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "input_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

struct BinaryPoints {
  RawCloud header;         ///< All but the points.
  std::size_t offset = 0;  ///< Of the first record; all of them are there.
};

/// The points of a binary .pcd or a KITTI .bin, by the file's name; none of any other format. Throws IoError
/// for what the readers refuse.
std::optional<BinaryPoints> find_binary_points(const InputFile& file, const std::filesystem::path& path);

/// The same for a KITTI .bin.
BinaryPoints find_kitti_points(const InputFile& file);

/// Throws IoError unless the file holds all records of the cloud from `offset` on.
void require_points(const InputFile& file, std::size_t offset, const RawCloud& header);

/// Reads them into the cloud.
RawCloud read_points(const InputFile& file, BinaryPoints points);

}  // namespace pcl_bv
