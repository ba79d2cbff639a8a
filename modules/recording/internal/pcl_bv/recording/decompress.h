// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Decompresses a stream of zlib (RFC 1950) or gzip (RFC 1952); the first byte tells which. Throws IoError if
/// the stream is damaged or cut, or if the result has more than `max_bytes` bytes. The memory is limited by
/// `max_bytes` and by the size of the data.
std::vector<std::byte> decompress_zlib(const std::byte* data, std::size_t size, std::size_t max_bytes);

/// Decompresses frames of zstd (RFC 8878). Otherwise like decompress_zlib().
std::vector<std::byte> decompress_zstd(const std::byte* data, std::size_t size, std::size_t max_bytes);

}  // namespace detail
}  // namespace pcl_bv
