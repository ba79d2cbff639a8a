// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Headers as they occur, and one test for each way in which one can be wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <map>

#include "files.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A good header, line by line; tests change or remove lines.
class PcdHeader : public FileTest {
 public:
  PcdHeader& set(const std::string& keyword, const std::string& line) {
    lines_[index_of(keyword)] = line.empty() ? "" : line + "\n";
    return *this;
  }

  std::string text() const {
    std::string all;
    for (const std::string& line : lines_)
      all += line;
    return all;
  }

  std::string reason(const std::string& data = "1 2 3\n4 5 6\n") const {
    return reason_for_content(text() + data);
  }

  RawCloud read(const std::string& data = "1 2 3\n4 5 6\n") const {
    write_text(file("a.pcd"), text() + data);
    return read_pcd(file("a.pcd"));
  }

 private:
  std::size_t index_of(const std::string& keyword) const {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (keywords_[i] == keyword) return i;
    }
    throw std::logic_error(keyword);
  }

  std::vector<std::string> keywords_ = {"#",     "VERSION", "FIELDS",    "SIZE",   "TYPE", "COUNT",
                                        "WIDTH", "HEIGHT",  "VIEWPOINT", "POINTS", "DATA"};
  std::vector<std::string> lines_ = {"# .PCD v0.7 - Point Cloud Data file format\n",
                                     "VERSION 0.7\n",
                                     "FIELDS x y z\n",
                                     "SIZE 4 4 4\n",
                                     "TYPE F F F\n",
                                     "COUNT 1 1 1\n",
                                     "WIDTH 2\n",
                                     "HEIGHT 1\n",
                                     "VIEWPOINT 0 0 0 1 0 0 0\n",
                                     "POINTS 2\n",
                                     "DATA ascii\n"};
};

TEST_F(PcdHeader, OfAGoodFileIsRead) {
  const RawCloud cloud = set("VIEWPOINT", "VIEWPOINT 1 -2 3.5 0.5 0.5 -0.5 1e-3").read();
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.height, 1u);
  EXPECT_EQ(cloud.viewpoint, (std::array<double, 7>{1, -2, 3.5, 0.5, 0.5, -0.5, 1e-3}));
  EXPECT_EQ(float_at(cloud, "y", 1), 5.0f);
}

TEST_F(PcdHeader, MayLeaveOutCountViewpointPointsHeightVersionAndComments) {
  for (const char* line : {"COUNT", "VIEWPOINT", "POINTS", "HEIGHT", "VERSION", "#"})
    set(line, "");
  const RawCloud cloud = read();
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.height, 1u);
  EXPECT_EQ(cloud.viewpoint, (std::array<double, 7>{0, 0, 0, 1, 0, 0, 0}));
}

TEST_F(PcdHeader, MayLeaveOutWidthIfPointsIsThere) {
  EXPECT_EQ(set("WIDTH", "").set("HEIGHT", "").read().width, 2u);
}

TEST_F(PcdHeader, KeepsTheShapeOfAnOrganisedCloud) {
  const RawCloud cloud = set("WIDTH", "WIDTH 1").set("HEIGHT", "HEIGHT 2").read();
  EXPECT_EQ(cloud.width, 1u);
  EXPECT_EQ(cloud.height, 2u);
}

TEST_F(PcdHeader, MayHaveCarriageReturnsCommentsEmptyLinesAndColumns) {
  set("FIELDS", "COLUMNS x y z\r").set("WIDTH", "# note\r\n\r\nWIDTH\t2\r").set("DATA", "DATA ascii\r");
  EXPECT_EQ(read("1 2 3\r\n4 5 6\r\n").size(), 2u);
}

TEST_F(PcdHeader, MayHaveCarriageReturnsBeforeBinaryData) {
  const float values[6] = {1, 2, 3, 4, 5, 6};
  const RawCloud cloud =
      set("DATA", "DATA binary\r").read({reinterpret_cast<const char*>(values), sizeof values});
  EXPECT_EQ(float_at(cloud, "z", 1), 6.0f);
}

TEST_F(PcdHeader, MayBeOfVersionsUpTo07) {
  for (const char* version : {".7", "0.7", ".6", "0.6", ".5", "0.5"}) {
    EXPECT_EQ(set("VERSION", std::string("VERSION ") + version).read().size(), 2u) << version;
  }
}

TEST_F(PcdHeader, OfNoPointsGivesAnEmptyCloud) {
  set("WIDTH", "WIDTH 0").set("POINTS", "POINTS 0");
  for (const char* encoding : {"DATA ascii", "DATA binary", "DATA binary_compressed"}) {
    const RawCloud cloud = set("DATA", encoding).read("");
    EXPECT_EQ(cloud.size(), 0u);
    EXPECT_TRUE(cloud.xyz().empty());
  }
}

TEST_F(PcdHeader, OfAnUnknownVersionIsRefused) {
  EXPECT_EQ(set("VERSION", "VERSION 0.8").reason(), "header: VERSION '0.8' is not supported, only up to 0.7");
}

TEST_F(PcdHeader, WithoutFieldsIsRefused) {
  EXPECT_EQ(set("FIELDS", "").reason(), "header: no FIELDS");
  EXPECT_EQ(set("FIELDS", "FIELDS").reason(), "header: no FIELDS");
}

TEST_F(PcdHeader, OfNoPointsNeedsNoFields) {
  for (const char* fields : {"", "FIELDS", "FIELDS a b c"}) {
    set("FIELDS", fields).set("WIDTH", "WIDTH 0").set("POINTS", "POINTS 0");
    for (const char* encoding : {"DATA ascii", "DATA binary", "DATA binary_compressed"}) {
      const RawCloud cloud = set("DATA", encoding).read("");
      EXPECT_EQ(cloud.size(), 0u);
      EXPECT_TRUE(cloud.xyz().empty());
      write_pcd(file("b.pcd"), cloud);
      EXPECT_EQ(read_pcd(file("b.pcd")).fields.size(), 3u);
    }
  }
}

TEST_F(PcdHeader, WithoutSizeOrTypeIsRefused) {
  EXPECT_EQ(set("SIZE", "").reason(), "header: no SIZE line");
  EXPECT_EQ(set("SIZE", "SIZE 4 4 4").set("TYPE", "").reason(), "header: no TYPE line");
}

TEST_F(PcdHeader, NamesTheCoordinatesThatAreMissing) {
  EXPECT_EQ(set("FIELDS", "FIELDS x y w").reason(), "no field z");
  EXPECT_EQ(set("FIELDS", "FIELDS a y b").reason(), "no field x, z");
  EXPECT_EQ(set("FIELDS", "FIELDS X b c").reason(), "no field y, z");
}

TEST_F(PcdHeader, WithACoordinateTwiceIsRefused) {
  set("FIELDS", "FIELDS x y z x").set("SIZE", "SIZE 4 4 4 4").set("TYPE", "TYPE F F F F").set("COUNT", "");
  EXPECT_EQ(reason("1 2 3 4\n1 2 3 4\n"), "field x occurs twice");
}

TEST_F(PcdHeader, WithCoordinatesThatAreNotOneNumberEachIsRefused) {
  EXPECT_EQ(set("SIZE", "SIZE 4 2 4").reason(),
            "field y of TYPE F, SIZE 2, COUNT 1 is not supported, only integers and floats of 4 or 8 bytes, "
            "COUNT 1");
  EXPECT_THAT(set("SIZE", "SIZE 4 4 4").set("COUNT", "COUNT 1 1 2").reason(),
              HasSubstr("field z of TYPE F, SIZE 4, COUNT 2 is not supported"));
}

TEST_F(PcdHeader, WithAViewpointThatMovesPointsIsReadAsStoredAndSaid) {
  const std::string note =
      "VIEWPOINT is not the identity and is not applied: coordinates are taken as stored";
  for (const char* viewpoint : {"0 0 5 1 0 0 0", "0 0 0 0.5 0.5 0.5 0.5", "0 0 0 0 0 0 1", "1 2 3 0 0 0 0"}) {
    const RawCloud cloud = set("VIEWPOINT", std::string("VIEWPOINT ") + viewpoint).read();
    EXPECT_EQ(cloud.note, note) << viewpoint;
    EXPECT_EQ(float_at(cloud, "z", 1), 6.0f);
  }
  for (const char* viewpoint : {"0 0 0 1 0 0 0", "0 -0 0 -1 0 0 0", "0 0 0 2 0 0 0", "0 0 0 0 0 0 0"})
    EXPECT_EQ(set("VIEWPOINT", std::string("VIEWPOINT ") + viewpoint).read().note, "") << viewpoint;
}

TEST_F(PcdHeader, WithAnImpossibleSizeIsRefused) {
  for (const char* size : {"0", "3", "16", "-4", "4.0", "four", "44", "18446744073709551620"}) {
    EXPECT_EQ(set("SIZE", std::string("SIZE 4 4 ") + size).reason(),
              "header: SIZE: '" + std::string(size) + "' is not one of 1, 2, 4, 8");
  }
}

TEST_F(PcdHeader, WithAnImpossibleTypeIsRefused) {
  EXPECT_EQ(set("TYPE", "TYPE F F D").reason(), "header: TYPE: 'D' is not one of I, U, F");
}

TEST_F(PcdHeader, WithAnImpossibleCountIsRefused) {
  for (const char* count : {"0", "-1", "4294967296", "1.5", "x"}) {  // of z
    EXPECT_EQ(set("COUNT", std::string("COUNT 1 1 ") + count).reason(),
              "header: COUNT: '" + std::string(count) + "' is not a number from 1 to 4294967295");
  }
}

TEST_F(PcdHeader, LeavesOutAFieldOfNoElements) {
  const auto with_padding = [&](const char* data) -> PcdHeader& {
    return set("FIELDS", "FIELDS x y z _ intensity _")
        .set("SIZE", "SIZE 4 4 4 1 4 1")
        .set("TYPE", "TYPE F F F U F U")
        .set("COUNT", "COUNT 1 1 1 0 1 0")
        .set("DATA", std::string("DATA ") + data);
  };
  const std::vector<float> values{1, 2, 3, 9, 4, 5, 6, 9};
  const std::string text = "1 2 3 9\n4 5 6 9\n",
                    bytes(reinterpret_cast<const char*>(values.data()), sizeof(float) * values.size());
  for (const auto& [data, body] : {std::pair{"ascii", text}, {"binary", bytes}}) {
    const RawCloud cloud = with_padding(data).read(body);
    EXPECT_EQ(coordinates_of(cloud), (std::vector<double>{1, 2, 3, 4, 5, 6})) << data;
    ASSERT_EQ(cloud.fields.size(), 4U);
    EXPECT_EQ(intensity_of(cloud.fields, cloud.data.data(), cloud.point_step)->at(1), 9);
    EXPECT_THAT(cloud.note, HasSubstr("field '_' has COUNT 0 and is left out"));
    write_pcd(file("again.pcd"), cloud, PcdEncoding::binary_compressed);
    EXPECT_EQ(coordinates_of(read_pcd(file("again.pcd"))), coordinates_of(cloud));
  }
}

TEST_F(PcdHeader, WithTheWrongNumberOfEntriesIsRefused) {
  EXPECT_EQ(set("SIZE", "SIZE 4 4").reason(), "header: SIZE has 2 entries, expected 3");
  EXPECT_EQ(set("SIZE", "SIZE 4 4 4").set("TYPE", "TYPE F F F F").reason(),
            "header: TYPE has 4 entries, expected 3");
  EXPECT_EQ(set("TYPE", "TYPE F F F").set("COUNT", "COUNT 1").reason(),
            "header: COUNT has 1 entries, expected 3");
  EXPECT_EQ(set("COUNT", "").set("WIDTH", "WIDTH 2 2").reason(), "header: WIDTH has 2 entries, expected 1");
  EXPECT_EQ(set("WIDTH", "WIDTH 2").set("VIEWPOINT", "VIEWPOINT 0 0 0").reason(),
            "header: VIEWPOINT has 3 entries, expected 7");
}

TEST_F(PcdHeader, WithAViewpointThatIsNoNumberIsRefused) {
  EXPECT_EQ(set("VIEWPOINT", "VIEWPOINT 0 0 0 one 0 0 0").reason(),
            "header: VIEWPOINT: 'one' is not a number");
}

TEST_F(PcdHeader, WithImpossibleNumbersOfPointsIsRefused) {
  for (const char* points : {"-2", "2.0", "18446744073709551616", "two"}) {
    const std::string expected = ": '" + std::string(points) + "' is not a number of points";
    EXPECT_EQ(set("WIDTH", std::string("WIDTH ") + points).reason(), "header: WIDTH" + expected);
    EXPECT_EQ(set("WIDTH", "WIDTH 2").set("HEIGHT", std::string("HEIGHT ") + points).reason(),
              "header: HEIGHT" + expected);
    EXPECT_EQ(set("HEIGHT", "").set("POINTS", std::string("POINTS ") + points).reason(),
              "header: POINTS" + expected);
    set("POINTS", "");
  }
}

TEST_F(PcdHeader, WithSizesThatDisagreeIsRefused) {
  EXPECT_EQ(set("POINTS", "POINTS 3").reason(), "header: 3 POINTS, but WIDTH x HEIGHT is 2 x 1");
  EXPECT_EQ(set("HEIGHT", "HEIGHT 0").reason(), "header: 3 POINTS, but WIDTH x HEIGHT is 2 x 0");
}

TEST_F(PcdHeader, WithoutWidthAndPointsIsRefused) {
  EXPECT_EQ(set("WIDTH", "").set("POINTS", "").reason(), "header: neither WIDTH nor POINTS");
}

TEST_F(PcdHeader, WhoseSizesOverflowIsRefused) {
  set("WIDTH", "WIDTH 4294967296").set("HEIGHT", "HEIGHT 4294967296").set("POINTS", "POINTS 0");
  EXPECT_EQ(reason(), "header: 4294967296 x 4294967296 points of 12 bytes are more than a file can hold");
  set("WIDTH", "WIDTH 18446744073709551615").set("HEIGHT", "HEIGHT 1").set("POINTS", "");
  EXPECT_THAT(reason(), HasSubstr("more than a file can hold"));
}

TEST_F(PcdHeader, WithoutEncodingIsRefused) {
  EXPECT_EQ(set("DATA", "DATA zip").reason(),
            "header: DATA: 'zip' is not one of ascii, binary, binary_compressed");
  EXPECT_EQ(set("DATA", "DATA").reason(), "header: DATA has 0 entries, expected 1");
}

TEST_F(PcdHeader, ThatDoesNotEndIsRefused) {
  set("DATA", "");
  EXPECT_EQ(reason(""),
            "truncated header: no DATA line in the first " + std::to_string(text().size()) + " bytes");
}

TEST_F(PcdHeader, CutInsideAnyLineIsSaidToBeTruncated) {
  const std::string whole = text();
  const std::size_t first_line = whole.find('\n', whole.find("VERSION")) + 1;
  for (std::size_t size = first_line + 1; size < whole.find("DATA") + 4; ++size) {
    SCOPED_TRACE(size);
    EXPECT_THAT(reason_for_content(whole.substr(0, size)), testing::StartsWith("truncated header"));
  }
}

TEST_F(PcdHeader, WithALineTwiceIsRefused) {
  EXPECT_EQ(set("WIDTH", "WIDTH 2\nWIDTH 2").reason(), "header: WIDTH occurs twice");
  EXPECT_EQ(set("WIDTH", "WIDTH 2").set("FIELDS", "FIELDS x y z\nCOLUMNS x y z").reason(),
            "header: FIELDS occurs twice");
}

TEST_F(PcdHeader, UpToOneMebibyteIsRead) {
  for (const std::size_t comment : {65'300, 65'400, 70'000, 262'144, 1'048'000})
    EXPECT_EQ(set("WIDTH", "# " + std::string(comment, 'c') + "\nWIDTH 2").read().size(), 2u) << comment;
  for (std::size_t before = 0; before < 160; ++before)  // the end of what is read first, at any byte
    EXPECT_EQ(set("WIDTH", "# " + std::string(65'376 + before, 'c') + "\nWIDTH 2").reason(), "") << before;
}

TEST_F(PcdHeader, LongerThanOneMebibyteIsRefused) {
  set("WIDTH", "# " + std::string(1'100'000, 'c') + "\nWIDTH 2");
  EXPECT_EQ(reason(), "header: longer than the 1048576 bytes allowed, no DATA line in them");
}

TEST_F(PcdHeader, WhoseDataLineIsCutByTheLimitIsRefused) {
  const std::size_t room =
      1048576 - text().size() - 3 + std::strlen("ascii\n");  // "#", "\n" and the cut after "DATA "
  set("WIDTH", "#" + std::string(room - 1, 'c') + "\nWIDTH 2").set("DATA", "DATA ascii");
  EXPECT_THAT(reason(), HasSubstr("longer than the 1048576 bytes allowed"));
}

TEST_F(PcdHeader, OfAnotherFormatIsRefusedInPrintableWords) {
  const std::string reason = reason_for_content(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  EXPECT_EQ(reason, "not a .pcd file: unknown header line '?PNG?'");
  EXPECT_THAT(reason_for_content(std::string(100000, '\xff')),
              testing::StartsWith("not a .pcd file: unknown"));
  EXPECT_THAT(reason_for_content(std::string(2000000, '\xff')), HasSubstr("no DATA line"));
  EXPECT_EQ(reason_for_content("ply\nformat ascii 1.0\n"), "not a .pcd file: unknown header line 'ply'");
}

using PcdPath = FileTest;

TEST_F(PcdPath, ThatIsMissingIsNamedSo) {
  EXPECT_EQ(reason_for(file("gone.pcd")), "no such file or directory");
}
TEST_F(PcdPath, ThatIsAFolderIsNamedSo) {
  EXPECT_EQ(reason_for(folder()), "is a directory");
}
TEST_F(PcdPath, ThatIsADeviceIsRefused) {
  EXPECT_EQ(reason_for("/dev/null"), "not a regular file");
}
TEST_F(PcdPath, ThatIsAnEmptyFileIsNamedSo) {
  EXPECT_EQ(reason_for_content(""), "empty file");
}

TEST_F(PcdPath, ThatIsAPipeIsRefusedWithoutWaiting) {
  ASSERT_EQ(::mkfifo(file("pipe.pcd").c_str(), 0600), 0);
  EXPECT_EQ(reason_for(file("pipe.pcd")), "not a regular file");
}

TEST_F(PcdPath, ThatMayNotBeReadIsNamedSo) {
  write_text(file("a.pcd"), "x");
  fs::permissions(file("a.pcd"), fs::perms::none);
  fs::permissions(folder(), fs::perms::all);
  const WithoutRoot nobody;
  EXPECT_EQ(reason_for(file("a.pcd")), "permission denied");
}

TEST_F(PcdHeader, WithTheLineDataTwiceIsRefused) {
  for (const std::string encoding : {"ascii", "binary", "binary_compressed"}) {
    for (const std::string end : {"\n", "\r\n"})
      EXPECT_EQ(set("DATA", "DATA " + encoding).reason("DATA binary" + end + std::string(24, 'a')),
                "header: DATA occurs twice");
  }
}

TEST_F(PcdHeader, OfZeroPointsBeforeSomeIsRefusedAndOfTooFewIsSaid) {
  set("DATA", "DATA binary").set("WIDTH", "WIDTH 0").set("POINTS", "POINTS 0");
  EXPECT_EQ(reason(std::string(25, 'a')), "header: 0 points, but 25 more bytes (2 points) follow");
  EXPECT_EQ(reason(std::string(11, 'a')), "");
  set("WIDTH", "WIDTH 2").set("POINTS", "POINTS 2");
  EXPECT_EQ(read(std::string(24 + 11, 'a')).note, "");
  EXPECT_EQ(read(std::string(24 + 36, 'a')).note,
            "the header says 2 points; 36 more bytes (3 points) follow, which are not read");
  EXPECT_EQ(read(std::string(24, 'a') + std::string(4095, '\0')).note, "");  // as PCL fills up a page
  EXPECT_NE(read(std::string(24, 'a') + std::string(4095, '\0') + 'a').note, "");
  EXPECT_NE(read(std::string(24, 'a') + std::string(4096, '\0')).note, "");
}

}  // namespace
}  // namespace pcl_bv::detail
