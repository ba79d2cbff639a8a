// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts clouds to arrays of records, and writes arrays to .pcd files.
#pragma once

#include "arrays.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::python {

/// Returns an array of records with the cloud's fields, without a copy: the array owns the cloud's memory.
/// The shape is (height, width) for an organised cloud, otherwise (width,). Padding, and fields whose name
/// occurs before, become unnamed bytes.
py::array array_of_cloud(RawCloud&& cloud);

/// Writes a .pcd file. `points`: as for points_of(); records are written with all their fields. Raises a
/// TypeError for a field that the format cannot hold. `labels`: None, or the values of the additional field
/// `label`.
void write_cloud(const std::filesystem::path& path, py::handle points, py::handle labels);

}  // namespace pcl_bv::python
