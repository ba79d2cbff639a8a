// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/ground_file.h"

#include <algorithm>
#include <boost/crc.hpp>
#include <cstring>
#include <fstream>
#include <vector>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {
namespace {

// A file is a preamble, the options, what it says about the cloud, the lowest points, and a CRC-32 of all.
struct GroundPreamble {
  char format[24];
  std::uint64_t option_bytes, cloud_bytes, cells;
};
static_assert(sizeof(GroundPreamble) == 48 && sizeof(LowestPoint) == 16);

constexpr char kGroundFormat[sizeof GroundPreamble::format] = "pcl_bv ground 1\n";
constexpr std::uint64_t kMaxText = 1U << 24U;
constexpr std::size_t kCellsPerBlock = 1U << 16U;

void require_ground(bool good, const char* what) {
  if (!good) throw IoError(what);
}

// Reads bytes of a file in their order, with their check sum.
class SummedReader {
 public:
  explicit SummedReader(const std::filesystem::path& path) : file_(path) {}

  std::uint64_t left() const { return file_.size() - at_; }
  void read(void* to, std::size_t count) {
    require_ground(count <= left(), "is truncated");
    file_.read(at_, to, count);
    sum_.process_bytes(to, count);
    at_ += count;
  }
  std::string text(std::uint64_t bytes) {
    require_ground(bytes <= std::min(kMaxText, left()), "is truncated");
    std::string text(bytes, '\0');
    read(text.data(), text.size());
    return text;
  }
  void require_sum() {
    const std::uint32_t expected = sum_.checksum();
    std::uint32_t sum;
    require_ground(left() == sizeof sum, "is damaged: its length is wrong");
    read(&sum, sizeof sum);
    require_ground(sum == expected, "is damaged: the checksum does not match");
  }

 private:
  InputFile file_;
  std::uint64_t at_ = 0;
  boost::crc_32_type sum_;
};

void write_ground(const FileSink& sink, const GroundFileHeader& header, const LowestPoints& lowest) {
  boost::crc_32_type sum;
  const auto write = [&](std::string_view bytes) {
    sum.process_bytes(bytes.data(), bytes.size());
    sink(bytes);
  };
  const std::string cloud = partial_file_content(header.cloud);
  GroundPreamble preamble{{}, header.options.size(), cloud.size(), lowest.size()};
  std::memcpy(preamble.format, kGroundFormat, sizeof kGroundFormat);
  write({reinterpret_cast<const char*>(&preamble), sizeof preamble});
  write(header.options);
  write(cloud);
  std::vector<LowestPoint> block;
  for (std::size_t first = 0; first < lowest.size(); first += block.size()) {
    block.clear();
    for (std::size_t i = first; i < std::min(first + kCellsPerBlock, lowest.size()); ++i)
      block.push_back(lowest[i]);
    write({reinterpret_cast<const char*>(block.data()), block.size() * sizeof(LowestPoint)});
  }
  const std::uint32_t all = sum.checksum();
  sink({reinterpret_cast<const char*>(&all), sizeof all});
}

}  // namespace

void write_ground_file(const std::filesystem::path& path, FileLife life, const GroundFileHeader& header,
                       const LowestPoints& lowest) {
  if (life == FileLife::lasting) {
    create_parent_folders(path);
    write_file_atomically(path, [&](const FileSink& sink) { write_ground(sink, header, lowest); });
    return;
  }
  std::ofstream out(path, std::ios::binary);
  write_ground(
      [&](std::string_view bytes) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); },
      header, lowest);
  out.close();
  require_ground(!out.fail(), "cannot be written: is the disk full?");
}

GroundFileHeader read_ground_file(const std::filesystem::path& path, LowestPoints& lowest) {
  SummedReader file(path);
  GroundPreamble preamble;
  require_ground(file.left() >= sizeof preamble, "is no file of the ground, as --partial --ground writes it");
  file.read(&preamble, sizeof preamble);
  require_ground(std::memcmp(preamble.format, kGroundFormat, 14) == 0,
                 "is no file of the ground, as --partial --ground writes it");
  require_ground(std::memcmp(preamble.format, kGroundFormat, sizeof kGroundFormat) == 0,
                 "was written by another version of pcl_bv: this one reads version 1");
  GroundFileHeader header;
  header.options = file.text(preamble.option_bytes);
  header.cloud = parse_partial_file(file.text(preamble.cloud_bytes), false);
  std::vector<LowestPoint> block;
  for (std::uint64_t left = preamble.cells; left > 0; left -= block.size()) {
    block.resize(std::min<std::uint64_t>(left, kCellsPerBlock));
    file.read(block.data(), block.size() * sizeof(LowestPoint));
    for (const LowestPoint& point : block)
      lowest.add(point);
  }
  file.require_sum();
  return header;
}

}  // namespace pcl_bv::detail
