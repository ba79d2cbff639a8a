// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Headers of .ply files: each thing that can be wrong has its own reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files.h"
#include "pcl_bv/io/ply.h"

namespace pcl_bv::detail {
namespace {

using testing::StartsWith;

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";

class PlyHeaderFile : public FileTest {
 protected:
  std::string reason(std::string_view content) const { return reason_for_content(content, ".ply"); }

  /// Of a file of one vertex, with these lines after `ply`.
  std::string reason_of(const std::string& lines) const {
    return reason("ply\n" + lines + "end_header\n" + "1 2 3\n");
  }
  std::string reason_of_vertex(const std::string& properties) const {
    return reason_of("format ascii 1.0\nelement vertex 1\n" + properties);
  }
};

TEST_F(PlyHeaderFile, ThatIsRightIsRead) {
  EXPECT_EQ(reason_of_vertex(xyz), "");
  EXPECT_EQ(reason_of_vertex("comment property list\n\n  \n" + xyz + "obj_info element\n"), "");
}

TEST_F(PlyHeaderFile, ThatStatesAnOffsetHasAWarning) {
  const auto note = [&](const std::string& line) {
    EXPECT_EQ(reason_of_vertex(line + "\n" + xyz), "");
    write_text(file("a.ply"),
               "ply\nformat ascii 1.0\n" + line + "\nelement vertex 1\n" + xyz + "end_header\n1 2 3\n");
    return read_ply(file("a.ply")).note;
  };
  EXPECT_EQ(note("comment offset 500000 4200000 0"),
            "the header has 'comment offset 500000 4200000 0', which is not applied: coordinates are taken "
            "as stored");
  for (const char* line : {"obj_info Offset_X 5", "comment Global Shift: 1 2 3", "comment translation=1,2,3"})
    EXPECT_THAT(note(line), testing::HasSubstr(line)) << line;
  for (const char* line : {"comment made 2024 by makeshift 2", "comment offset", "obj_info num_cols 512"})
    EXPECT_EQ(note(line), "") << line;
}

TEST_F(PlyHeaderFile, MustStartWithPly) {
  const std::string wanted = "not a .ply file: it does not start with a line 'ply'";
  EXPECT_EQ(reason("# .PCD v0.7\n"), wanted);
  EXPECT_EQ(reason("plywood\nformat ascii 1.0\n"), wanted);
  EXPECT_EQ(reason("ply format\n"), wanted);
  EXPECT_EQ(reason("\nply\n"), wanted);
  EXPECT_EQ(reason(std::string(3000, '\0')), wanted);
}

TEST_F(PlyHeaderFile, MustEnd) {
  const std::string whole = "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "end_header\n";
  for (std::size_t size = 3; size < whole.size(); ++size) {
    EXPECT_EQ(reason(whole.substr(0, size)),
              "truncated header: no end_header in the first " + std::to_string(size) + " bytes");
  }
}

TEST_F(PlyHeaderFile, OfUpToOneMebibyteIsRead) {
  for (const std::size_t comment : {65'300, 65'480, 72'000, 262'144, 1'048'000})
    EXPECT_EQ(reason_of_vertex("comment " + std::string(comment, 'c') + "\n" + xyz), "") << comment;
  for (std::size_t before = 0; before < 160; ++before)  // the end of what is read first, at any byte
    EXPECT_EQ(reason_of_vertex("comment " + std::string(65'376 + before, 'c') + "\n" + xyz), "") << before;
  std::string lines;
  for (int i = 0; i < 1000; ++i)
    lines +=
        "comment scanned with something that has much to say about itself, line " + std::to_string(i) + "\n";
  EXPECT_EQ(reason_of_vertex(lines + xyz), "");
}

TEST_F(PlyHeaderFile, LongerThanOneMebibyteIsRefused) {
  EXPECT_EQ(reason_of_vertex("comment " + std::string(1'100'000, 'c') + "\n" + xyz),
            "header: longer than the 1048576 bytes allowed, no end_header in them");
  EXPECT_EQ(reason("ply\n" + std::string(70000, 'c')),
            "truncated header: no end_header in the first 70004 bytes");
}

TEST_F(PlyHeaderFile, NeedsAFormatThatIsKnown) {
  EXPECT_EQ(reason_of("element vertex 1\n" + xyz), "header: no format line");
  EXPECT_EQ(reason_of("format text 1.0\n"),
            "header: format 'text' is not one of ascii, binary_little_endian, binary_big_endian");
  EXPECT_EQ(reason_of("format ascii 2.0\n"), "header: format version '2.0' is not 1.0");
  EXPECT_EQ(reason_of("format ascii\n"), "header: invalid line 'format ascii'");
  EXPECT_EQ(reason_of("format ascii 1.0\nformat ascii 1.0\n"), "header: format occurs twice");
}

TEST_F(PlyHeaderFile, NeedsVertices) {
  EXPECT_EQ(reason_of("format ascii 1.0\nelement face 1\n" + xyz), "header: no element vertex");
  EXPECT_EQ(reason_of_vertex(""), "no field x, y, z");
  EXPECT_EQ(reason_of_vertex("property float x\nproperty list uchar float y\nproperty float z\n"),
            "no field y");
}

TEST_F(PlyHeaderFile, NeedsEachCoordinateOnce) {
  EXPECT_EQ(reason_of_vertex(xyz + "property float x\n"), "field x occurs twice");
}

TEST_F(PlyHeaderFile, OfNoVerticesNeedsNoProperties) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    EXPECT_EQ(reason("ply\nformat " + std::string(format) + " 1.0\nelement vertex 0\nend_header\n"), "");
    EXPECT_EQ(reason("ply\nformat " + std::string(format) +
                     " 1.0\nelement vertex 0\nproperty int a\nelement face 0\nend_header\n"),
              "");
  }
}

TEST_F(PlyHeaderFile, LinesThatMakeNoSenseAreNamed) {
  EXPECT_EQ(reason_of("format ascii 1.0\n" + xyz), "header: a property before any element");
  EXPECT_EQ(reason_of_vertex("property float\n"), "header: invalid line 'property float'");
  EXPECT_EQ(reason_of_vertex("property float x y\n"), "header: invalid line 'property float x y'");
  EXPECT_EQ(reason_of_vertex("property lost uchar int l\n"),
            "header: invalid line 'property lost uchar int l'");
  EXPECT_EQ(reason_of_vertex("property long x\n"), "header: unknown property type 'long'");
  EXPECT_EQ(reason_of_vertex("property list float int l\n"), "header: a list cannot have 'float' elements");
  EXPECT_EQ(reason_of_vertex("nonsense\x01\n"), "header: invalid line 'nonsense?'");
  EXPECT_EQ(reason_of("format ascii 1.0\nelement vertex\n"), "header: invalid line 'element vertex'");
}

TEST_F(PlyHeaderFile, CountsMustBeNumbers) {
  for (const std::string count : {"-1", "1.5", "many", "18446744073709551616", "0x10"}) {
    EXPECT_EQ(reason_of("format ascii 1.0\nelement vertex " + count + "\n" + xyz),
              "header: element 'vertex': '" + count + "' is not a number");
  }
}

TEST_F(PlyHeaderFile, CountsBeyondAnyFileAreRefused) {
  EXPECT_EQ(reason_of("format ascii 1.0\nelement vertex 18446744073709551615\n" + xyz),
            "header: 18446744073709551615 vertices are more than a file can hold");
  EXPECT_THAT(reason_of("format binary_little_endian 1.0\nelement a 18446744073709551615\nproperty double d\n"
                        "element vertex 1\n" +
                        xyz),
              StartsWith("truncated: 18446744073709551615 of element 'a' take at least 8 bytes each"));
}

}  // namespace
}  // namespace pcl_bv::detail
