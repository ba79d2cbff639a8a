// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Compression of a recording's chunks.
enum class Compression : std::uint8_t { none, lz4, zstd };

}  // namespace pcl_bv
