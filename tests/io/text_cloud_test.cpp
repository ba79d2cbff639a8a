// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/text_cloud.h"

#include <gmock/gmock.h>

#include "files.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class TextCloud : public FileTest {
 protected:
  RawCloud read(const std::string& text, const std::string& columns = "") const {
    write_text(file("a.csv"), text);
    return read_cloud(file("a.csv"), {0, columns});
  }
  std::vector<double> values(const std::string& text, const std::string& columns = "") const {
    return coordinates_of(read(text, columns));
  }
  std::string names(const std::string& text, const std::string& columns = "") const {
    std::string all;
    for (const PointField& field : read(text, columns).fields)
      all += field.name + ' ';
    return all;
  }
  std::string error(const std::string& text, const std::string& columns = "") const {
    try {
      read(text, columns);
    } catch (const std::exception& wrong) {
      return wrong.what();
    }
    return "no error";
  }
};

TEST_F(TextCloud, HasAnyOfFourSeparators) {
  for (const char* text : {"1 2 3\n4 5.5 -6e1\n", "1,2,3\n\n4, 5.5 ,-6e1\n", "1;2;3;\r\n4;5.5;-6e1;\r\n",
                           "1\t2\t3\n4\t5.5\t-6e1"})
    EXPECT_THAT(values(text), ElementsAre(1, 2, 3, 4, 5.5, -60)) << text;
}

TEST_F(TextCloud, TakesNamesFromAHeaderOrTheOption) {
  EXPECT_EQ(names("1 2 3 4\n"), "x y z intensity ");
  EXPECT_EQ(names("1 2 3 4 5\n"), "x y z field4 field5 ");
  EXPECT_EQ(names("\xEF\xBB\xBF\"X\",\"Y\",\"Z\",\"Scalar field\"\n1,2,3,4\n"), "X Y Z Scalar_field ");
  EXPECT_EQ(names("# made by hand\n# y x z\n1 2 3\n"), "y x z ");
  EXPECT_EQ(names("//X Y Z R\n1 2 3 4\n"), "X Y Z R ");
  EXPECT_EQ(names("# two words\n1 2 3\n"), "x y z ");
  EXPECT_EQ(names("a;b;c;d\n1;2;3;4\n", "z,y,x,label:u2"), "z y x label ");
  EXPECT_THAT(values("2 0 1 9\n", "z,_,y,x"), ElementsAre(9, 1, 2));
  EXPECT_EQ(read("1 2 3 7\n", "x,y,z,label:i4").fields[3].type, 'I');
  EXPECT_THAT(values("2\n1 2 3\n4 5 6\n"), ElementsAre(1, 2, 3, 4, 5, 6));  // .pts
}

TEST_F(TextCloud, OfManyPiecesIsTheSameForEveryNumberOfThreads) {
  std::string text = "x,y,z\n";
  std::vector<double> expected;
  for (int i = 0; i < 60000; ++i) {
    text += std::to_string(i) + ",0.5," + std::to_string(-i) + (i % 7 == 0 ? "\n,,\n" : "\n");
    expected.insert(expected.end(), {double(i), 0.5, double(-i)});
  }
  EXPECT_EQ(values(text), expected);
  const RawCloud parallel = read_text_cloud(file("a.csv"), {}, Execution{Threads{4}, Isa::scalar});
  EXPECT_EQ(parallel.data, read(text).data);
  EXPECT_EQ(read_cloud_header(file("a.csv")).cloud.size(), 60000U);
}

TEST_F(TextCloud, ThatCannotBeReadIsRefusedWithTheLine) {
  EXPECT_THAT(error("hello\nworld\n"), HasSubstr("'world' is neither numbers nor a header"));
  EXPECT_THAT(error("x y z\n"), HasSubstr("no line of numbers"));
  EXPECT_THAT(error("1 2\n3 4\n"), HasSubstr("no field z"));
  EXPECT_THAT(error("1,2,3\n4,,6\n7,8,9\n"), HasSubstr("row 2, field 'y': '' is not a number"));
  EXPECT_THAT(error("1,2,3\n4,5\n"), HasSubstr("row 2 has 2 values instead of 3"));
  EXPECT_THAT(error("1 2 3\n4 5 6 7\n"), HasSubstr("row 2 has more than 3 values"));
  EXPECT_THAT(error("1 2 3\n4 five 6\n"), HasSubstr("row 2, field 'y': 'five'"));
  EXPECT_THAT(error("1;2;3\n4;5,5;6\n"), HasSubstr("row 2, field 'y': '5,5'"));
  EXPECT_THAT(error("a b c d\n1 2 3\n"), HasSubstr("4 names, the first line of numbers has 3 values"));
  EXPECT_THAT(error("a b c\n1 2 3\n"), HasSubstr("no field x, y, z"));
  EXPECT_THAT(error("1 2 3\n", "x,y,z,w"), HasSubstr("has 3 values, not the 4"));
  for (const char* columns : {"x,y", "x,y,z,", "x,y,z,x", "x,y,z,a:f2", "x,y,z,a:q4", "x,y,z,a b"})
    EXPECT_THROW(parse_columns(columns), std::invalid_argument) << columns;
  EXPECT_THAT(read("class,z,y,x\ncar,1,2,3\n").note, HasSubstr("class"));
  EXPECT_THAT(read("1 2 3 car\n", "x,y,z,class:u1").note, HasSubstr("class"));
}

TEST_F(TextCloud, MayHaveBlanksInsideTheTextOfAColumn) {
  for (const auto& [text, columns] : std::vector<std::pair<std::string, std::string>>{
           {"stamp,x,y,z\n2024-01-01 12:00:00,1,2,3\n2024-01-01 12:00:01,4,5,6\n", ""},
           {"# stamp,x,y,z\n2024-01-01 12:00:00,1,2,3\n2024-01-01 12:00:01,4,5,6\n", ""},
           {"2024-01-01 12:00:00 , 1,2,\t3\r\n2024-01-01 12:00:01, 4 ,5,6\r\n", "_,x,y,z"},
           {"x,y,z,class\n1,2,3,high vegetation\n4,5,6,ground\n", ""},
           {"x;y;z;class\n1 ; 2;3;high, low vegetation\n4;5;6;a , b c \n", ""},
           {"x,y,z,class\n1,2,3,semi;colon\n4,5,6,a;b\n", ""},
           {"x y z class\n1 2 3 a,b\n4 5 6 c\n", ""},
           {"x,y,z,class\n\"1\",\"2\",\"3\",\"a, \"\"b\"\"\"\n4,5,6,\"c\n", ""}}) {
    EXPECT_THAT(values(text, columns), ElementsAre(1, 2, 3, 4, 5, 6)) << text;
    EXPECT_EQ(read(text, columns).invalid_fields.size(), 1U) << text;
  }
  EXPECT_THAT(read("x,y,z,class\n1,2,3,high \t vegetation\n").note,
              HasSubstr("field 'class': 'high   vegetation' is not a number"));
  EXPECT_THAT(error("x,y,z,class\n1,2,3,a\n4,5 5,6,b\n"), HasSubstr("row 2, field 'y': '5 5'"));
}

TEST_F(TextCloud, MayHaveEmptyValuesOutsideOfItsCoordinates) {
  for (const char* text :
       {"x,y,z,r,g\n1,2,3,,9\n4,5,6,7,9\n", "x,y,z,r,g\n1,2,3, ,\n4,5,6,7,9\n", ",x,y,z\n,1,2,3\n1,4,5,6\n",
        "x;y;z;r\n1;2;3;\n4;5;6;7\n", "x,y,z,r\n1,2,3,8\n4,5,6,\n", "x,y,z,r,\n1,2,3,8,\n4,5,6,,\n"}) {
    EXPECT_THAT(values(text), ElementsAre(1, 2, 3, 4, 5, 6)) << text;
    EXPECT_THAT(read(text).note, HasSubstr("'' is not a number; 1 such value is replaced by NaN")) << text;
  }
  EXPECT_EQ(names(",x,y,z\n0,1,2,3\n"), "field1 x y z ");
}

TEST_F(TextCloud, WithBlanksInValuesIsTheSameForEveryNumberOfThreads) {
  std::string text = "x,y,z,class\n";
  for (int i = 0; i < 40000; ++i)
    text += std::to_string(i) + (i % 5 == 0 ? ", 0.5 ," : ",0.5,") + std::to_string(-i) +
            (i % 3 == 0    ? ",low vegetation\n"
             : i % 11 == 0 ? ",\n"
                           : ",7\n");
  const RawCloud serial = read(text);
  const RawCloud parallel = read_text_cloud(file("a.csv"), {}, Execution{Threads{4}, Isa::scalar});
  ASSERT_EQ(serial.size(), 40000U);
  EXPECT_EQ(parallel.data, serial.data);
  EXPECT_EQ(parallel.note, serial.note);
}

TEST_F(TextCloud, OfAnotherNumberOfPointsThanItStatesHasAWarning) {
  for (const char* text :
       {"7\n1 2 3\n4 5 6\n", "# x y z\n7\n1 2 3\n4 5 6\n", "7 \r\nx,y,z\r\n1,2,3\r\n4,5,6\r\n"})
    EXPECT_EQ(read(text).note, "the line before the points says 7 points, the file has 2") << text;
  EXPECT_THAT(read("1\n1 2 3\n4 5 6\n").note, HasSubstr("says 1 points, the file has 2"));
  EXPECT_EQ(read("2\n1 2 3\n\n4 5 6\n").note, "");
  EXPECT_THAT(read_cloud_header(file("a.csv")).cloud.note, "");
}

}  // namespace
}  // namespace pcl_bv::detail
