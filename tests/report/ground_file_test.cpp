// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/ground_file.h"

#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "temporary_folder.h"

namespace pcl_bv::detail {
namespace {

class GroundFiles : public testing::Test {
 protected:
  static std::vector<LowestPoint> cells() { return {{-3, 7, 2.5}, {4, 7, -1}, {0, -2, 0.25}}; }

  void write(const std::vector<LowestPoint>& cells) const {
    LowestPoints lowest{GroundSlopeOptions()};
    for (const LowestPoint& cell : cells)
      lowest.add(cell);
    GroundFileHeader header{{}, "options"};
    header.cloud.add_input("a.pcd", 10);
    header.cloud.shares = {{0, 10}};
    write_ground_file(path_, FileLife::lasting, header, lowest);
  }

  std::string content() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // Writes a file with other cells, and their right check sum.
  void replace_cells(std::string bytes, const std::vector<LowestPoint>& cells) const {
    const std::size_t size = cells.size() * sizeof(LowestPoint), first = bytes.size() - 4 - size;
    boost::crc_32_type sum;
    sum.process_bytes(cells.data(), size);
    const std::uint32_t value = sum.checksum();
    std::memcpy(&bytes[first], cells.data(), size);
    std::memcpy(&bytes[first + size], &value, sizeof value);
    std::ofstream(path_, std::ios::binary) << bytes;
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "file";
  const CellRange all_{-100, -100, 100, 100};
};

TEST_F(GroundFiles, ReadBackTheirCellsAndBounds) {
  write(cells());
  const GroundFile file(path_);
  EXPECT_EQ(file.header().options, "options");
  EXPECT_EQ(file.header().cloud.cloud_points, 10U);
  const GroundBounds bounds = file.bounds();
  EXPECT_EQ(std::vector({bounds.cells.min_x, bounds.cells.min_y, bounds.cells.max_x, bounds.cells.max_y}),
            std::vector({-3, -2, 4, 7}));
  EXPECT_EQ(bounds.lowest, -1);
  EXPECT_EQ(bounds.highest, 2.5);
  LowestPoints some{GroundSlopeOptions()}, all{GroundSlopeOptions()};
  file.read({0, -2, 4, 6}, some);
  ASSERT_EQ(some.size(), 1U);
  EXPECT_EQ(some[0].height, 0.25);
  file.read(all_, all);
  EXPECT_EQ(all.size(), 3U);
}

TEST_F(GroundFiles, HaveTheSameBytesForCellsInAnyOrder) {
  std::vector<LowestPoint> list = cells();
  write(list);
  const std::string expected = content();
  std::swap(list[0], list[2]);
  write(list);
  EXPECT_TRUE(content() == expected);
}

TEST_F(GroundFiles, WithACellOutsideTheirBoundsAreDamaged) {
  write(cells());
  const std::string bytes = content();
  const auto expect_damaged = [&](const LowestPoint& cell) {
    std::vector<LowestPoint> list = cells();
    list[1] = cell;
    replace_cells(bytes, list);
    LowestPoints lowest{GroundSlopeOptions()};
    try {
      GroundFile(path_).read(all_, lowest);
      ADD_FAILURE() << cell.x << ' ' << cell.y << ' ' << cell.height;
    } catch (const IoError& error) {
      EXPECT_STREQ(error.what(), "is damaged: a cell is outside its bounds");
    }
  };
  expect_damaged({5, 7, 0});
  expect_damaged({4, 8, 0});
  expect_damaged({-4, 7, 0});
  expect_damaged({4, -3, 0});
  expect_damaged({4, 7, -1.01});
  expect_damaged({4, 7, 2.51});
  expect_damaged({4, 7, std::numeric_limits<double>::quiet_NaN()});
  replace_cells(bytes, cells());
  LowestPoints lowest{GroundSlopeOptions()};
  GroundFile(path_).read(all_, lowest);
  EXPECT_EQ(lowest.size(), 3U);
}

TEST_F(GroundFiles, ThatCannotBeOpenedAreNamedSo) {
  const LowestPoints lowest{GroundSlopeOptions()};
  try {
    write_ground_file("/proc/nothing/g", FileLife::temporary, {}, lowest);
    ADD_FAILURE();
  } catch (const IoError& error) {
    EXPECT_STREQ(error.what(), "cannot be opened for writing");
  }
}

}  // namespace
}  // namespace pcl_bv::detail
