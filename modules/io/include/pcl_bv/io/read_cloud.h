// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The extension of a path in lower case, with the dot: ".ply". Empty if there is none.
std::string lower_case_extension(const std::filesystem::path& path);

/// Whether the name is that of a cloud: it ends in .pcd, .ply, .bin, .las or .laz (which is refused), in any
/// case.
bool is_cloud_name(const std::filesystem::path& path);

/// Reads the cloud by the reader that the extension names: .ply by read_ply(), .bin by read_bin() with
/// `bin_fields`, .las by read_las(), all others by read_pcd(), text by the policy's threads. Throws IoError,
/// naming the reason.
RawCloud read_cloud(const std::filesystem::path& path, const ParallelPolicy& policy = Serial{},
                    std::size_t bin_fields = 0);

/// What the header of a file says of its points.
struct CloudHeader {
  RawCloud cloud;  ///< All but its points.
  ScalarType scalar = ScalarType::float32;
  bool by_position = false;  ///< Whether any of them can be read without those before (CloudFile).
};

/// Reads no points: a file can still turn out to be cut or damaged. Throws as read_cloud().
CloudHeader read_cloud_header(const std::filesystem::path& path, std::size_t bin_fields = 0);

}  // namespace pcl_bv
