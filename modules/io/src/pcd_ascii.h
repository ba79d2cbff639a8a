// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <string>

#include "input_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// Reads the rows from `offset` to the end of the file into cloud.data. Throws IoError.
void read_ascii_points(const InputFile& file, std::size_t offset, RawCloud& cloud,
                       const ParallelPolicy& policy);

/// The rows of all points. Throws IoError for a field that has no form as text.
std::string format_ascii_points(const RawCloud& cloud);

}  // namespace pcl_bv
