// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

namespace pcl_bv::test {

/// Writes the first inputs for the readers of files of other programs.
void write_format_seeds(const std::filesystem::path& folder);

}  // namespace pcl_bv::test
