// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cstring>

#include "las_format.h"
#include "laz_format.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

// Points that are decompressed before memory for more of them is taken.
constexpr std::size_t kStep = 1U << 16U;

// Points per byte for which memory may be taken at once. Only damaged files and those of many equal points
// have more points in relation to their bytes.
constexpr std::size_t kPlausible = 32;

// Returns whether memory for all points may be taken at once.
bool is_plausible(const LasHeader& header) {
  std::size_t bytes = 0;
  for (const LazChunk& chunk : header.laz->chunks)
    bytes += chunk.bytes;
  return header.cloud.size() <= kStep + kPlausible * bytes;
}

// Writes the points of a chunk that is not decompressed.
void write_placeholders(const LazChunk& chunk, std::size_t point_step, std::byte* to) {
  std::memset(to, 0, chunk.points * point_step);
  for (std::size_t i = 0; i < chunk.points; ++i)
    std::memcpy(to + i * point_step, chunk.placeholder->data(), sizeof *chunk.placeholder);
}

void read_in_steps(const InputFile& file, LasHeader& header) {
  RawCloud& cloud = header.cloud;
  for (const LazChunk& chunk : header.laz->chunks) {
    if (chunk.placeholder && chunk.points <= kPlausible * chunk.bytes) {
      const std::size_t size = cloud.data.size();
      cloud.data.resize(size + chunk.points * cloud.point_step);
      write_placeholders(chunk, cloud.point_step, cloud.data.data() + size);
      continue;
    }
    LazChunkReader reader(file, header, chunk);
    for (std::size_t done = 0; done < chunk.points;) {
      const std::size_t count = std::min(kStep, chunk.points - done), size = cloud.data.size();
      cloud.data.resize(size + count * cloud.point_step);
      reader.read(count, cloud.data.data() + size);
      done += count;
    }
    reader.require_end();
  }
}

}  // namespace

void read_laz_points(const InputFile& file, LasHeader& header, const ParallelPolicy& policy) {
  RawCloud& cloud = header.cloud;
  if (!is_plausible(header)) return read_in_steps(file, header);
  cloud.data.resize(cloud.size() * cloud.point_step);
  const std::vector<LazChunk>& chunks = header.laz->chunks;
  std::vector<std::byte*> begins;
  std::byte* to = cloud.data.data();
  for (const LazChunk& chunk : chunks) {
    begins.push_back(to);
    to += chunk.points * cloud.point_step;
  }
  for_each_chunk(policy, chunks.size(), [&](std::size_t i) {
    if (chunks[i].placeholder) return write_placeholders(chunks[i], cloud.point_step, begins[i]);
    LazChunkReader reader(file, header, chunks[i]);
    reader.read(chunks[i].points, begins[i]);
    reader.require_end();
  });
}

}  // namespace pcl_bv::detail
