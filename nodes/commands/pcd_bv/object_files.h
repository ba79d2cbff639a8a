// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes the points of each object to a file of its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "status.h"

namespace pcl_bv::detail {

/// Writes the points, in their order, as the binary file FOLDER/ID.pcd with the fields x, y, z. Points that
/// are not in memory are loaded in chunks. Replaces an existing file when the new one is complete. Throws
/// IoError, with the path, if that fails.
void write_object(const std::filesystem::path& folder, std::size_t id, const PointView& points);

/// Creates the folder and calls write(id) for the ids 0 to `count` - 1, on all threads of the policy. write()
/// calls write_object(). After a failure no further call begins, and one line on standard error tells why.
Status write_objects(const std::filesystem::path& folder, std::size_t count, const ParallelPolicy& policy,
                     const std::function<void(std::size_t id)>& write);

}  // namespace pcl_bv::detail
