// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

/// Writes files of objects, as fuzz_objects wants them, and of the ground, as fuzz_ground wants them.
void write_objects(const std::filesystem::path& folder);
