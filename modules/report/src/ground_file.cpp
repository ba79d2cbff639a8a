// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/ground_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <tuple>
#include <vector>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/crc32.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {
namespace {

// A file is a preamble, the options, what it says about the cloud, a CRC-32 of these, the lowest points, and
// their CRC-32.
struct GroundPreamble {
  char format[24];
  std::uint64_t option_bytes, cloud_bytes, points;
  GroundBounds bounds;
};
static_assert(sizeof(GroundPreamble) == 80 && sizeof(LowestPoint) == 16);

constexpr char kGroundFormat[sizeof GroundPreamble::format] = "pcl_bv ground 1\n";
constexpr std::uint64_t kMaxGroundText = 1U << 24U;
constexpr std::size_t kLowestPerBlock = 1U << 16U;

void require_ground(bool good, const char* what) {
  if (!good) throw IoError(what);
}

template <typename T>
std::string_view bytes_of(const T* items, std::size_t count) {
  return {reinterpret_cast<const char*>(items), count * sizeof(T)};
}

// Writes the bytes that `write` writes to the sink it gets, and their CRC-32.
template <typename Write>
void write_summed(const FileSink& sink, const Write& write) {
  std::uint32_t sum = 0;
  write([&](std::string_view bytes) {
    sum = crc32_of(bytes.data(), bytes.size(), sum);
    sink(bytes);
  });
  sink(bytes_of(&sum, 1));
}

// The cells are numbered in the order in which threads find them. Sorted, equal cells give equal bytes.
std::vector<LowestPoint> sorted_cells(const LowestPoints& lowest) {
  std::vector<LowestPoint> cells(lowest.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = lowest[i];
  std::sort(cells.begin(), cells.end(), [](const LowestPoint& a, const LowestPoint& b) {
    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
  });
  return cells;
}

void write_ground(const FileSink& sink, const GroundFileHeader& header, const LowestPoints& lowest) {
  const std::string cloud = partial_file_content(header.cloud);
  const std::vector<LowestPoint> cells = sorted_cells(lowest);
  GroundPreamble preamble{{}, header.options.size(), cloud.size(), cells.size(), {}};
  std::memcpy(preamble.format, kGroundFormat, sizeof kGroundFormat);
  for (const LowestPoint& cell : cells)
    preamble.bounds.add(cell);
  write_summed(sink, [&](const FileSink& write) {
    write(bytes_of(&preamble, 1));
    write(header.options);
    write(cloud);
  });
  write_summed(sink, [&](const FileSink& write) {
    for (std::size_t first = 0; first < cells.size(); first += kLowestPerBlock)
      write(bytes_of(&cells[first], std::min(kLowestPerBlock, cells.size() - first)));
  });
}

}  // namespace

void write_ground_file(const std::filesystem::path& path, FileLife life, const GroundFileHeader& header,
                       const LowestPoints& lowest) {
  if (life == FileLife::lasting) {
    create_folder_of(path);
    write_file_atomically(path, [&](const FileSink& sink) { write_ground(sink, header, lowest); });
    return;
  }
  std::ofstream out(path, std::ios::binary);
  require_ground(out.is_open(), "cannot be opened for writing");
  write_ground(
      [&](std::string_view bytes) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); },
      header, lowest);
  out.close();
  require_ground(!out.fail(), "cannot be written: is the disk full?");
}

void GroundBounds::add(const LowestPoint& point) {
  cells.merge({point.x, point.y, point.x, point.y});
  lowest = std::min(lowest, point.height);
  highest = std::max(highest, point.height);
}

bool GroundBounds::contain(const LowestPoint& point) const {
  return cells.contains(point) && point.height >= lowest && point.height <= highest;
}

GroundFile::GroundFile(const std::filesystem::path& path) : path_(path) {
  const InputFile file(path);
  constexpr const char* other = "is no file of the ground, as --partial --ground writes it";
  GroundPreamble preamble;
  require_ground(file.size() >= sizeof preamble, other);
  file.read(0, &preamble, sizeof preamble);
  require_ground(std::memcmp(preamble.format, kGroundFormat, 14) == 0, other);
  require_ground(std::memcmp(preamble.format, kGroundFormat, sizeof kGroundFormat) == 0,
                 "was written by another version of pcl_bv: this one reads version 1");
  require_ground(preamble.option_bytes <= kMaxGroundText && preamble.cloud_bytes <= kMaxGroundText,
                 "is damaged: its header is too large");
  const std::size_t text_bytes = preamble.option_bytes + preamble.cloud_bytes;
  std::uint32_t sum, points_sum;
  first_point_ = sizeof preamble + text_bytes + sizeof sum;
  points_ = preamble.points;
  require_ground(first_point_ + sizeof points_sum <= file.size() &&
                     points_ == (file.size() - first_point_ - sizeof points_sum) / sizeof(LowestPoint) &&
                     (file.size() - first_point_ - sizeof points_sum) % sizeof(LowestPoint) == 0,
                 "is truncated");
  std::string text(text_bytes, '\0');
  file.read(sizeof preamble, text.data(), text.size());
  file.read(first_point_ - sizeof sum, &sum, sizeof sum);
  file.read(file.size() - sizeof points_sum, &points_sum, sizeof points_sum);
  const std::uint32_t expected = crc32_of(text.data(), text.size(), crc32_of(&preamble, sizeof preamble));
  require_ground(sum == expected, "is damaged: the checksum does not match");
  header_.options = text.substr(0, preamble.option_bytes);
  header_.cloud = parse_partial_file(std::string_view(text).substr(preamble.option_bytes), false);
  bounds_ = preamble.bounds;
  check_sum_ = std::uint64_t{sum} << 32U | points_sum;
}

void GroundFile::read(const CellRange& cells, LowestPoints& lowest) const {
  const InputFile file(path_);
  std::vector<LowestPoint> block;
  std::uint32_t expected = 0;
  for (std::uint64_t first = 0; first < points_; first += block.size()) {
    block.resize(std::min<std::uint64_t>(points_ - first, kLowestPerBlock));
    const std::size_t bytes = block.size() * sizeof(LowestPoint);
    file.read(first_point_ + first * sizeof(LowestPoint), block.data(), bytes);
    expected = crc32_of(block.data(), bytes, expected);
    for (const LowestPoint& point : block) {
      require_ground(bounds_.contain(point), "is damaged: a cell is outside its bounds");
      if (cells.contains(point)) lowest.add(point);
    }
  }
  require_ground(static_cast<std::uint32_t>(check_sum_) == expected,
                 "is damaged: the checksum does not match");
}

}  // namespace pcl_bv::detail
