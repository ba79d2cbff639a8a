// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A size known at compile time turns each copy into one load and store; fields of 4 bytes are nearly all
// there are.
#include "copy_strided.h"

#include <cstring>

namespace pcl_bv {
namespace {

template <std::size_t Bytes>
void copy_fixed(StridedSource from, StridedTarget to, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to.base + to.offset + i * to.stride, from.base + from.offset + i * from.stride, Bytes);
  }
}

}  // namespace

void copy_strided(StridedSource from, StridedTarget to, std::size_t bytes, std::size_t count) {
  switch (bytes) {
    case 1:
      return copy_fixed<1>(from, to, count);
    case 2:
      return copy_fixed<2>(from, to, count);
    case 4:
      return copy_fixed<4>(from, to, count);
    case 8:
      return copy_fixed<8>(from, to, count);
    default:
      for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(to.base + to.offset + i * to.stride, from.base + from.offset + i * from.stride, bytes);
      }
  }
}

}  // namespace pcl_bv
