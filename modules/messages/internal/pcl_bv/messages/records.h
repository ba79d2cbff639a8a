// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// A non-owning view of a list of structs that have fields of fixed sizes only. `bytes` is the sum of these
/// sizes; no field may need padding before it. `alignment` is the largest size of a field. With a vector
/// instead, a cloud's points would be copied.
template <std::size_t bytes, std::size_t alignment>
struct Records {
  static constexpr std::size_t kBytes = bytes;

  const std::byte* data = nullptr;  ///< First struct. Not aligned.
  std::uint32_t count = 0;
  std::size_t stride = bytes;  ///< Bytes from one struct to the next. The last one has only `bytes` bytes.
  bool swapped = false;        ///< Whether the numbers are in the other byte order than this machine's.
};

}  // namespace msg
}  // namespace pcl_bv
