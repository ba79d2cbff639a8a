// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the extension of a path in lower case with the dot, such as ".ply", or an empty string.
std::string lower_case_extension(const std::filesystem::path& path);

/// Returns whether the name ends in .pcd, .ply, .bin, .las or .laz, in upper or lower case. (Reading a .laz
/// file fails with an error that says why.)
bool is_cloud_name(const std::filesystem::path& path);

/// Reads a cloud with the reader for its extension: .ply with read_ply(), .bin with read_bin() and
/// `bin_fields`, .las with read_las(), all others with read_pcd(). The policy's threads read text. Throws
/// IoError with the reason; extensions of known other formats (meshes, recordings) are refused with advice.
RawCloud read_cloud(const std::filesystem::path& path, const ParallelPolicy& policy = Serial{},
                    std::size_t bin_fields = 0);

/// The content of a cloud file's header.
struct CloudHeader {
  RawCloud cloud;                           ///< The cloud without its points.
  ScalarType scalar = ScalarType::float32;  ///< Type of the coordinates in RawCloud::xyz().
  bool random_access = false;               ///< Whether any point can be read on its own (CloudFile).
};

/// Reads the header of a cloud file. The points are not read, so a later read can still find that the file is
/// cut or damaged. Throws as read_cloud().
CloudHeader read_cloud_header(const std::filesystem::path& path, std::size_t bin_fields = 0);

}  // namespace pcl_bv
