// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Coordinates as exporters write them: integers, types that differ, names in upper case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "files.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/io/cloud_file.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

/// The type of one coordinate.
struct Type {
  char letter;
  std::uint32_t size;
};

const std::vector<Type> kTypes = {{'I', 1}, {'U', 1}, {'I', 2}, {'U', 2}, {'I', 4},
                                  {'U', 4}, {'I', 8}, {'U', 8}, {'F', 4}, {'F', 8}};

template <typename T>
void put(T value, std::byte* to) {
  std::memcpy(to, &value, sizeof value);
}

void put_number(double value, const PointField& field, std::byte* to) {
  if (field.type == 'F') return field.size == 4 ? put(static_cast<float>(value), to) : put(value, to);
  const auto whole =
      static_cast<std::int64_t>(value);  // little-endian: its low bytes are the smaller integer
  std::memcpy(to, &whole, field.size);
}

/// Points (i % 100, 2, 3) with a field `tag` between y and z.
RawCloud cloud_of(const std::array<Type, 3>& types, std::size_t points = 4, bool upper = false) {
  RawCloud cloud;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == 2) cloud.fields.push_back({"tag", 'U', 1});
    cloud.fields.push_back(
        {std::string(1, (upper ? "XYZ" : "xyz")[axis]), types[axis].letter, types[axis].size});
  }
  for (PointField& field : cloud.fields) {
    field.offset = cloud.point_step;
    cloud.point_step += field.bytes();
  }
  cloud.width = points;
  cloud.data.resize(points * cloud.point_step);
  for (std::size_t i = 0; i < points; ++i) {
    std::byte* const record = cloud.data.data() + i * cloud.point_step;
    const double values[] = {static_cast<double>(i % 100), 2, 7, 3};
    for (std::size_t f = 0; f < 4; ++f)
      put_number(values[f], cloud.fields[f], record + cloud.fields[f].offset);
  }
  return cloud;
}

void expect_points(const PointView& view, std::size_t points, const std::string& where) {
  ASSERT_EQ(view.count, points) << where;
  const LoadedPoints loaded(view, 0, points);
  for (std::size_t i = 0; i < points; ++i) {
    const Coordinates p = load_point(loaded.view(), i);
    ASSERT_TRUE(p.x == static_cast<double>(i % 100) && p.y == 2 && p.z == 3) << where << ", point " << i;
  }
}

std::string ply_text(const RawCloud& cloud, const std::string& format) {
  const std::map<std::string, std::string> names = {{"I1", "char"},   {"U1", "uchar"}, {"I2", "short"},
                                                    {"U2", "ushort"}, {"I4", "int"},   {"U4", "uint"},
                                                    {"F4", "float"},  {"F8", "double"}};
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(cloud.size()) + "\n";
  for (const PointField& field : cloud.fields)
    text += "property " + names.at(field.type + std::to_string(field.size)) + " " + field.name + "\n";
  text += "end_header\n";
  if (format != "ascii")
    return text.append(reinterpret_cast<const char*>(cloud.data.data()), cloud.data.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    text += std::to_string(i) + " 2 7 3\n";
  return text;
}

class CoordinateTypes : public FileTest {};

TEST_F(CoordinateTypes, OfEveryKindAndMixtureAreReadFromEveryEncodingOfPcd) {
  for (const Type& x : kTypes) {
    for (const Type& z : kTypes) {
      const RawCloud cloud = cloud_of({x, x, z});
      for (const auto encoding : {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed}) {
        write_pcd(file("a.pcd"), cloud, encoding);
        const std::string where = std::string{x.letter, z.letter} + std::to_string(10 * x.size + z.size);
        const RawCloud read = read_cloud(file("a.pcd"));
        expect_points(read.xyz(), 4, where);
        expect_same_cloud(read, cloud);  // fields stay as they are
        EXPECT_EQ(read_cloud_header(file("a.pcd")).scalar, read.xyz().scalar) << where;
      }
    }
  }
}

TEST_F(CoordinateTypes, OfEveryKindAndMixtureAreReadFromPly) {
  for (const Type& x : kTypes) {
    for (const Type& z : kTypes) {
      if (x.size + z.size > 8 && (x.letter != 'F' || z.letter != 'F')) continue;  // no integers of 8 bytes
      const RawCloud cloud = cloud_of({x, x, z});
      for (const char* format : {"ascii", "binary_little_endian"}) {
        write_text(file("a.ply"), ply_text(cloud, format));
        expect_points(read_cloud(file("a.ply")).xyz(), 4, format);
      }
    }
  }
}

TEST_F(CoordinateTypes, BecomeFloatsOnlyWhereThatChangesNoValue) {
  const auto scalar = [&](Type x, Type y, Type z) { return cloud_of({x, y, z}).xyz().scalar; };
  const auto read = [&](Type x, Type y, Type z) {
    write_pcd(file("a.pcd"), cloud_of({x, y, z}));
    return read_cloud(file("a.pcd")).xyz().scalar;
  };
  EXPECT_EQ(read({'I', 2}, {'U', 1}, {'F', 4}), ScalarType::float32);
  EXPECT_EQ(read({'I', 2}, {'I', 4}, {'I', 2}), ScalarType::float64);
  EXPECT_EQ(read({'F', 8}, {'F', 8}, {'F', 4}), ScalarType::float64);
  EXPECT_EQ(scalar({'F', 4}, {'F', 4}, {'F', 4}), ScalarType::float32);
}

TEST_F(CoordinateTypes, ThatAreIntegersBeyondDoublesAreRefused) {
  for (const char letter : {'I', 'U'}) {
    RawCloud cloud = cloud_of({{{letter, 8}, {letter, 8}, {letter, 8}}});
    put(std::int64_t{1} << 53, cloud.data.data());
    write_pcd(file("a.pcd"), cloud);
    EXPECT_EQ(read_cloud(file("a.pcd")).xyz().count, 4U);
    put((std::int64_t{1} << 53) + 1, cloud.data.data());
    write_pcd(file("a.pcd"), cloud);
    EXPECT_EQ(reason_for(file("a.pcd")),
              "the coordinate 9007199254740993 is too large: integers may be at most 2^53 in magnitude");
  }
}

TEST_F(CoordinateTypes, AreTheSameFromAFileReadInParts) {
  for (const std::array<Type, 3>& types : {std::array<Type, 3>{{{'I', 2}, {'I', 2}, {'I', 2}}},
                                           {{{'F', 8}, {'F', 8}, {'F', 4}}},
                                           {{{'I', 4}, {'U', 1}, {'F', 4}}}}) {
    const std::size_t points = kChunkPoints + 10;
    write_pcd(file("a.pcd"), cloud_of(types, points, true));
    const auto opened = CloudFile::open(file("a.pcd"));
    ASSERT_NE(opened, nullptr);
    const RawCloud held = read_cloud(file("a.pcd"));
    EXPECT_EQ(opened->xyz().scalar, held.xyz().scalar);
    expect_points(held.xyz(), points, "held");
    const LoadedPoints part(opened->xyz(), 0, kChunkPoints);
    expect_points(part.view(), kChunkPoints, "in parts");
  }
}

TEST_F(CoordinateTypes, MayBeCalledInUpperCase) {
  const RawCloud cloud = cloud_of({{{'F', 4}, {'F', 4}, {'F', 4}}}, 4, true);
  for (const auto encoding : {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed}) {
    write_pcd(file("a.pcd"), cloud, encoding);
    RawCloud read = read_cloud(file("a.pcd"));
    expect_points(read.xyz(), 4, "upper");
    EXPECT_THROW(set_uint32_field(read, "X", {1, 2, 3, 4}), std::invalid_argument);
    set_uint32_field(read, "label", {1, 2, 3, 4});
    expect_points(read.xyz(), 4, "labelled");
  }
  write_text(file("a.ply"), ply_text(cloud, "ascii"));
  expect_points(read_cloud(file("a.ply")).xyz(), 4, "upper");
}

TEST_F(CoordinateTypes, InLowerCaseComeFirst) {
  const std::string start = "FIELDS X x y Y z\nSIZE 4 4 4 4 4\nTYPE F F F F F\nWIDTH 1\nDATA ascii\n";
  write_text(file("a.pcd"), start + "9 0 2 8 3\n");
  expect_points(read_cloud(file("a.pcd")).xyz(), 1, "both");
  EXPECT_EQ(reason_for_content("FIELDS X X y z\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 1\nDATA ascii\n1 2 3 4\n"),
            "field X occurs twice");
  EXPECT_EQ(reason_for_content("FIELDS X y\nSIZE 4 4\nTYPE F F\nWIDTH 1\nDATA ascii\n1 2\n"), "no field z");
}

TEST_F(CoordinateTypes, ThatAreNoNumbersAreRefused) {
  const std::string start = "FIELDS x y z\nSIZE 2 2 2\nTYPE I I I\nWIDTH 1\nDATA ascii\n";
  EXPECT_THAT(reason_for_content(start + "1 2 nan\n"), HasSubstr("'nan' is not a number of TYPE I, SIZE 2"));
  EXPECT_THAT(reason_for_content(start + "1 2 40000\n"),
              HasSubstr("'40000' is not a number of TYPE I, SIZE 2"));
  EXPECT_THAT(reason_for_content("FIELDS x y z\nSIZE 4 4 4\nTYPE U U U\nWIDTH 1\nDATA ascii\n1 2 -1\n"),
              HasSubstr("'-1' is not a number of TYPE U, SIZE 4"));
  EXPECT_THAT(reason_for_content("FIELDS x y z\nSIZE 2 2 2\nTYPE F F F\nWIDTH 1\nDATA binary\n123456"),
              HasSubstr("field x of TYPE F, SIZE 2, COUNT 1 is not supported, only integers"));
}

}  // namespace
}  // namespace pcl_bv::detail
