// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts clouds to arrays of records, and writes arrays to .pcd files.
#pragma once

#include "arrays.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::python {
using namespace detail;

/// Returns an array of records with the cloud's fields. The array takes over the cloud's memory, without a
/// copy. The shape is (height, width) for an organised cloud, otherwise (width,). Padding becomes unnamed
/// bytes, and so does a field with the name of an earlier field.
py::array array_of_cloud(RawCloud&& cloud);

/// Writes a .pcd file. `points` are as for points_of(). Records are written with all their fields. If
/// `labels` is not None, it has the values of an additional field `label`. Raises a TypeError for a field
/// that the format cannot hold.
void write_cloud(const std::filesystem::path& path, py::handle points, py::handle labels);

}  // namespace pcl_bv::python
