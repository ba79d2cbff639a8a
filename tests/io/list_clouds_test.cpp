// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Natural order, and what counts as a cloud.
#include "pcl_bv/io/list_clouds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "files.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(NaturalOrder, CountsAsAPersonDoes) {
  const std::vector<std::string> ordered = {"",
                                            "a",
                                            "a0",
                                            "a00",
                                            "a1",
                                            "a1b",
                                            "a2",
                                            "a09",
                                            "a9",
                                            "a10",
                                            "a10b2",
                                            "a10b10",
                                            "a99999999999999999999999999999999",
                                            "a100000000000000000000000000000000",
                                            "b",
                                            "b1"};
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    for (std::size_t j = 0; j < ordered.size(); ++j) {
      const bool tie =
          (ordered[i] == "a0" && ordered[j] == "a00") || (ordered[i] == "a00" && ordered[j] == "a0");
      if (tie) continue;
      EXPECT_EQ(natural_less(ordered[i], ordered[j]), i < j) << ordered[i] << " and " << ordered[j];
    }
  }
}

TEST(NaturalOrder, TiesGoByteByByte) {
  EXPECT_TRUE(natural_less("frame01", "frame1"));
  EXPECT_FALSE(natural_less("frame1", "frame01"));
  EXPECT_TRUE(natural_less("frame01", "frame2"));
  EXPECT_TRUE(natural_less("frame0", "frame00"));
}

TEST(NaturalOrder, IsAStrictTotalOrder) {
  std::mt19937 random(42);
  std::vector<std::string> names;
  for (int i = 0; i < 60; ++i) {
    std::string name;
    for (std::size_t length = random() % 6; length > 0; --length)
      name += "019a.\xe9"[random() % 6];
    names.push_back(name);
  }
  for (const std::string& a : names) {
    for (const std::string& b : names) {
      EXPECT_EQ(natural_less(a, b) + natural_less(b, a), a == b ? 0 : 1) << a << " and " << b;
      for (const std::string& c : names) {
        if (natural_less(a, b) && natural_less(b, c)) {
          EXPECT_TRUE(natural_less(a, c)) << a << ", " << b << ", " << c;
        }
      }
    }
  }
}

using ListClouds = FileTest;

TEST_F(ListClouds, GivesCloudFilesInNaturalOrder) {
  for (const char* name :
       {"frame10.pcd", "frame2.PCD", "frame1.pcd", "note.txt", "pcd", ".hidden.pcd", ".pcd", "frame3.pcd.bak",
        "frame01.Pcd", "frame3.ply", "frame4.BIN", "frame5.vtp"}) {
    write_text(file(name), "");
  }
  for (const char* name : {"folder.pcd", "folder", ".folder"})
    std::filesystem::create_directory(file(name));
  std::size_t subfolders = 0;
  EXPECT_THAT(list_clouds(folder(), &subfolders),
              ElementsAre(file("frame01.Pcd"), file("frame1.pcd"), file("frame2.PCD"), file("frame3.ply"),
                          file("frame4.BIN"), file("frame10.pcd")));
  EXPECT_EQ(subfolders, 2U);
}

TEST_F(ListClouds, KeepsABrokenLinkSoThatReadingItGivesTheReason) {
  std::filesystem::create_symlink(file("gone"), file("a.pcd"));
  EXPECT_THAT(list_clouds(folder()), ElementsAre(file("a.pcd")));
  EXPECT_THAT(reason_for(file("a.pcd")), HasSubstr("no such file"));
}

TEST_F(ListClouds, IsEmptyForAFolderWithoutClouds) {
  EXPECT_TRUE(list_clouds(folder()).empty());
}

TEST_F(ListClouds, NamesTheReasonIfThereIsNoSuchFolder) {
  try {
    list_clouds(file("gone"));
    FAIL();
  } catch (const IoError& error) {
    EXPECT_STREQ(error.what(), "cannot list the folder: no such file or directory");
  }
}

TEST_F(ListClouds, NamesTheReasonIfItIsNoFolder) {
  write_text(file("a.pcd"), "");
  try {
    list_clouds(file("a.pcd"));
    FAIL();
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), HasSubstr("not a directory"));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
