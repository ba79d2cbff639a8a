// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The compressed block begins with two uint32 sizes (packed, unpacked). An LZF stream follows. It unpacks to
// all values of the first field, then all values of the second field, and so on.
#include <liblzf/lzf.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "fields.h"
#include "pcd_format.h"

namespace pcl_bv::detail {
namespace {

struct BlockSizes {
  std::uint32_t packed;
  std::uint32_t unpacked;
};

// Maximum ratio of the unpacked to the packed size, so that a small file cannot request much memory. Three
// bytes of LZF unpack to at most 264 bytes (7 + 255 + 2), a factor of 88.
constexpr std::uint64_t kMaxExpansion = 88;

// The compressed size must fit in a uint32, also for incompressible data. LZF expands such data by 1 byte in
// 32.
constexpr std::size_t kMaxUnpackedBytes = 4'000'000'000;

void check_sizes(const BlockSizes& sizes, std::size_t available, std::size_t needed) {
  if (sizes.packed > available) {
    throw IoError("truncated: " + std::to_string(sizes.packed) + " bytes of compressed data, the file has " +
                  std::to_string(available));
  }
  if (sizes.unpacked != needed) {
    throw IoError("corrupt: compressed data of " + std::to_string(sizes.unpacked) +
                  " bytes, the points of the header need " + std::to_string(needed));
  }
  if (sizes.unpacked > sizes.packed * kMaxExpansion) {
    throw IoError("corrupt: " + std::to_string(sizes.packed) + " bytes of compressed data cannot hold " +
                  std::to_string(sizes.unpacked));
  }
}

// Unpacks a block. Some writers store a block uncompressed if LZF does not shrink it. Then the packed and the
// unpacked size are equal. An LZF stream can have equal sizes, too. Therefore LZF is tried first.
void unpack(ByteBuffer& packed, ByteBuffer& unpacked) {
  const unsigned got = lzf_decompress(packed.data(), static_cast<unsigned>(packed.size()), unpacked.data(),
                                      static_cast<unsigned>(unpacked.size()));
  if (got == unpacked.size()) return;
  if (packed.size() != unpacked.size()) throw IoError("corrupt: the compressed data cannot be unpacked");
  unpacked.swap(packed);
}

// Bytes of a block of records that stays in the cache while all its fields are written.
constexpr std::size_t block_bytes = 128 << 10;

void interleave_columns(const ByteBuffer& columns, RawCloud& cloud) {
  const std::size_t block = std::max<std::size_t>(block_bytes / cloud.point_step, 1);
  for (std::size_t first = 0; first < cloud.size(); first += block) {
    const std::size_t count = std::min(block, cloud.size() - first);
    std::byte* records = cloud.data.data() + first * cloud.point_step;
    for (const PointField& field : cloud.fields) {
      const std::byte* column = columns.data() + field.offset * cloud.size();
      copy_strided({column, first * field.bytes(), field.bytes()}, {records, field.offset, cloud.point_step},
                   field.bytes(), count);
    }
  }
}

// Returns all values of the first field, then all values of the second field, and so on, without padding.
ByteBuffer field_by_field(const RawCloud& cloud) {
  std::size_t step = 0;
  for (const PointField& field : cloud.fields)
    step += field.name == "_" ? 0 : field.bytes();
  ByteBuffer columns(cloud.size() * step);
  std::byte* column = columns.data();
  for (const PointField& field : cloud.fields) {
    if (field.name == "_") continue;
    copy_strided({cloud.data.data(), field.offset, cloud.point_step}, {column, 0, field.bytes()},
                 field.bytes(), cloud.size());
    column += field.bytes() * cloud.size();
  }
  return columns;
}

}  // namespace

void read_compressed_points(const InputFile& file, PcdHeader& header) {
  RawCloud& cloud = header.cloud;
  if (cloud.size() == 0) return;
  BlockSizes sizes;
  const std::size_t offset = header.data_offset, available = file.size() - offset;
  if (available < sizeof sizes) throw IoError("truncated: the sizes of the compressed data are missing");
  file.read(offset, &sizes, sizeof sizes);
  check_sizes(sizes, available - sizeof sizes, cloud.size() * cloud.point_step);

  ByteBuffer columns(sizes.unpacked);
  {
    ByteBuffer packed(sizes.packed);
    file.read(offset + sizeof sizes, packed.data(), packed.size());
    unpack(packed, columns);
  }
  cloud.data.resize(columns.size());
  interleave_columns(columns, cloud);
}

std::string compress_points(const RawCloud& cloud) {
  const ByteBuffer columns = field_by_field(cloud);
  if (columns.size() > kMaxUnpackedBytes) {
    throw IoError(std::to_string(columns.size()) +
                  " bytes of points are too many for binary_compressed, at most " +
                  std::to_string(kMaxUnpackedBytes));
  }
  BlockSizes sizes{0, static_cast<std::uint32_t>(columns.size())};
  std::string block(sizeof sizes + columns.size() + columns.size() / 16 + 64, '\0');
  sizes.packed = lzf_compress(columns.data(), sizes.unpacked, block.data() + sizeof sizes,
                              static_cast<unsigned>(block.size() - sizeof sizes));
  if (sizes.packed == 0 && sizes.unpacked != 0) throw IoError("the points cannot be compressed");
  std::memcpy(block.data(), &sizes, sizeof sizes);
  block.resize(sizeof sizes + sizes.packed);
  return block;
}

}  // namespace pcl_bv::detail
