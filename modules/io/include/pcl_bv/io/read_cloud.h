// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the extension of a path in lower case with the dot, such as ".ply". Returns an empty string if the
/// path has no extension.
std::string lower_case_extension(const std::filesystem::path& path);

/// Returns whether the name ends in .pcd, .ply, .bin, .las or .laz, in upper or lower case. (.laz files
/// cannot be read. The error of read_cloud() says why.)
bool is_cloud_name(const std::filesystem::path& path);

/// Options of read_cloud().
struct ReadOptions {
  /// Number of float32 values per point of .bin files, of which the first three are x, y, z. 0 means 4, or 5
  /// for names that end in .pcd.bin (nuScenes).
  std::size_t bin_fields = 0;
};

/// Reads a cloud. The extension selects the reader: read_ply() for .ply, read_bin() for .bin, read_las() for
/// .las and .laz, and read_pcd() for all others. The threads of the execution read text. Throws IoError with
/// the reason. For extensions of other known formats (meshes, recordings) the reason includes advice.
RawCloud read_cloud(const std::filesystem::path& path, const ReadOptions& options = {},
                    const Execution& execution = {Serial{}, Isa::scalar});

/// The content of a cloud file's header.
struct CloudHeader {
  RawCloud cloud;                           ///< The cloud without its points.
  ScalarType scalar = ScalarType::float32;  ///< Type of the coordinates in RawCloud::xyz().
  bool random_access = false;               ///< Whether any point can be read on its own (see CloudFile).
};

/// Reads the header of a cloud file. The points are not read. A later read can therefore still find that the
/// file is cut or damaged. Throws as read_cloud().
CloudHeader read_cloud_header(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace pcl_bv
