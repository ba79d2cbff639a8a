// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Compression of a recording's chunks.
enum class Compression : std::uint8_t { none, lz4, zstd };

}  // namespace detail
}  // namespace pcl_bv
