// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes the inputs of a tiled cloud with the labels of their points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "inputs.h"
#include "pcl_bv/io/raw_cloud.h"
#include "status.h"

namespace pcl_bv::detail {

/// Writes a cloud with a field `label`, and creates missing folders. Throws IoError.
void write_labelled(const std::filesystem::path& path, RawCloud cloud,
                    const std::vector<std::uint32_t>& labels);

/// Writes each input that is not excluded with a field `label` to its file of Job::tile_labels. `labels`
/// returns the labels of points by their numbers in the cloud. Reports files that cannot be written; the
/// others are written. Throws TileError if an input fails.
Status write_tile_labels(
    const Job& job,
    const std::function<std::vector<std::uint32_t>(std::size_t first, std::size_t count)>& labels);

}  // namespace pcl_bv::detail
