// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Compresses and decompresses blocks of recordings in the frame formats of lz4 and zstd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "pcl_bv/recording/compression.h"

namespace pcl_bv::detail {

inline constexpr Compression kCompressions[]{Compression::none, Compression::lz4, Compression::zstd};

std::string_view name_of(Compression compression);  ///< Name in MCAP: "", "lz4" or "zstd".

/// Compresses blocks. compress() replaces `to`. Reuse a Compressor (and `to`) to keep the allocated memory.
class Compressor {
 public:
  Compressor();
  ~Compressor();
  void compress(Compression compression, const std::byte* data, std::size_t size, std::vector<std::byte>& to);

 private:
  struct Contexts;
  std::unique_ptr<Contexts> contexts_;
};

/// Decompresses blocks. Reuse a Decompressor to keep the allocated memory.
class Decompressor {
 public:
  Decompressor();
  ~Decompressor();
  /// Replaces `to` by the decompressed data. Throws IoError if the result does not have `expected` bytes. A
  /// large `expected` alone cannot cause a large allocation, because the size of `data` limits the memory,
  /// too.
  void decompress(Compression compression, const std::byte* data, std::size_t size, std::size_t expected,
                  std::vector<std::byte>& to);

  /// Decompresses zstd frames of unknown length. Throws IoError if they are damaged or cut, or if the result
  /// has more than `max_bytes` bytes, or more than 64 MiB and 1000 times the bytes of the frames.
  void decompress_zstd(const std::byte* data, std::size_t size, std::vector<std::byte>& to,
                       std::size_t max_bytes = SIZE_MAX);

 private:
  struct Contexts;
  std::unique_ptr<Contexts> contexts_;
};

}  // namespace pcl_bv::detail
