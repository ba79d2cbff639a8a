// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files with the lowest points of a share of a cloud, from which the ground of the whole cloud is computed.
#pragma once

#include <filesystem>
#include <string>

#include "pcl_bv/report/object_file.h"
#include "pcl_bv/report/partial_file.h"
#include "pcl_bv/segmentation/slope_surface.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// What a file says about its share.
struct GroundFileHeader {
  PartialFile cloud;    ///< The cloud and the points of the share; without a Partial.
  std::string options;  ///< Those of the ground. Files with others do not belong together.
};

/// Writes a file; a lasting one atomically, with missing folders. Throws IoError.
void write_ground_file(const std::filesystem::path& path, FileLife life, const GroundFileHeader& header,
                       const LowestPoints& lowest);

/// Reads a file and adds its lowest points to `lowest`. Throws IoError with the reason, also if the file is
/// damaged; then some points may have been added.
GroundFileHeader read_ground_file(const std::filesystem::path& path, LowestPoints& lowest);

}  // namespace gnu::visibility("default")]]detail
}  // namespace pcl_bv
