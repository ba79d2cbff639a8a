// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Searches for the next valid record after damage.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {

/// Returns the first position in [from, end) for which matches(bytes, size, position) is true, or `end`.
/// `bytes` are the bytes at the position. Their number `size` is at least `lookahead`, except near the end of
/// the file.
template <class Matches>
std::uint64_t find_in_file(const InputFile& file, std::uint64_t from, std::uint64_t end,
                           std::size_t lookahead, const Matches& matches) {
  // The window is small at first, because the next record is often near. It grows for long damage.
  std::uint64_t window = 512;
  std::vector<std::byte> bytes;
  while (from < end) {
    const std::uint64_t starts = std::min(window, end - from);
    bytes.resize(std::min<std::uint64_t>(starts + lookahead, file.size() - from));
    file.read(from, bytes.data(), bytes.size());
    for (std::size_t i = 0; i < starts; ++i) {
      if (matches(bytes.data() + i, bytes.size() - i, from + i)) return from + i;
    }
    from += starts;
    window = std::min<std::uint64_t>(4 * window, 1U << 20U);
  }
  return end;
}

inline std::string skipped_bytes(std::uint64_t from, std::uint64_t end) {
  return "skipped damaged bytes " + std::to_string(from) + " to " + std::to_string(end - 1);
}

}  // namespace pcl_bv::detail
