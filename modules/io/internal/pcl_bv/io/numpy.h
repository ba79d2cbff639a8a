// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Readers of NumPy's files.
#pragma once

#include <filesystem>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Reads the array of a .npy file, versions 1.0 to 3.0, which is one of these:
/// - numbers with 3 or more columns, N x C or, organised, H x W x C, in the order of C or of Fortran (N x C
///   only). The fields are x, y, z, intensity if C is 4, else field4, field5 and so on;
/// - records, N or H x W, with the fields x, y and z (or X, Y and Z). All fields are read.
///
/// Sizes may be Python 2's long numbers (3L). Numbers are integers of 1 to 8 bytes, float32 or float64,
/// little-endian. Throws IoError with the reason for other arrays (objects, complex, float16, big-endian,
/// bool) and for a file that is missing, unreadable, empty or truncated. Nothing is allocated before the
/// shape is compared with the size of the file.
RawCloud read_npy(const std::filesystem::path& path);

/// Reads one array of an .npz file (stored or deflated) as read_npy(). It is the one named points, xyz,
/// cloud, pointcloud, point_cloud, pc, data or arr_0, in this order, or the only array of the file. Other
/// arrays are named in RawCloud::note. Throws IoError also if there is no such array, for encrypted files,
/// other compression and sizes above 64 GiB or above 1032 times the compressed size, which deflate cannot
/// reach.
RawCloud read_npz(const std::filesystem::path& path);

}  // namespace
}  // namespace pcl_bv
