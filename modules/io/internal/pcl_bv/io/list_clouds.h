// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Natural order: runs of digits compare as whole numbers of any length, all else byte by byte, so frame2
/// comes before frame10. Names that differ only in leading zeros (frame01, frame1) compare byte by byte.
bool natural_less(std::string_view a, std::string_view b);

/// The cloud files directly in a folder (is_cloud_name() in read_cloud.h), each as folder/name, in
/// natural order of their names. Folders and hidden files (names starting with a dot) are left out; of such
/// folders that are not hidden `subfolders`, if given, becomes the number. Empty if there are none; throws
/// IoError if the folder cannot be listed.
std::vector<std::filesystem::path> list_clouds(const std::filesystem::path& folder,
                                               std::size_t* subfolders = nullptr);

}  // namespace pcl_bv
