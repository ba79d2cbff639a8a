// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/report/partial_file.h"

#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

std::vector<float> points(std::size_t count) {
  std::vector<float> xyz;
  for (std::size_t i = 0; i < 3 * count; ++i)
    xyz.push_back(static_cast<float>(i * i % 1009));
  return xyz;
}

PartialFile share(const std::vector<float>& xyz, std::size_t first, std::size_t end) {
  PartialFile file;
  file.add_input("a.pcd", xyz.size() / 3);
  file.shares = {{first, end}};
  file.partial = Partial(PointView::of(xyz.data(), 12, xyz.size() / 3).slice(first, end - first));
  return file;
}

TEST(PartialFile, ReadsBackAsItWas) {
  const std::vector<float> xyz = points(6000);
  PartialFile file = share(xyz, 1000, 5900);
  file.origin = Eigen::Vector3d(0.1, -1e300, 3);
  file.filter = "0:inf";
  file.counts.range = 7;
  file.counts.inside = 8;
  const std::string content = partial_file_content(file);
  const PartialFile read = parse_partial_file(content);
  EXPECT_EQ(read.origin, file.origin);
  EXPECT_EQ(read.shares, file.shares);
  EXPECT_EQ(read.counts.inside, 8U);
  EXPECT_TRUE(partial_file_content(read) == content);
}

TEST(PartialFile, MergesToTheSameContentInAnyOrder) {
  const std::vector<float> xyz = points(9000);
  const std::string expected = partial_file_content(share(xyz, 0, 9000));
  for (const bool turned : {false, true}) {
    PartialFile a = share(xyz, 0, 2000), b = share(xyz, 2000, 7000), c = share(xyz, 7000, 9000);
    EXPECT_EQ(b.missing(), "points 0 to 2000, 7000 to 9000 of 9000");
    PartialFile& all = turned ? c : a;
    all.merge(turned ? a : c);
    EXPECT_FALSE(all.is_whole());
    EXPECT_EQ(all.missing(), "points 2000 to 7000 of 9000");
    all.merge(b);
    EXPECT_TRUE(all.is_whole());
    EXPECT_TRUE(partial_file_content(all) == expected);
  }
}

TEST(PartialFile, KeepsWhatItHadWhenItRefuses) {
  const std::vector<float> xyz = points(9000);
  PartialFile file = share(xyz, 0, 5000);
  const std::string before = partial_file_content(file);
  PartialFile other = share(xyz, 5000, 9000);
  other.add_input("b.pcd", 0);
  EXPECT_THROW(file.merge(other), std::invalid_argument);
  EXPECT_THROW(file.merge(share(xyz, 4999, 9000)), std::invalid_argument);
  PartialFile moved = share(xyz, 5000, 9000);
  moved.origin = Eigen::Vector3d::Zero();
  EXPECT_THROW(file.merge(moved), std::invalid_argument);
  EXPECT_TRUE(partial_file_content(file) == before);
}

TEST(PartialFile, IsRefusedIfAnyByteIsWrongOrMissing) {
  const std::vector<float> xyz = points(100);
  const std::string good = partial_file_content(share(xyz, 0, 100));
  for (std::size_t i = 0; i < good.size(); i += 1 + i / 100) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    EXPECT_THROW(parse_partial_file(bad), IoError) << i;
    EXPECT_THROW(parse_partial_file(good.substr(0, i)), IoError) << i;
  }
}

// With a right check sum: what a fuzzer found, and its like.
TEST(PartialFile, IsRefusedIfItsHeaderHasInvalidNumbers) {
  const std::vector<float> xyz = points(100);
  const std::string good = partial_file_content(share(xyz, 0, 100));
  const std::string number = "\"cloud_points\":100";
  ASSERT_NE(good.find(number), std::string::npos);
  for (const char* bad : {"5e37", "-1", "1.5", "\"100\"", "null", "99999999999999999999999"}) {
    std::string content = good.substr(0, good.size() - 4);
    content.replace(content.find(number), number.size(), std::string("\"cloud_points\":") + bad);
    boost::crc_32_type sum;
    sum.process_bytes(content.data(), content.size());
    const std::uint32_t value = sum.checksum();
    content.append(reinterpret_cast<const char*>(&value), sizeof value);
    try {
      parse_partial_file(content);
      ADD_FAILURE() << bad;
    } catch (const IoError& error) {
      EXPECT_STREQ(error.what(), "invalid header: a non-negative integer is expected") << bad;
    }
  }
}

TEST(PartialFile, TellsInputsApartByNamePointsAndOrder) {
  const auto hash = [](std::initializer_list<std::pair<const char*, std::size_t>> inputs) {
    PartialFile file;
    for (const auto& [name, count] : inputs)
      file.add_input(name, count);
    return file.inputs_hash;
  };
  EXPECT_EQ(hash({{"a", 1}, {"b", 2}}), hash({{"a", 1}, {"b", 2}}));
  EXPECT_NE(hash({{"a", 1}, {"b", 2}}), hash({{"b", 2}, {"a", 1}}));
  EXPECT_NE(hash({{"a", 1}, {"b", 2}}), hash({{"a", 2}, {"b", 1}}));
  EXPECT_NE(hash({{"a", 1}}), hash({{"c", 1}}));
}

PartialFile independent(const char* name, std::size_t count) {
  const std::vector<float> xyz = points(count);
  PartialFile file;
  file.add_input(name, count);
  if (count > 0) file.shares = {{0, count}};
  file.partial = Partial(PointView::of(xyz.data(), 12, count));
  return file;
}

TEST(MergedClouds, DependOnTheirSharesOnly) {
  const std::vector<PartialFile> files = {independent("t2.pcd", 5000), independent("t10.pcd", 0),
                                          independent("t1.pcd", 300), independent("t2.pcd", 100)};
  std::string expected;
  for (std::size_t first = 0; first < files.size(); ++first) {
    MergedClouds all;
    for (std::size_t i = 0; i < files.size(); ++i)
      all.add(files[(first + i) % files.size()]);
    EXPECT_EQ(all.points_before(files[2]), 0U);
    EXPECT_EQ(all.points_before(files[3]), 300U);
    EXPECT_EQ(all.points_before(files[0]), 400U);
    EXPECT_EQ(all.points_before(files[1]), 5400U);
    EXPECT_EQ(all.joined().cloud_points, 5400U);
    EXPECT_EQ(all.joined().partial.size(), 5400U);
    const std::string content = merged_clouds_content(all);
    EXPECT_TRUE(first == 0 || content == expected) << first;
    EXPECT_TRUE(merged_clouds_content(parse_merged_clouds(content)) == content) << first;
    expected = content;
    EXPECT_THROW(all.add(files[0]), std::invalid_argument);
    EXPECT_TRUE(merged_clouds_content(all) == content) << first;
  }
}

TEST(MergedClouds, AreRefusedIfAnyByteIsWrongOrMissing) {
  MergedClouds all;
  for (const char* const name : {"a.pcd", "b.pcd"})
    all.add(independent(name, 50));
  const std::string good = merged_clouds_content(all);
  for (std::size_t i = 0; i < good.size(); i += 1 + i / 100) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    EXPECT_THROW(parse_merged_clouds(bad), IoError) << i;
    EXPECT_THROW(parse_merged_clouds(good.substr(0, i)), IoError) << i;
  }
  EXPECT_THROW(parse_merged_clouds(good + " "), IoError);
  EXPECT_THROW(parse_merged_clouds("pcl_bv partial results 2\n{\"lengths\":[]}\n"), IoError);
  EXPECT_THROW(parse_merged_clouds("pcl_bv partial results 2\n[]\n"), IoError);
}

// As files of earlier versions.
TEST(MergedClouds, WithoutNamesAreSortedAndMerge) {
  const std::vector<float> xyz = points(9000);
  PartialFile old = share(xyz, 0, 5000);
  old.first_input.clear();
  MergedClouds all;
  all.add(old);
  all.add(independent("0.pcd", 10));
  all.add(share(xyz, 5000, 9000));
  all.require_whole();
  ASSERT_EQ(all.clouds().size(), 2U);
  EXPECT_EQ(all.clouds()[0].first_input, "0.pcd");
  EXPECT_EQ(all.clouds()[1].first_input, "a.pcd");
}

}  // namespace
}  // namespace pcl_bv::detail
