// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Text of many pieces, read by any number of threads: as if one had read it from the front.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <random>
#include <thread>

#include "files.h"
#include "pcl_bv/io/ply.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"
#include "sample_plys.h"

namespace pcl_bv::detail {
namespace {

const ParallelPolicy policies[] = {Serial{}, OpenMP{2}, Threads{2}, Threads{5}};

class TextPieces : public FileTest {
 protected:
  // Rows "000017 2 3", all of them shifted by blanks before the first one.
  std::string numbered(std::size_t points, std::size_t rows, std::size_t shift = 0) const {
    std::string text = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH " + std::to_string(points) +
                       "\nHEIGHT 1\nDATA ascii\n" + std::string(shift, ' ');
    for (std::size_t i = 0; i < rows; ++i) {
      const std::string number = std::to_string(i);
      text += std::string(6 - number.size(), '0') + number + " 2 3\n";
    }
    return text;
  }

  void expect_numbered(const std::string& text, std::size_t points) const {
    write_text(file("a.pcd"), text);
    for (const ParallelPolicy& policy : policies) {
      const RawCloud cloud = read_pcd(file("a.pcd"), policy);
      ASSERT_EQ(cloud.size(), points);
      for (std::size_t i = 0; i < points; ++i)
        ASSERT_EQ(load_point(cloud.xyz(), i).x, static_cast<double>(i));
    }
  }

  void expect_reason(const std::string& text, const std::string& reason) const {
    write_text(file("a.pcd"), text);
    for (int repeat = 0; repeat < 2; ++repeat) {
      for (const ParallelPolicy& policy : policies) {
        try {
          read_pcd(file("a.pcd"), policy);
          FAIL() << "no error";
        } catch (const IoError& error) {
          ASSERT_EQ(std::string_view(error.what()), reason);
        }
      }
    }
  }
};

constexpr std::size_t many = 100'000;  // 1.1 MB

TEST_F(TextPieces, RowsMayLieInAnyWayAcrossThem) {
  for (std::size_t shift = 0; shift < 11; ++shift) {
    const std::string text = numbered(many, many, shift);
    expect_numbered(text, many);
    expect_numbered(text.substr(0, text.size() - 1), many);
  }
}

TEST_F(TextPieces, BlankLinesAndCarriageReturnsDoNotCount) {
  std::mt19937 random(5);
  const std::string text = numbered(many, many);
  const std::size_t body = text.find("ascii\n") + 6;
  std::string spaced = text.substr(0, body);
  for (std::size_t at = body; at < text.size(); at += 11) {
    spaced += std::array{"", "", "", "\n", "  ", " \t\n\n", "\r\n"}[random() % 7];
    spaced += text.substr(at, 10) + std::array{"\n", "\r\n", " \n", "\n \n"}[random() % 4];
  }
  expect_numbered(spaced + std::string(600'000, '\n'), many);
}

TEST_F(TextPieces, ARowMayBeLongerThanManyPieces) {
  const Layout layout{"long", {{"x"}, {"y"}, {"z"}, {"histogram", 'U', 2, 300'000}}};
  const RawCloud cloud = sample_cloud(layout, 3, 1, 7);
  write_pcd(file("a.pcd"), cloud, PcdEncoding::ascii);
  for (const ParallelPolicy& policy : policies)
    expect_same_cloud(read_pcd(file("a.pcd"), policy), cloud);
}

TEST_F(TextPieces, EveryLayoutIsReadToTheBit) {
  for (const Layout& layout : sample_layouts()) {
    SCOPED_TRACE(layout.name);
    const RawCloud cloud = sample_cloud(layout, 4000, 5, 7);
    write_pcd(file("a.pcd"), cloud, PcdEncoding::ascii);
    for (const ParallelPolicy& policy : policies)
      expect_same_cloud(read_pcd(file("a.pcd"), policy), cloud);
  }
}

TEST_F(TextPieces, TheFirstOfSeveralBadRowsIsNamed) {
  std::string text = numbered(many, many);
  const std::size_t body = text.find("ascii\n") + 6;
  for (const std::size_t row : {99'990, 70'000, 50'003, 50'002, 50'001, 3}) {
    text[body + 11 * row + 9] = 'x';
    expect_reason(text,
                  "row " + std::to_string(row + 1) + ", field 'z': 'x' is not a number of TYPE F, SIZE 4");
  }
  text.erase(body + 11 * 2 + 8, 2);
  expect_reason(text, "truncated: row 3 has 2 values instead of 3");
}

TEST_F(TextPieces, MissingRowsAndOneTooManyAreCountedOverAllOfThem) {
  expect_reason(numbered(many, many - 1) + "        \n\n\n\n", "truncated: row 100000 is missing, of 100000");
  expect_reason(numbered(many - 1, many), "more rows than the 99999 POINTS");
  expect_reason(numbered(30'000, many), "more rows than the 30000 POINTS");
}

TEST_F(TextPieces, RowsBeyondThePointsAreNotLookedInto) {
  expect_reason(numbered(many, many) + "not a row\n", "more rows than the 100000 POINTS");
  expect_reason(numbered(0, many), "more rows than the 0 POINTS");
}

TEST_F(TextPieces, ChangedWhileTheyAreReadGiveAnErrorOrAWholeCloud) {
  const std::string text = numbered(many, many);
  write_text(file("a.pcd"), text);
  std::atomic<bool> done{false};
  std::thread writer([&] {
    const std::size_t body = text.find("ascii\n") + 6;
    std::fstream stream(file("a.pcd"), std::ios::in | std::ios::out | std::ios::binary);
    for (std::size_t i = 0; !done; ++i) {
      stream.seekp(static_cast<std::streamoff>(body + 11 * (i * 7919 % many) + 10));
      stream.put(i % 2 == 0 ? ' ' : '\n').flush();
    }
  });
  for (int i = 0; i < 30; ++i) {
    try {
      EXPECT_EQ(read_pcd(file("a.pcd"), Threads{3}).size(), many);
    } catch (const IoError&) {
    }
  }
  done = true;
  writer.join();
}

TEST_F(TextPieces, VerticesAreFoundBetweenOtherElements) {
  for (const PlyStyle& style : ply_styles()) {
    if (style.format != "ascii") continue;
    const Layout& layout = ply_layouts().back();
    SCOPED_TRACE(describe(layout, style));
    const RawCloud cloud = ply_cloud(layout, 10'000);
    write_text(file("a.ply"), ply_text(cloud, style));
    for (const ParallelPolicy& policy : policies)
      expect_same_cloud(read_ply(file("a.ply"), policy), cloud);
  }
}

TEST_F(TextPieces, EveryEncodingIsTheSameByAnyNumberOfThreads) {
  const RawCloud cloud = sample_cloud(sample_layouts()[1], 200'000, 1, 7);  // 3 MB
  for (const PcdEncoding encoding :
       {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed}) {
    write_pcd(file("a.pcd"), cloud, encoding);
    for (const ParallelPolicy& policy : policies)
      EXPECT_EQ(read_cloud(file("a.pcd"), {}, policy).data, cloud.data);
  }
}

// Between the pass that counts rows and the one that reads them.
TEST_F(TextPieces, ThatGrowWhileTheyAreReadAreAnError) {
  constexpr std::size_t points = 200'000;
  write_text(file("a.pcd"), numbered(points, points));
  int passes = 0;
  const Executor appending{2, [&](std::size_t tasks, const std::function<void(std::size_t)>& task) {
                             if (++passes == 2) std::ofstream(file("a.pcd"), std::ios::app) << ' ';
                             for (std::size_t i = 0; i < tasks; ++i)
                               task(i);
                           }};
  EXPECT_THROW(read_cloud(file("a.pcd"), {}, appending), IoError);
  EXPECT_EQ(passes, 2);
  EXPECT_EQ(read_cloud(file("a.pcd")).size(), points);
}

}  // namespace
}  // namespace pcl_bv::detail
