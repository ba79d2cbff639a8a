// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/las.h"

#include <gtest/gtest.h>

#include <cstring>

#include "files.h"
#include "las_bytes.h"
#include "pcl_bv/io/cloud_file.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

class Las : public FileTest {
 protected:
  std::string reason(const LasFile& las) const { return reason_for_content(las.bytes(), ".las"); }

  template <typename T>
  static T value(const RawCloud& cloud, std::string_view name, std::size_t i) {
    const PointField* field = find_field(cloud, name);
    if (field == nullptr || field->size != sizeof(T)) {
      ADD_FAILURE() << name;
      return {};
    }
    T value;
    std::memcpy(&value, cloud.data.data() + i * cloud.point_step + field->offset, sizeof value);
    return value;
  }
};

TEST_F(Las, OfEachVersionAndFormatIsReadExactly) {
  for (const int minor : {0, 1, 2, 3, 4, 5}) {
    for (int format = 0; format <= (minor < 3 ? 3 : minor == 3 ? 5 : 10); ++format) {
      const std::string where = "1." + std::to_string(minor) + ", format " + std::to_string(format);
      const std::size_t extra = format % 2 == 0 ? 0 : 7;  // bytes of the user's own
      const LasFile las{minor, format, kRecords[format] + extra, 5000};
      write_text(file("a.las"), las.bytes());
      const RawCloud cloud = read_cloud(file("a.las"));
      ASSERT_EQ(cloud.size(), 5000U) << where;
      EXPECT_EQ(cloud.xyz().scalar, ScalarType::float64);
      for (const std::size_t i : {0UL, 1UL, 4095UL, 4096UL, 4999UL}) {
        const Coordinates p = load_point(cloud.xyz(), i);
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_EQ(p[axis], LasFile::stored(i, axis) * 0.001 + las.offset[axis]) << where << ", " << i;
        EXPECT_EQ(value<std::uint16_t>(cloud, "intensity", i), static_cast<std::uint16_t>(1000 + i)) << where;
        if (find_field(cloud, "gps_time") != nullptr) {
          EXPECT_EQ(value<double>(cloud, "gps_time", i), 0.5 + static_cast<double>(i)) << where;
        }
        if (find_field(cloud, "red") != nullptr) {
          EXPECT_EQ(value<std::uint16_t>(cloud, "red", i), static_cast<std::uint16_t>(77 + i)) << where;
        }
      }
      EXPECT_EQ(find_field(cloud, "gps_time") != nullptr, format != 0 && format != 2) << where;
      const bool colored =
          format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
      EXPECT_EQ(find_field(cloud, "red") != nullptr, colored) << where;
    }
  }
}

// LAS 1.4 R15, tables 8, 9 and 16: each bit of each byte.
TEST_F(Las, PackedBitsAreFieldsOfTheirOwn) {
  struct Bits {
    const char* name;
    std::size_t divisor;  // of the number of the point: which byte it is
    unsigned shift, bits;
  };
  const std::vector<Bits> narrow = {{"return_number", 1, 0, 3},       {"number_of_returns", 1, 3, 3},
                                    {"scan_direction_flag", 1, 6, 1}, {"edge_of_flight_line", 1, 7, 1},
                                    {"classification", 2, 0, 5},      {"synthetic", 2, 5, 1},
                                    {"key_point", 2, 6, 1},           {"withheld", 2, 7, 1}};
  const std::vector<Bits> wide = {{"return_number", 1, 0, 4},
                                  {"number_of_returns", 1, 4, 4},
                                  {"synthetic", 2, 0, 1},
                                  {"key_point", 2, 1, 1},
                                  {"withheld", 2, 2, 1},
                                  {"overlap", 2, 3, 1},
                                  {"scanner_channel", 2, 4, 2},
                                  {"scan_direction_flag", 2, 6, 1},
                                  {"edge_of_flight_line", 2, 7, 1},
                                  {"classification", 3, 0, 8}};
  for (int format = 0; format <= 10; ++format) {
    write_text(file("a.las"), LasFile{4, format, kRecords[format], 800}.bytes());
    const RawCloud cloud = read_cloud(file("a.las"));
    for (const Bits& packed : format < 6 ? narrow : wide) {
      for (std::size_t i = 0; i < 800; ++i)
        ASSERT_EQ(value<std::uint8_t>(cloud, packed.name, i),
                  (i / packed.divisor % 256 >> packed.shift) % (1U << packed.bits))
            << packed.name << ", format " << format << ", point " << i;
    }
    EXPECT_EQ(find_field(cloud, "overlap") != nullptr, format >= 6);
    EXPECT_EQ(find_field(cloud, "returns"), nullptr);
  }
}

TEST_F(Las, CompressedWithoutLaszipIsRefusedWithWhatToDo) {
  std::string bytes = LasFile().bytes();
  bytes[104] = static_cast<char>(0x80);
  const std::string expected = reads_laz()
                                   ? "header: the points are compressed, but the record of LASzip is missing"
                                   : "compressed (LAZ) points: this build has no LASzip (Debian 13: "
                                     "liblaszip-dev). Decompress the file "
                                     "with laszip or pdal first";
  EXPECT_EQ(reason_for_content(bytes, ".laz"), expected);
  EXPECT_EQ(reason_for_content(bytes, ".las"), expected);
}

TEST_F(Las, CompressedIsTestedWhereTheBuildHasLaszip) {
  if (!reads_laz()) GTEST_SKIP() << "this build has no LASzip (liblaszip-dev): test_laz is left out";
}

TEST_F(Las, ThatContradictsItselfIsRefused) {
  EXPECT_EQ(reason_for_content("LASX" + std::string(400, '\0'), ".las"),
            "not a .las file: it does not begin with LASF");
  EXPECT_EQ(reason({.minor = 6}), "header: version 1.6 is not one of 1.0 to 1.5");
  std::string bytes = LasFile().bytes();
  bytes[104] = 11;
  EXPECT_EQ(reason_for_content(bytes, ".las"), "header: point format 11 is not one of 0 to 10");
  EXPECT_EQ(
      reason({.format = 3, .record = 33}),
      "header: record size 33 is too small for the point format, or the point data offset 281 is inside "
      "the header");
  EXPECT_EQ(reason({.scale = 0}), "header: a scale is 0 or not finite, or an offset is not finite");
}

TEST_F(Las, CutAnywhereIsRefused) {
  const std::string whole = LasFile{.minor = 4, .format = 7, .record = 36}.bytes();
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(reason_for_content(whole.substr(0, size), ".las"), "") << size;
  EXPECT_EQ(reason_for_content(whole, ".las"), "");
}

TEST_F(Las, OfNoPointsIsAnEmptyCloud) {
  write_text(file("a.las"), LasFile{.points = 0}.bytes());
  EXPECT_EQ(read_las(file("a.las")).size(), 0U);
  EXPECT_EQ(CloudFile::open(file("a.las")), nullptr);
}

}  // namespace
}  // namespace pcl_bv::detail
