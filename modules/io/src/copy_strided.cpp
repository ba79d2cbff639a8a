// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "copy_strided.h"

#include <cstring>
#include <type_traits>

namespace pcl_bv {
namespace {

// A size known at compile time turns each copy into one load and store; fields of 4 bytes are nearly all
// there are.
template <std::size_t bytes>
constexpr std::integral_constant<std::size_t, bytes> fixed;

template <typename Size>
void copy(StridedSource from, StridedTarget to, Size bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to.base + to.offset + i * to.stride, from.base + from.offset + i * from.stride, bytes);
  }
}

}  // namespace

void copy_strided(StridedSource from, StridedTarget to, std::size_t bytes, std::size_t count) {
  switch (bytes) {
    case 1:
      return copy(from, to, fixed<1>, count);
    case 2:
      return copy(from, to, fixed<2>, count);
    case 4:
      return copy(from, to, fixed<4>, count);
    case 8:
      return copy(from, to, fixed<8>, count);
    default:
      return copy(from, to, bytes, count);
  }
}

}  // namespace pcl_bv
