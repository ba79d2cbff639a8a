// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "copc_files.h"

#include <cmath>
#include <cstring>
#include <random>

#include "files.h"
#include "las_bytes.h"
#include "laz_files.h"
#include "laz_table.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kRecord = 36, kHeader = 375;

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename T>
T value_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string record(const std::string& user, std::uint16_t id, const std::string& data) {
  std::string bytes(54, '\0');
  bytes.replace(2, user.size(), user);
  LasFile::put(bytes, 18, id);
  LasFile::put(bytes, 20, static_cast<std::uint16_t>(data.size()));
  return bytes + data;
}

LasFile las_of(std::size_t points) {
  return {.minor = 4, .format = 7, .record = kRecord, .points = points, .offset = {0, 0, 0}};
}

std::string points_of(const CopcNode& node, std::mt19937& random) {
  std::string bytes;
  const std::size_t different = node.equal ? 1 : node.points;
  for (std::size_t i = 0; i < different; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      append(bytes,
             static_cast<std::int32_t>(std::lround(
                 1000 * (node.low(axis) + node.side() * static_cast<double>(random() % 1001) / 1000))));
    for (std::size_t k = 12; k < kRecord; ++k)
      bytes += static_cast<char>(random());
  }
  const std::string first = bytes;
  for (std::size_t i = different; i < node.points; ++i)
    bytes += first;
  return bytes;
}

struct Chunks {
  std::string bytes, laszip;  // and the data of the record of LASzip
  std::vector<LazTableEntry> table;
};

void add_chunk(const std::string& points, const std::filesystem::path& folder, Chunks& chunks) {
  const LasFile las = las_of(points.size() / kRecord);
  std::string bytes = las.bytes();
  bytes.replace(las.first_record(), std::string::npos, points);
  write_text(folder / "part.las", bytes);
  compress_las(folder / "part.las", folder / "part.laz", static_cast<std::uint32_t>(las.points));
  const std::string laz = file_content(folder / "part.laz");
  const std::size_t vlr = laz.find("laszip encoded") - 2, begin = value_at<std::uint32_t>(laz, 96) + 8;
  const auto end = static_cast<std::size_t>(value_at<std::int64_t>(laz, begin - 8));
  chunks.laszip = laz.substr(vlr + 54, value_at<std::uint16_t>(laz, vlr + 20));
  LasFile::put(chunks.laszip, 12, 0xFFFFFFFFU);
  chunks.bytes += laz.substr(begin, end - begin);
  chunks.table.push_back({static_cast<std::uint32_t>(las.points), static_cast<std::uint32_t>(end - begin)});
}

// The pages of the tree; the second one, if any, comes first.
struct Tree {
  std::string bytes;
  std::size_t root_at, root_bytes;
};

Tree tree_of(const std::vector<CopcNode>& nodes, const Chunks& chunks, std::size_t chunks_at,
             std::size_t tree_at) {
  std::string pages[2];
  std::size_t at = chunks_at, chunk = 0;
  const auto entry = [](std::string& page, const CopcNode& node, std::uint64_t offset, std::size_t bytes,
                        std::int32_t points) {
    append(page, node.level);
    append(page, node.at);
    append(page, offset);
    append(page, static_cast<std::int32_t>(bytes));
    append(page, points);
  };
  for (const CopcNode& node : nodes) {
    const std::size_t bytes = node.points == 0 ? 0 : chunks.table[chunk++].bytes;
    entry(pages[node.on_second_page ? 1 : 0], node, at, bytes, static_cast<std::int32_t>(node.points));
    at += bytes;
  }
  if (!pages[1].empty()) entry(pages[0], {}, tree_at, pages[1].size(), -1);
  return {pages[1] + pages[0], tree_at + pages[1].size(), pages[0].size()};
}

}  // namespace

double CopcNode::side() const {
  return 128 / std::exp2(level);
}

double CopcNode::low(std::size_t axis) const {
  return -64 + at[axis] * side();
}

CopcFile make_copc(const std::vector<CopcNode>& nodes, const std::filesystem::path& folder, unsigned seed) {
  std::mt19937 random(seed);
  Chunks chunks;
  std::string all;
  for (const CopcNode& node : nodes) {
    if (node.points == 0) continue;
    const std::string points = points_of(node, random);
    all += points;
    add_chunk(points, folder, chunks);
  }
  const LasFile las = las_of(all.size() / kRecord);
  CopcFile file;
  file.las = las.bytes();
  file.las.replace(las.first_record(), std::string::npos, all);

  const std::string laszip = record("laszip encoded", 22204, chunks.laszip);
  const std::size_t data = kHeader + 54 + 160 + laszip.size(), begin = data + 8,
                    table_at = begin + chunks.bytes.size();
  const std::string table = laz_table(chunks.table, true);
  const std::size_t tree_at = table_at + table.size() + 60;
  const Tree tree = tree_of(nodes, chunks, begin, tree_at);
  std::string info;
  for (const double value : {0.0, 0.0, 0.0, 64.0, 1.0})
    append(info, value);
  append(info, std::uint64_t{tree.root_at});
  append(info, std::uint64_t{tree.root_bytes});
  info.resize(160);
  file.copc = file.las.substr(0, kHeader) + record("copc", 1, info) + laszip;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    LasFile::put(file.copc, 179 + 16 * axis, 64.0);
    LasFile::put(file.copc, 187 + 16 * axis, -64.0);
  }
  LasFile::put(file.copc, 96, static_cast<std::uint32_t>(data));
  LasFile::put(file.copc, 100, 2U);
  LasFile::put(file.copc, 104, static_cast<std::uint8_t>(128 + 7));
  LasFile::put(file.copc, 235, std::uint64_t{tree_at - 60});
  LasFile::put(file.copc, 243, 1U);
  append(file.copc, static_cast<std::int64_t>(table_at));
  std::string extended(60, '\0');
  extended.replace(2, 4, "copc");
  LasFile::put(extended, 18, std::uint16_t{1000});
  LasFile::put(extended, 20, std::uint64_t{tree.bytes.size()});
  file.copc += chunks.bytes + table + extended + tree.bytes;
  file.first_entry = tree_at;
  return file;
}

}  // namespace pcl_bv
