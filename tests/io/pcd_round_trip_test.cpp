// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What write_pcd() writes, read_pcd() reads back, for every layout and encoding.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "files.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

const PcdEncoding encodings[] = {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed};

class PcdRoundTrip : public FileTest {
 protected:
  RawCloud round_trip(const RawCloud& cloud, PcdEncoding encoding) const {
    write_pcd(file("a.pcd"), cloud, encoding);
    return read_pcd(file("a.pcd"));
  }
};

TEST_F(PcdRoundTrip, KeepsEveryLayoutInEveryEncoding) {
  for (const Layout& layout : sample_layouts()) {
    for (const PcdEncoding encoding : encodings) {
      SCOPED_TRACE(layout.name + ", encoding " + std::to_string(static_cast<int>(encoding)));
      const RawCloud cloud = sample_cloud(layout, 25, 4, 7);
      expect_same_cloud(round_trip(cloud, encoding), cloud, encoding != PcdEncoding::binary_compressed);
    }
  }
}

TEST_F(PcdRoundTrip, BinaryKeepsEveryBitOfNanPayloadsAndPadding) {
  for (const Layout& layout : sample_layouts()) {
    SCOPED_TRACE(layout.name);
    RawCloud cloud = sample_cloud(layout, 64, 1, 3);
    std::uint32_t state = 1;
    for (std::byte& byte : cloud.data)
      byte = static_cast<std::byte>((state = state * 1664525 + 1013904223) >> 24);
    EXPECT_EQ(round_trip(cloud, PcdEncoding::binary).data, cloud.data);
  }
}

TEST_F(PcdRoundTrip, CompressedKeepsEveryBitOfNanPayloads) {
  RawCloud cloud = sample_cloud(sample_layouts()[3], 1000, 1, 3);
  std::uint32_t state = 1;
  for (std::byte& byte : cloud.data)
    byte = static_cast<std::byte>((state = state * 1664525 + 1013904223) >> 24);
  EXPECT_EQ(round_trip(cloud, PcdEncoding::binary_compressed).data, cloud.data);
}

TEST_F(PcdRoundTrip, CompressedShrinksWhatRepeats) {
  const RawCloud cloud = make_cloud(std::vector<float>(300000, 1.0f));
  expect_same_cloud(round_trip(cloud, PcdEncoding::binary_compressed), cloud);
  EXPECT_LT(std::filesystem::file_size(file("a.pcd")), cloud.data.size() / 50);
}

TEST_F(PcdRoundTrip, AnEmptyCloudStaysEmpty) {
  for (const PcdEncoding encoding : encodings) {
    const RawCloud cloud = round_trip(make_cloud({}), encoding);
    EXPECT_EQ(cloud.size(), 0u);
    EXPECT_EQ(cloud.fields.size(), 3u);
    EXPECT_TRUE(cloud.xyz().empty());
  }
}

TEST_F(PcdRoundTrip, OnePointOfOneFieldMoreThanCoordinates) {
  for (const PcdEncoding encoding : encodings) {
    RawCloud cloud = make_cloud({1.0f, -2.0f, 3.5f});
    set_uint32_field(cloud, "label", {4294967295u});
    expect_same_cloud(round_trip(cloud, encoding), cloud);
  }
}

TEST_F(PcdRoundTrip, AsciiKeepsEveryFloatToTheBit) {
  std::vector<float> values = {0.0f,
                               -0.0f,
                               1e-45f,
                               -1e-45f,
                               1.17549435e-38f,
                               1e-40f,
                               3.4028235e38f,
                               -3.4028235e38f,
                               0.1f,
                               1.0f / 3,
                               std::numeric_limits<float>::infinity(),
                               -std::numeric_limits<float>::infinity()};
  std::uint32_t bits = 12345;
  while (values.size() < 30000) {
    bits = bits * 1664525 + 1013904223;
    const float value = std::bit_cast<float>(bits);
    if (!std::isnan(value)) values.push_back(value);
  }
  const RawCloud cloud = make_cloud(values);
  EXPECT_EQ(round_trip(cloud, PcdEncoding::ascii).data, cloud.data);
}

TEST_F(PcdRoundTrip, AsciiWritesNanWithoutASign) {
  write_pcd(file("a.pcd"), make_cloud({-std::numeric_limits<float>::quiet_NaN(), 1.5f, 1e20f}),
            PcdEncoding::ascii);
  EXPECT_THAT(file_content(file("a.pcd")), testing::EndsWith("DATA ascii\nnan 1.5 1e+20\n"));
}

TEST_F(PcdRoundTrip, TheHeaderIsThatOfTheFormat) {
  RawCloud cloud = sample_cloud({"", {{"x"}, {"y"}, {"z"}, {"_", 'U', 1, 4}, {"ring", 'U', 2, 3}}}, 2, 3, 1);
  write_pcd(file("a.pcd"), cloud);
  EXPECT_THAT(file_content(file("a.pcd")), testing::StartsWith("# .PCD v0.7 - Point Cloud Data file format\n"
                                                               "VERSION 0.7\n"
                                                               "FIELDS x y z _ ring\n"
                                                               "SIZE 4 4 4 1 2\n"
                                                               "TYPE F F F U U\n"
                                                               "COUNT 1 1 1 4 3\n"
                                                               "WIDTH 2\n"
                                                               "HEIGHT 3\n"
                                                               "VIEWPOINT 1.5 -2.25 0.001 0.5 -0.5 0.5 0.1\n"
                                                               "POINTS 6\n"
                                                               "DATA binary\n"));
  EXPECT_EQ(file_content(file("a.pcd")).size() - file_content(file("a.pcd")).find("DATA binary\n") - 12,
            6 * 22u);
}

class BrokenCloud : public FileTest {
 protected:
  std::string reason(const RawCloud& cloud) const {
    try {
      write_pcd(file("a.pcd"), cloud);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
  RawCloud cloud_ = make_cloud({1, 2, 3});
};

TEST_F(BrokenCloud, IsNotWrittenWithoutFields) {
  EXPECT_THAT(reason({}), HasSubstr("must have fields"));
  EXPECT_FALSE(std::filesystem::exists(file("a.pcd")));
}

TEST_F(BrokenCloud, IsNotWrittenWithANameOfTwoWords) {
  cloud_.fields[1].name = "y y";
  EXPECT_THAT(reason(cloud_), HasSubstr("'y y': its name must be a word"));
}

TEST_F(BrokenCloud, IsNotWrittenWithAnUnknownType) {
  cloud_.fields[1].type = 'Q';
  EXPECT_THAT(reason(cloud_), HasSubstr("type must be F, I or U"));
}

TEST_F(BrokenCloud, IsNotWrittenWithAnUnknownSize) {
  cloud_.fields[1].size = 3;
  EXPECT_THAT(reason(cloud_), HasSubstr("size 3 must be 1, 2, 4 or 8"));
}

TEST_F(BrokenCloud, IsNotWrittenWithoutElements) {
  cloud_.fields[1].count = 0;
  EXPECT_THAT(reason(cloud_), HasSubstr("count must be positive"));
}

TEST_F(BrokenCloud, IsNotWrittenWithAGap) {
  cloud_.fields[1].offset = 5;
  EXPECT_THAT(reason(cloud_), HasSubstr("offset 5 must be 4"));
}

TEST_F(BrokenCloud, IsNotWrittenWithARecordLargerThanItsFields) {
  cloud_.point_step = 16;
  EXPECT_THAT(reason(cloud_), HasSubstr("point_step 16 must be 12"));
}

TEST_F(BrokenCloud, IsNotWrittenWithPointsMissing) {
  cloud_.width = 2;
  EXPECT_THAT(reason(cloud_), HasSubstr("12 bytes of data, must be 24"));
}

TEST_F(BrokenCloud, IsNotWrittenAsciiWithHalfFloats) {
  const RawCloud cloud = sample_cloud({"", {{"x"}, {"y"}, {"z"}, {"h", 'U', 2}}}, 1, 1, 1);
  RawCloud half = cloud;
  half.fields[3].type = 'F';
  EXPECT_THROW(write_pcd(file("a.pcd"), half, PcdEncoding::ascii), IoError);
  write_pcd(file("a.pcd"), half);
  expect_same_cloud(read_pcd(file("a.pcd")), half);
}

}  // namespace
}  // namespace pcl_bv::detail
