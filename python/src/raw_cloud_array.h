// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds of files as arrays of records, and back.
#pragma once

#include "arrays.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::python {

/// Records with the file's fields, in the cloud's own memory; (height, width) of organised clouds. Padding
/// and further fields of the same name are bytes without a name.
py::array array_of_cloud(RawCloud&& cloud);

/// A .pcd file of what points_of() takes; of records with all fields that the format can hold.
void write_cloud(const std::filesystem::path& path, py::handle points, py::handle labels);

}  // namespace pcl_bv::python
