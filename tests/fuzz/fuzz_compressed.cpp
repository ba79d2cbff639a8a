// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cstdint>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "stream/middleware.h"
#include "stream/sources/compressed_cloud.h"

namespace pcl_bv::detail {

// There are no modules here.
void* module_function(const std::string& /*name*/, const char* /*function*/) {
  throw IoError("no modules");
}

namespace {

// Clouds up to the size that the fuzzer may allocate.
constexpr std::uint64_t kMaxBytes = 1U << 20U;

bool is_small(const msg::CompressedPointCloud2& message) {
  const std::uint64_t row =
      std::max<std::uint64_t>(std::uint64_t{message.width} * message.point_step, message.row_step);
  return row <= kMaxBytes / std::max(message.height, 1U);
}

}  // namespace
}  // namespace pcl_bv::detail

// Any bytes as point_cloud_interfaces/CompressedPointCloud2.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  try {
    msg::CompressedPointCloud2 message;
    read_cdr(reinterpret_cast<const std::byte*>(data), size, message);
    if (!detail::is_small(message)) return 0;
    const detail::DecompressedCloud made = detail::decompress(message);
    if (made.cloud.data.size > detail::kMaxBytes) __builtin_trap();
    detail::raw_cloud_of(made.cloud);
  } catch (const MessageError&) {
  }
  return 0;
}
