// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// COPC 1.0: the first record of the file says where an octree is, each of whose nodes is a chunk. A page of
// the tree has entries of 32 bytes: level, x, y and z of the node (i32 each), offset (u64), bytes (i32) and
// points (i32), which are -1 for a page with the nodes below. The tree only saves time: one that contradicts
// the table of chunks is not used.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "fields.h"
#include "las_format.h"
#include "laz_format.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kCopcInfo = 375 + 54, kCopcInfoBytes = 160;

// Levels of a tree. Nodes of level 30 have a billionth of its side.
constexpr std::int32_t kMaxLevel = 30;

struct CopcInfo {
  double center[3], half_side, spacing;
  std::uint64_t root_offset, root_bytes;
};

struct CopcEntry {
  std::int32_t level, at[3];
  std::uint64_t offset;
  std::int32_t bytes, points;
};
static_assert(sizeof(CopcInfo) == 56 && sizeof(CopcEntry) == 32);

struct CopcPage {
  std::uint64_t offset, bytes;
};

std::optional<CopcInfo> read_info(const InputFile& file, const LasHeader& header) {
  char record[54];
  if (header.data_offset < kCopcInfo + kCopcInfoBytes) return std::nullopt;
  file.read(kCopcInfo - sizeof record, record, sizeof record);
  if (std::memcmp(record + 2, "copc\0", 5) != 0 || record[18] != 1 || record[19] != 0) return std::nullopt;
  CopcInfo info;
  file.read(kCopcInfo, &info, sizeof info);
  const bool finite =
      std::all_of(std::begin(info.center), std::end(info.center), [](double c) { return std::isfinite(c); });
  if (!finite || !std::isfinite(info.half_side) || info.half_side <= 0) return std::nullopt;
  return info;
}

// The box of a node, with a margin for the rounding of writers.
LasBox box_of(const CopcInfo& info, const LasHeader& header, const CopcEntry& entry) {
  LasBox box;
  const double side = 2 * info.half_side / std::exp2(entry.level);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = info.center[axis] - info.half_side + entry.at[axis] * side;
    const double margin = 2 * std::abs(header.scale[axis]) + 1e-9 * info.half_side + 1e-14 * std::abs(low);
    box.low[axis] = low - margin;
    box.high[axis] = low + side + margin;
  }
  return box;
}

// Returns whether the cube contains the bounding box of the header.
bool contains_bounds(const CopcInfo& info, const InputFile& file, const LasHeader& header) {
  constexpr std::size_t bounds_at = 179;  // largest and smallest x, then y and z
  double bounds[6];
  file.read(bounds_at, bounds, sizeof bounds);
  const LasBox cube = box_of(info, header, {});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool within = bounds[2 * axis] <= cube.high[axis] && bounds[2 * axis + 1] >= cube.low[axis];
    if (!within) return false;
  }
  return true;
}

class CopcTree {
 public:
  CopcTree(const InputFile& file, LasHeader& header, const CopcInfo& info)
      : file_(file), header_(header), info_(info), boxes_(header.laz->chunks.size()) {}

  // Returns the boxes of all chunks; nullopt if the tree does not have each chunk once.
  std::optional<std::vector<LasBox>> boxes() {
    pages_.push_back({info_.root_offset, info_.root_bytes});
    while (!pages_.empty()) {
      const CopcPage page = pages_.back();
      pages_.pop_back();
      if (!add_page(page)) return std::nullopt;
    }
    if (found_ != boxes_.size()) return std::nullopt;
    std::vector<LasBox> all;
    for (const std::optional<LasBox>& box : boxes_)
      all.push_back(*box);
    return all;
  }

 private:
  bool add_page(const CopcPage& page) {
    const std::size_t size = file_.size();
    if (page.offset > size || page.bytes > size - page.offset || page.bytes % sizeof(CopcEntry) != 0)
      return false;
    // Valid pages do not overlap, so their sum is at most the file size. This stops cycles of pages.
    read_bytes_ += page.bytes + sizeof(CopcEntry);
    if (read_bytes_ > size) return false;
    std::vector<CopcEntry> entries(page.bytes / sizeof(CopcEntry));
    file_.read(page.offset, entries.data(), page.bytes);
    return std::all_of(entries.begin(), entries.end(), [&](const CopcEntry& entry) { return add(entry); });
  }

  bool add(const CopcEntry& entry) {
    if (entry.level < 0 || entry.level > kMaxLevel || entry.bytes < 0) return false;
    for (const std::int32_t at : entry.at)
      if (at < 0 || at >> entry.level != 0) return false;
    if (entry.points == -1) {
      pages_.push_back({entry.offset, static_cast<std::uint64_t>(entry.bytes)});
      return true;
    }
    if (entry.points == 0) return true;
    const std::vector<LazChunk>& chunks = header_.laz->chunks;
    const auto chunk =
        std::lower_bound(chunks.begin(), chunks.end(), entry.offset,
                         [](const LazChunk& c, std::uint64_t offset) { return c.offset < offset; });
    if (chunk == chunks.end() || chunk->offset != entry.offset || !chunk->whole ||
        chunk->bytes != static_cast<std::size_t>(entry.bytes) ||
        chunk->points != static_cast<std::size_t>(entry.points))
      return false;
    std::optional<LasBox>& box = boxes_[static_cast<std::size_t>(chunk - chunks.begin())];
    if (box) return false;
    box = box_of(info_, header_, entry);
    ++found_;
    return true;
  }

  const InputFile& file_;
  LasHeader& header_;
  const CopcInfo info_;
  std::vector<std::optional<LasBox>> boxes_;  // of the chunks that were found
  std::vector<CopcPage> pages_;
  std::size_t found_ = 0, read_bytes_ = 0;
};

}  // namespace

void mark_skipped_chunks(const InputFile& file, LasHeader& header, const BoxPredicate& can_skip) {
  if (!can_skip || !header.laz || header.laz->compressor != LazLayout::layered) return;
  const std::optional<CopcInfo> info = read_info(file, header);
  if (!info) return;
  if (!contains_bounds(*info, file, header))
    return add_note(header.cloud,
                    "the COPC cube does not contain the bounding box of the header; all points are read");
  const auto boxes = CopcTree(file, header, *info).boxes();
  if (!boxes)
    return add_note(header.cloud, "the COPC octree does not match the table of chunks; all points are read");
  for (std::size_t i = 0; i < boxes->size(); ++i) {
    const LasBox& box = (*boxes)[i];
    if (!can_skip(box)) continue;
    std::array<double, 3>& center = header.laz->chunks[i].placeholder.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis)
      center[axis] = box.low[axis] / 2 + box.high[axis] / 2;
  }
}

}  // namespace pcl_bv::detail
