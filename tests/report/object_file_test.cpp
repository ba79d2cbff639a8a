// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/object_file.h"

#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <cstring>
#include <fstream>
#include <limits>

#include "pcl_bv/io/raw_cloud.h"
#include "temporary_folder.h"

namespace pcl_bv::detail {
namespace {

using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

// A file of a share that has the ground, with right check sums. All points are noise.
class ObjectFiles : public testing::Test {
 protected:
  void write(const Ranges& shares, std::size_t ground_bytes, std::uint64_t points) const {
    PartialFile cloud;
    cloud.add_input("a.pcd", std::numeric_limits<std::size_t>::max());
    cloud.shares = shares;
    ShareRun run;
    run.points = points;
    run.component = ShareRun::kNoise;
    const std::string records(points * share_record_bytes(ScalarType::float32), '\0'),
        ground(ground_bytes, '\0'),
        cloud_text = partial_file_content(cloud),
        header = R"({"scalar":"float32","nonfinite":0,"clusters":"c","volumes":"v","dropped_class":0,)"
                 R"("ground_points":0,"ground_parts_sum":1})"
                 "\n";
    ObjectFilePreamble preamble{
        {}, records.size(), ground.size(), header.size(), cloud_text.size(), points > 0, 0};
    std::strcpy(preamble.format, "pcl_bv objects 1\n");
    const std::string first(reinterpret_cast<const char*>(&preamble), sizeof preamble);
    std::string index = header + cloud_text;
    if (points > 0) index.append(reinterpret_cast<const char*>(&run), sizeof run);
    index.append(sizeof(ObjectText), '\0');
    boost::crc_32_type sum;
    sum.process_bytes(first.data(), first.size());
    sum.process_bytes(index.data(), index.size());
    const std::uint32_t value = sum.checksum();
    index.append(reinterpret_cast<const char*>(&value), sizeof value);
    std::ofstream(path_, std::ios::binary) << first << records << ground << index;
  }

  void expect_wrong() const {
    try {
      open_object_file(path_);
      ADD_FAILURE();
    } catch (const IoError& error) {
      EXPECT_STREQ(error.what(), "its index is wrong");
    }
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "file";
};

TEST_F(ObjectFiles, HaveABitOfTheGroundForEachPointOfTheirShare) {
  write({{6, 14}}, 1 + 4, 3);
  EXPECT_EQ(open_object_file(path_).size(), 1U);
  write({{6, 14}}, 2 + 4, 3);
  expect_wrong();
  write({{6, 15}}, 1 + 4, 3);
  expect_wrong();
}

TEST_F(ObjectFiles, WithGroundHaveOneRangeOfPoints) {
  write({{0, 4}, {6, 8}}, 1 + 4, 3);
  expect_wrong();
}

TEST_F(ObjectFiles, WithGroundHaveNoMorePointsThanTheirRange) {
  write({{0, 3}}, 1 + 4, 3);
  EXPECT_EQ(open_object_file(path_).size(), 1U);
  write({{0, 2}}, 1 + 4, 3);
  expect_wrong();
}

TEST_F(ObjectFiles, OfGroundWhoseSizeWouldOverflowAreWrong) {
  write({{0, std::numeric_limits<std::size_t>::max()}}, 0, 3);
  expect_wrong();
}

}  // namespace
}  // namespace pcl_bv::detail
