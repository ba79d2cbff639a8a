// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// KITTI's sweeps: four floats a point, and nothing to check but the size.
#include "pcl_bv/io/kitti_bin.h"

#include <gtest/gtest.h>

#include "files.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv {
namespace {

class KittiBin : public FileTest {
 protected:
  static std::string bytes_of(const RawCloud& cloud) {
    return {reinterpret_cast<const char*>(cloud.data.data()), cloud.data.size()};
  }
};

TEST_F(KittiBin, IsReadToTheBit) {
  RawCloud expected = sample_cloud(sample_layouts()[1], 1000, 1, 9);
  expected.viewpoint = RawCloud().viewpoint;
  write_text(file("000001.bin"), bytes_of(expected));
  const RawCloud cloud = read_kitti_bin(file("000001.bin"));
  expect_same_cloud(cloud, expected);
  EXPECT_EQ(cloud.xyz().count, 1000u);
  EXPECT_EQ(cloud.xyz().data, cloud.data.data());
  write_pcd(file("a.pcd"), cloud);
  expect_same_cloud(read_cloud(file("a.pcd")), expected);
}

TEST_F(KittiBin, OfAnyOtherSizeIsTruncated) {
  const std::string whole = bytes_of(sample_cloud(sample_layouts()[1], 3, 1, 9));
  for (std::size_t size = 1; size <= whole.size(); ++size) {
    const std::string expected =
        "truncated: " + std::to_string(size) + " bytes are no multiple of the 16 of a point";
    EXPECT_EQ(reason_for_content(whole.substr(0, size), ".bin"), size % 16 == 0 ? "" : expected);
  }
}

TEST_F(KittiBin, ThatCannotBeOpenedSaysWhy) {
  EXPECT_EQ(reason_for(file("gone.bin")), "no such file or directory");
  EXPECT_EQ(reason_for_content("", ".BIN"), "empty file");
}

}  // namespace
}  // namespace pcl_bv
