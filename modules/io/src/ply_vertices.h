// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "input_file.h"
#include "pcl_bv/parallel/policy.h"
#include "ply_header.h"

namespace pcl_bv {

/// Each reads the data of the vertices into header.cloud.data; lists are left out. Throws IoError.
void read_ply_ascii(const InputFile& file, PlyHeader& header, const ParallelPolicy& policy);
void read_ply_binary(const InputFile& file, PlyHeader& header);

}  // namespace pcl_bv
