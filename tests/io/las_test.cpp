// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/las.h"

#include <gtest/gtest.h>

#include <cstring>

#include "files.h"
#include "pcl_bv/io/cloud_file.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv {
namespace {

// A file written by the tables of the specification (LAS 1.4 R15).
struct LasFile {
  int minor = 2;
  int format = 0;
  std::size_t record = 20;
  std::size_t points = 3;
  double scale = 0.001;
  std::array<double, 3> offset{500'000, 5'400'000, 100};

  template <typename T>
  static void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  }

  static std::int32_t stored(std::size_t i, std::size_t axis) {
    return static_cast<std::int32_t>(1'000'003 * (i + 1) * (axis + 1)) * (i % 2 == 0 ? 1 : -1);
  }

  std::string bytes() const {
    const std::size_t header = minor == 4 ? 375 : minor == 3 ? 235 : 227;
    std::string all(header + 54 + points * record, '\0');
    std::memcpy(all.data(), "LASF", 4);
    put<std::uint8_t>(all, 24, 1);
    put<std::uint8_t>(all, 25, static_cast<std::uint8_t>(minor));
    put<std::uint16_t>(all, 94, static_cast<std::uint16_t>(header));
    put<std::uint32_t>(all, 96, static_cast<std::uint32_t>(header + 54));
    put<std::uint32_t>(all, 100, 1);
    put<std::uint8_t>(all, 104, static_cast<std::uint8_t>(format));
    put<std::uint16_t>(all, 105, static_cast<std::uint16_t>(record));
    if (format < 6) put<std::uint32_t>(all, 107, static_cast<std::uint32_t>(points));
    if (minor == 4) put<std::uint64_t>(all, 247, points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put(all, 131 + 8 * axis, scale);
      put(all, 155 + 8 * axis, offset[axis]);
    }
    for (std::size_t i = 0; i < points; ++i) {
      const std::size_t at = header + 54 + i * record;
      for (std::size_t axis = 0; axis < 3; ++axis)
        put(all, at + 4 * axis, stored(i, axis));
      put<std::uint16_t>(all, at + 12, static_cast<std::uint16_t>(1000 + i));
      put<std::uint8_t>(all, at + (format < 6 ? 15 : 16), static_cast<std::uint8_t>(2 + i % 4));
      if (format == 1 || (format >= 3 && format <= 5)) put(all, at + 20, 0.5 + static_cast<double>(i));
      if (format >= 6) put(all, at + 22, 0.5 + static_cast<double>(i));
      const std::size_t red[] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
      if (red[format] != 0) put<std::uint16_t>(all, at + red[format], static_cast<std::uint16_t>(77 + i));
    }
    return all;
  }
};

constexpr std::size_t kRecords[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

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
  for (const int minor : {2, 3, 4}) {
    for (int format = 0; format <= (minor == 2 ? 3 : minor == 3 ? 5 : 10); ++format) {
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
        EXPECT_EQ(value<std::uint8_t>(cloud, "classification", i), 2 + i % 4) << where;
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

TEST_F(Las, CompressedIsRefusedWithWhatToDo) {
  std::string bytes = LasFile().bytes();
  bytes[104] = static_cast<char>(0x80);
  const std::string expected =
      "compressed (LAZ) points cannot be read; unpack them first, with laszip or pdal";
  EXPECT_EQ(reason_for_content(bytes, ".laz"), expected);
  EXPECT_EQ(reason_for_content(bytes, ".las"), expected);
}

TEST_F(Las, ThatContradictsItselfIsRefused) {
  EXPECT_EQ(reason_for_content("LASX" + std::string(400, '\0'), ".las"),
            "not a .las file: it does not begin with LASF");
  EXPECT_EQ(reason({.minor = 1}), "header: version 1.1 is not one of 1.2 to 1.4");
  std::string bytes = LasFile().bytes();
  bytes[104] = 11;
  EXPECT_EQ(reason_for_content(bytes, ".las"), "header: point format 11 is not one of 0 to 10");
  EXPECT_EQ(reason({.format = 3, .record = 33}),
            "header: records of 33 bytes from byte 281 on are too short or in the header");
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
}  // namespace pcl_bv
