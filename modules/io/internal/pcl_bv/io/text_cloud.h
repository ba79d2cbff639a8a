// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of plain text with a point per line: .xyz, .txt, .csv, .asc and .pts files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns whether the name has an extension of read_text_cloud().
bool is_text_name(const std::filesystem::path& path);

/// Parses names of columns, separated by commas, each with an optional type: "x,y,z,label:u4,_". Types are i,
/// u and f with the number of bytes as in .pcd; without one, it is f8. A column "_" is not used. Throws
/// std::invalid_argument for other texts, for repeated names, and without x, y and z (or X, Y and Z).
std::vector<PointField> parse_columns(std::string_view columns);

/// Reads a text file. Values are separated by blanks, commas or semicolons. With commas and semicolons,
/// blanks around a value do not belong to it, blanks inside do, and a value in double quotes may contain
/// separators. Values other than x, y and z may be empty. The names of the columns are `columns` (see
/// parse_columns()) or, if it is empty, those of the header: the line before the first line of numbers, which
/// may begin with # or //, with as many names as there are columns. Without a header the columns are x, y, z,
/// intensity if there are four, else x, y, z, field4, field5 and so on. Columns are doubles.
///
/// Lines before the numbers that begin with # or //, and a line with the number of points alone, as in .pts
/// files, are skipped. RawCloud::note says if this number is not that of the rows. Blank lines are skipped
/// everywhere. Values are read as those of ascii .pcd files (see read_pcd()), in parallel. Throws IoError
/// with the reason, and std::invalid_argument for invalid `columns`.
RawCloud read_text_cloud(const std::filesystem::path& path, std::string_view columns = {},
                         const Execution& execution = {Serial{}, Isa::scalar});

}  // namespace
}  // namespace pcl_bv
