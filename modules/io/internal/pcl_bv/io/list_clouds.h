// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns whether `a` comes before `b` in natural order. In this order, runs of digits compare as integers
/// of any length, and all other characters byte by byte. For example, frame2 comes before frame10. Names that
/// differ only in leading zeros (frame01, frame1) compare byte by byte.
bool natural_less(std::string_view a, std::string_view b);

/// Returns the cloud files (see is_cloud_name()) directly in a folder. Each path is folder/name. The paths
/// are in natural order of the names. Subfolders and hidden files (names starting with a dot) are left out.
/// `subfolders`, if not null, receives the number of subfolders that are not hidden. Returns an empty list if
/// the folder has no clouds. Throws IoError if the folder cannot be listed.
std::vector<std::filesystem::path> list_clouds(const std::filesystem::path& folder,
                                               std::size_t* subfolders = nullptr);

}  // namespace detail
}  // namespace pcl_bv
