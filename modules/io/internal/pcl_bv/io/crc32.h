// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the CRC-32 of IEEE 802.3 (as in MCAP, zip and png). `crc` is the CRC of the preceding data, or 0
/// at the beginning.
std::uint32_t crc32_of(const void* data, std::size_t size, std::uint32_t crc = 0);

}  // namespace detail
}  // namespace pcl_bv
