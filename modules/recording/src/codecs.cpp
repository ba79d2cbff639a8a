// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "codecs.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

// Level 1 is fast. Recording must not slow down a stream.
constexpr int kZstdLevel = 1;
// A byte of zstd can become 20 000 bytes, but real data of more than 64 MiB is not compressed by more than
// 1000.
constexpr std::size_t kMaxZstdRatio = 1000, kAllowedZstdBytes = std::size_t{64} << 20;

[[noreturn]] void refuse(const char* library, const std::string& what) {
  throw IoError(std::string(library) + ": " + what);
}

// Throws IoError if lz4 cannot yield `expected` bytes. One byte of lz4 decompresses to at most 255 bytes.
void check_lz4(std::size_t size, std::size_t expected) {
  if (expected / 256 > size)
    refuse("lz4", std::to_string(size) + " bytes cannot decompress to " + std::to_string(expected));
}

void unpack_lz4(LZ4F_dctx* context, const std::byte* data, std::size_t size, std::vector<std::byte>& to) {
  LZ4F_resetDecompressionContext(context);
  std::size_t read = 0, written = 0, hint = 1;
  while (hint != 0) {
    std::size_t source = size - read, target = to.size() - written;
    hint = LZ4F_decompress(context, to.data() + written, &target, data + read, &source, nullptr);
    if (LZ4F_isError(hint) != 0) refuse("lz4", LZ4F_getErrorName(hint));
    if (hint != 0 && source == 0 && target == 0) break;  // no progress: `to` is full, or the data ends
    read += source;
    written += target;
  }
  if (hint != 0 || written != to.size() || read != size)
    refuse("lz4", "not a frame of " + std::to_string(to.size()) + " bytes");
}

}  // namespace

std::string_view name_of(Compression compression) {
  if (compression == Compression::none) return "";
  return compression == Compression::lz4 ? "lz4" : "zstd";
}

struct Compressor::Contexts {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{ZSTD_createCCtx(), ZSTD_freeCCtx};
};
Compressor::Compressor() : contexts_(std::make_unique<Contexts>()) {}
Compressor::~Compressor() = default;

void Compressor::compress(Compression compression, const std::byte* data, std::size_t size,
                          std::vector<std::byte>& to) {
  if (compression == Compression::none) {
    to.assign(data, data + size);
  } else if (compression == Compression::zstd) {
    to.resize(ZSTD_compressBound(size));
    const std::size_t made =
        ZSTD_compressCCtx(contexts_->zstd.get(), to.data(), to.size(), data, size, kZstdLevel);
    if (ZSTD_isError(made) != 0) refuse("zstd", ZSTD_getErrorName(made));
    to.resize(made);
  } else {
    to.resize(LZ4F_compressFrameBound(size, nullptr));
    const std::size_t made = LZ4F_compressFrame(to.data(), to.size(), data, size, nullptr);
    if (LZ4F_isError(made) != 0) refuse("lz4", LZ4F_getErrorName(made));
    to.resize(made);
  }
}

struct Decompressor::Contexts {
  Contexts() {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&lz4, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  }
  ~Contexts() { LZ4F_freeDecompressionContext(lz4); }
  Contexts(const Contexts&) = delete;
  Contexts& operator=(const Contexts&) = delete;

  LZ4F_dctx* lz4 = nullptr;
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> zstd{ZSTD_createDCtx(), ZSTD_freeDCtx};
};
Decompressor::Decompressor() : contexts_(std::make_unique<Contexts>()) {}
Decompressor::~Decompressor() = default;

void Decompressor::decompress(Compression compression, const std::byte* data, std::size_t size,
                              std::size_t expected, std::vector<std::byte>& to) {
  if (compression == Compression::none) {
    if (size != expected) refuse("chunk", std::to_string(size) + " bytes, not " + std::to_string(expected));
    to.assign(data, data + size);
    return;
  }
  if (compression == Compression::lz4) {
    check_lz4(size, expected);
    to.resize(expected);
    return unpack_lz4(contexts_->lz4, data, size, to);
  }
  if (expected / 64 > size) {  // do not trust `expected`; the buffer grows with the output
    decompress_zstd(data, size, to, expected);
    if (to.size() != expected) refuse("zstd", "not " + std::to_string(expected) + " bytes");
    return;
  }
  to.resize(expected);
  const std::size_t made = ZSTD_decompressDCtx(contexts_->zstd.get(), to.data(), expected, data, size);
  if (ZSTD_isError(made) != 0) refuse("zstd", ZSTD_getErrorName(made));
  if (made != expected) refuse("zstd", std::to_string(made) + " bytes, not " + std::to_string(expected));
}

void Decompressor::decompress_zstd(const std::byte* data, std::size_t size, std::vector<std::byte>& to,
                                   std::size_t max_bytes) {
  max_bytes = std::min(max_bytes, std::max(kAllowedZstdBytes, kMaxZstdRatio * size));
  ZSTD_DCtx_reset(contexts_->zstd.get(), ZSTD_reset_session_only);
  // Limit the memory of zstd's window, because a frame of a few bytes can request 128 MiB. For less than 1
  // MiB of compressed data the limit is 8 MiB, which is enough for level 19. Otherwise the limit is 128 MiB.
  ZSTD_DCtx_setParameter(contexts_->zstd.get(), ZSTD_d_windowLogMax, size < (1U << 20U) ? 23 : 27);
  ZSTD_inBuffer in{data, size, 0};
  std::size_t made = 0, rest = 1;
  while (in.pos < in.size || rest != 0) {
    to.resize(std::max({2 * made, 4 * size, std::size_t{1} << 16U}));
    ZSTD_outBuffer out{to.data(), to.size(), made};
    const std::size_t before = in.pos;
    rest = ZSTD_decompressStream(contexts_->zstd.get(), &out, &in);
    if (ZSTD_isError(rest) != 0) refuse("zstd", ZSTD_getErrorName(rest));
    if (in.pos == before && out.pos == made) refuse("zstd", "the frame is cut");
    made = out.pos;
    if (made > max_bytes) refuse("zstd", "more than " + std::to_string(max_bytes) + " bytes");
  }
  to.resize(made);
}

}  // namespace pcl_bv::detail
