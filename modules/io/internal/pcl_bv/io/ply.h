// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of the Polygon File Format (Stanford), version 1.0, as far as it holds points.
#pragma once

#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads the element `vertex` of a .ply file: ascii, binary_little_endian or binary_big_endian, elements and
/// properties in any order. x, y and z (or X, Y and Z) may be of any type. Every property that is no list
/// becomes a field, in the order of the file, with its values (little-endian); lists and other elements are
/// left out. The cloud has height 1 and no viewpoint.
///
/// Sizes in the header, which may have up to 1 MiB, are held against the size of the file before anything is
/// allocated. What comes after the vertices is not looked at, except that an ascii file without further
/// elements must end there, and that more vertices of a binary one are noted. Numbers in ascii are read as
/// read_pcd() does, threads used and errors thrown as there.
RawCloud read_ply(const std::filesystem::path& path, const ParallelPolicy& policy = Serial{});

}  // namespace pcl_bv
