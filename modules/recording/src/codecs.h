// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whole blocks of bytes, compressed as recordings do: lz4 and zstd in their frame formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "pcl_bv/recording/compression.h"

namespace pcl_bv {

inline constexpr Compression kCompressions[]{Compression::none, Compression::lz4, Compression::zstd};

std::string_view name_of(Compression compression);  ///< "", "lz4" or "zstd", as MCAP has it.

/// Replaces `to`. Reuse keeps the capacity and what the libraries need.
class Compressor {
 public:
  Compressor();
  ~Compressor();
  void compress(Compression compression, const std::byte* data, std::size_t size, std::vector<std::byte>& to);

 private:
  struct Contexts;
  std::unique_ptr<Contexts> contexts_;
};

/// Makes `to` the `expected` bytes that `data` stands for. Throws IoError, in words, if it does not stand for
/// just as many; what is announced takes no more memory than comes of it.
class Decompressor {
 public:
  Decompressor();
  ~Decompressor();
  void decompress(Compression compression, const std::byte* data, std::size_t size, std::size_t expected,
                  std::vector<std::byte>& to);

  /// Frames of zstd whose length nobody said. Throws IoError if they are damaged, cut, or more than `most`.
  void decompress_zstd(const std::byte* data, std::size_t size, std::vector<std::byte>& to,
                       std::size_t most = SIZE_MAX);

 private:
  struct Contexts;
  std::unique_ptr<Contexts> contexts_;
};

/// CRC-32 as in IEEE 802.3, which MCAP, zip and png use; of what follows `crc`.
std::uint32_t crc32_of(const std::byte* data, std::size_t size, std::uint32_t crc = 0);

}  // namespace pcl_bv
