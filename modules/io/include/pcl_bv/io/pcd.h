// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader and writer of the Point Cloud Data format, version 0.7.
#pragma once

#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads a .pcd file: ascii, binary or binary_compressed (also blocks stored as they are), with fields x, y
/// and z (or X, Y and Z) among any others: float32, float64 or integers, also mixed (RawCloud::xyz()).
///
/// Sizes in the header are held against the size of the file before anything is allocated. A file of 0 points
/// gives an empty cloud. Numbers in ascii are rounded to the nearest value of their field's type, to infinity
/// or zero where they are beyond it; "nan" and "inf" are read, in any case, for floating-point fields only.
/// Whole numbers are integers however they are written (1.0, 1e3), and -1 in an unsigned field is its
/// greatest value. What is no such number is an error in a coordinate; in other fields it becomes 0 or NaN,
/// which RawCloud::note says. The note also names a VIEWPOINT that is not the identity, which is never applied.
/// Points after the last one of a binary file are left out, which the note says, but an error if the header
/// says 0 points: a recorder did not get to write how many. Rows after the last point of an ascii file are an
/// error.
///
/// Rows of text are read by the policy's threads; cloud and error are the same for any number of them. Beside
/// the cloud, text takes 0.3 MiB per thread (more only for rows longer than that) and binary_compressed
/// the file and once more the points.
///
/// Throws IoError, naming the reason, for a file that is missing, unreadable, empty, truncated, inconsistent
/// or of an unsupported type.
RawCloud read_pcd(const std::filesystem::path& path, const ParallelPolicy& policy = Serial{});

enum class PcdEncoding { ascii, binary, binary_compressed };

/// Writes all fields of the cloud, with width, height and viewpoint, as write_file_atomically() does. What is
/// written reads back equal to the bit, except that ascii keeps of a NaN only that it is one, and that
/// binary_compressed leaves out padding (fields named "_"), which PCL's reader does not expect there.
///
/// Throws IoError if the file cannot be written, if it is ascii with a field of type F and size 1 or 2, or
/// binary_compressed with more than 4e9 bytes of points; std::invalid_argument for a cloud that breaks the
/// rules of RawCloud.
void write_pcd(const std::filesystem::path& path, const RawCloud& cloud,
               PcdEncoding encoding = PcdEncoding::binary);

}  // namespace pcl_bv
