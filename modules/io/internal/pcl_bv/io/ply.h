// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of the points of the Polygon File Format (Stanford), version 1.0.
#pragma once

#include <filesystem>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Reads the element `vertex` of a .ply file. The file can be ascii, binary_little_endian or
/// binary_big_endian, with elements and properties in any order. x, y and z (or X, Y and Z) may be of any
/// type. Every property except lists becomes a field, in the order of the file, with little-endian values.
/// Lists and other elements are left out. The cloud has height 1 and the identity as viewpoint.
///
/// The header may have at most 1 MiB. Sizes in the header are checked against the size of the file before
/// anything is allocated. Data after the vertices is ignored, with two exceptions for files whose last
/// element is `vertex`. Further rows of an ascii file are an error. Further vertices of a binary file are
/// reported in RawCloud::note, unless vertices have lists. Numbers, threads and errors are as in read_pcd().
RawCloud read_ply(const std::filesystem::path& path, const Execution& execution = {Serial{}, Isa::scalar});

}  // namespace detail
}  // namespace pcl_bv
