// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/decompress.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string>

#include "codecs.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

// A byte of deflate (RFC 1951) becomes at most 1032 bytes: a match of 258 bytes takes two bits or more.
constexpr std::size_t kMaxDeflateRatio = 1032;

constexpr std::byte kGzipStart{0x1f};  // a zlib stream begins with a byte that ends in 8

std::size_t deflate_limit(std::size_t size, std::size_t max_bytes) {
  return size < max_bytes / kMaxDeflateRatio ? size * kMaxDeflateRatio : max_bytes;
}

}  // namespace

std::vector<std::byte> decompress_zlib(const std::byte* data, std::size_t size, std::size_t max_bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (decompressor == nullptr) throw std::bad_alloc();
  std::vector<std::byte> to(std::max<std::size_t>(deflate_limit(size, max_bytes), 1));
  const bool gzip = size > 0 && data[0] == kGzipStart;
  const auto decompress = gzip ? libdeflate_gzip_decompress : libdeflate_zlib_decompress;
  std::size_t made = 0;
  const libdeflate_result result = decompress(decompressor.get(), data, size, to.data(), to.size(), &made);
  if (result == LIBDEFLATE_INSUFFICIENT_SPACE || (result == LIBDEFLATE_SUCCESS && made > max_bytes))
    throw IoError("zlib: more than " + std::to_string(max_bytes) + " bytes");
  if (result != LIBDEFLATE_SUCCESS) throw IoError("zlib: the data is damaged or cut");
  to.resize(made);
  return to;
}

std::vector<std::byte> decompress_zstd(const std::byte* data, std::size_t size, std::size_t max_bytes) {
  std::vector<std::byte> to;
  Decompressor().decompress_zstd(data, size, to, max_bytes);
  return to;
}

}  // namespace pcl_bv::detail
