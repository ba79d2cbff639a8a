// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points of .ply files, whatever stands around them.
#include "pcl_bv/io/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_plys.h"

namespace pcl_bv::detail {
namespace {

class Ply : public FileTest {
 protected:
  RawCloud read(std::string_view content) const {
    write_text(file("a.ply"), content);
    return read_ply(file("a.ply"));
  }

  static std::string ascii(const std::string& rows, int vertices = 2, const std::string& after = "") {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty list uchar int l\n" + after +
           "end_header\n" + rows;
  }
  std::string reason(const std::string& content) const { return reason_for_content(content, ".ply"); }
};

TEST_F(Ply, EveryLayoutInEveryStyleIsReadToTheBit) {
  for (const Layout& layout : ply_layouts()) {
    const RawCloud expected = ply_cloud(layout, 20);
    for (const PlyStyle& style : ply_styles()) {
      SCOPED_TRACE(describe(layout, style));
      const RawCloud actual = read(ply_text(expected, style));
      expect_same_cloud(actual, expected);
      EXPECT_EQ(actual.xyz().count, 20u);
      EXPECT_EQ(actual.xyz().scalar,
                layout.name.starts_with("doubles") ? ScalarType::float64 : ScalarType::float32);
    }
  }
}

TEST_F(Ply, WithoutVerticesIsAnEmptyCloud) {
  for (const PlyStyle& style : ply_styles()) {
    SCOPED_TRACE(describe(ply_layouts()[0], style));
    const RawCloud cloud = read(ply_text(ply_cloud(ply_layouts()[0], 0), style));
    EXPECT_EQ(cloud.size(), 0u);
    EXPECT_TRUE(cloud.xyz().empty());
  }
}

TEST_F(Ply, FacesBiggerThanTheWindowOfTheReaderAreSkipped) {
  std::string faces = std::string(1, '\x7f') + std::string(127 * 4, 'f');
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement face 2000\n"
      "property list char int vertex_indices\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar tag\nend_header\n";
  for (int i = 0; i < 2000; ++i)
    text += faces;
  const RawCloud cloud = read(text + std::string(12, '\0') + "T");
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_EQ(cloud.data[12], std::byte{'T'});
}

TEST_F(Ply, AsciiTakesWhatTheReaderOfPcdTakes) {
  const RawCloud cloud = read(ascii("  nan\t-inf +1e39 0\r\n\n \n", 1));
  EXPECT_TRUE(std::isnan(float_at(cloud, "x", 0)));
  EXPECT_EQ(float_at(cloud, "y", 0), -INFINITY);
  EXPECT_EQ(float_at(cloud, "z", 0), INFINITY);
}

TEST_F(Ply, AsciiErrorsNameTheVertex) {
  EXPECT_EQ(reason(ascii("1 2 3 0\n4 five 6 0\n")), "vertex 1, property 'y': 'five' is not of type float");
  EXPECT_EQ(reason(ascii("1 2 3 1 7\n4 5 6 2 7\n")),
            "truncated: vertex 1 has no more values for property 'l'");
  EXPECT_EQ(reason(ascii("1 2 3\n4 5 6 0 2 3\n")), "truncated: vertex 0 has no more values for property 'l'");
  EXPECT_EQ(reason(ascii("1 2 3 0 9\n4 5 6 0\n")), "vertex 0 has more values than properties");
  EXPECT_EQ(reason(ascii("1 2 3 3 7 8 9 1 1 1 1\n")), "vertex 0 has more values than properties");
  EXPECT_EQ(reason(ascii("1 2 3 3 7 8 9\n\n\n")), "truncated: vertex 1 is missing, of 2");
  EXPECT_EQ(reason(ascii("1 2 3 -1\n1 2 3 0\n")), "vertex 0, property 'l': '-1' is not of type uchar");
  EXPECT_EQ(reason(ascii("1 2 3 0.5\n1 2 3 0\n")), "vertex 0, property 'l': '0.5' is not of type uchar");
  EXPECT_EQ(reason(ascii("1 2 3 0\n1 2 3 0\n1 2 3 0\n")), "more rows than the 2 vertices");
  EXPECT_EQ(reason(ascii("1 2 3 0\n")),
            "truncated: 2 vertices of 4 properties do not fit in the 8 bytes after the header");
}

TEST_F(Ply, AsciiRowsOfLaterElementsAreNotLookedAt) {
  EXPECT_EQ(read(ascii("1 2 3 0\n1 2 3 0\nwhat ever\n", 2, "element face 9\nproperty float q\n")).size(), 2u);
}

TEST_F(Ply, AsciiMissingRowsOfEarlierElementsAreNamed) {
  EXPECT_EQ(
      reason("ply\nformat ascii 1.0\nelement edge 3\nproperty int a\nelement vertex 0\nproperty float x\n"
             "property float y\nproperty float z\nend_header\n1\n2\n"),
      "truncated: row 2 of element 'edge' is missing, of 3");
}

std::string binary(const std::string& elements, const std::string& body) {
  return "ply\nformat binary_big_endian 1.0\n" + elements +
         "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + body;
}

TEST_F(Ply, BinaryErrorsNameTheElement) {
  EXPECT_EQ(reason(binary("", std::string(23, '\0'))),
            "truncated: 2 of element 'vertex' take at least 12 bytes each, the file has 23");
  const std::string face = "element face 2\nproperty list int float w\n";
  EXPECT_EQ(reason(binary(face, std::string("\0\0\0\2", 4) + "12345678" + std::string("\0\0\1\0", 4))),
            "truncated: 'face' 1 of 2 is not complete");
  EXPECT_EQ(reason(binary(face, "\xff\xff\xff\xfe" + std::string(40, '\0'))),
            "corrupt: 'face' 0 has a list of -2 values");
  EXPECT_EQ(reason(binary(face, std::string("\0\0\0\1", 4) + "123456789")),
            "truncated: 'face' 1 of 2 is not complete");
}

TEST_F(Ply, BytesAfterTheVerticesAreIgnored) {
  EXPECT_EQ(read(binary("", std::string(99, '\0'))).size(), 2u);
  EXPECT_EQ(read(binary("", std::string(35, 'x'))).note, "");
  EXPECT_EQ(read(binary("", std::string(49, 'x'))).note,
            "the header says 2 points; 25 more bytes (2 points) follow, which are not read");
}

TEST_F(Ply, IsChosenByTheNameInAnyCase) {
  const std::string content = ascii("1 2 3 0\n4 5 6 0\n");
  for (const char* name : {"a.ply", "a.PLY", "b.pcd.Ply"}) {
    write_text(file(name), content);
    EXPECT_EQ(read_cloud(file(name)).size(), 2u);
  }
  write_text(file("a.pcd"), content);
  EXPECT_EQ(reason_for(file("a.pcd")), "not a .pcd file: unknown header line 'ply'");
}

TEST_F(Ply, ThatCannotBeOpenedSaysWhy) {
  EXPECT_EQ(reason_for(file("gone.ply")), "no such file or directory");
  EXPECT_EQ(reason(""), "empty file");
  std::filesystem::create_directory(file("folder.ply"));
  EXPECT_EQ(reason_for(file("folder.ply")), "is a directory");
}

}  // namespace
}  // namespace pcl_bv::detail
