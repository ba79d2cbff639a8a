// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud as one file, and cut into many.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "command.h"

namespace pcl_bv::test {

using Points = std::vector<std::array<float, 3>>;

/// Methods that can be fitted to partial results.
inline const std::string kServed =
    "aabb,dop6,dop14,dop18,dop26,sphere,obb-pca,obb-dito14,obb-min,obb-yaw,prism,cylinder,capsule,ellipsoid,"
    "hull,best";

inline std::string path_of(const std::string& folder, std::size_t number) {
  return folder + '/' + std::string(number < 10 ? "0" : "") + std::to_string(number) + ".pcd";
}

class Tiled : public PcdBv {
 protected:
  /// In the unit ball and beyond, one in a hundred not finite.
  static Points gaussian(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    Points points(count);
    const auto even = [&] { return static_cast<float>(random() % 65536) / 65536.0F - 0.5F; };
    for (auto& p : points) {
      for (float& c : p)
        c = even() + even() + even();
    }
    for (std::size_t i = 50; i < count; i += 100)
      points[i][i % 3] = std::numeric_limits<float>::quiet_NaN();
    return points;
  }

  std::string binary(const std::string& name, const Points& points) const {
    const std::string_view bytes(reinterpret_cast<const char*>(points.data()), points.size() * 12);
    return file(name, header(points.size(), "binary") + std::string(bytes));
  }

  std::string text(const std::string& name, const Points& points) const {
    std::string rows = header(points.size());
    for (const auto& p : points) {
      for (const float c : p) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, c).ptr;
        rows.append(std::isnan(c) ? std::string("nan") : std::string(digits, end)) += ' ';
      }
      rows += '\n';
    }
    return file(name, rows);
  }

  /// Cut at random, some empty and one of one point, some of them as text: the folder.
  std::string tiles(const std::string& folder, const Points& points, std::size_t count) const {
    std::mt19937 random(static_cast<unsigned>(count));
    std::vector<std::size_t> cuts{0, points.size()};
    while (cuts.size() < count + 1)
      cuts.push_back(random() % (points.size() + 1));
    if (count > 4) cuts[2] = cuts[3];
    if (count > 4) cuts[4] = std::min(points.size(), cuts[3] + 1);
    std::sort(cuts.begin(), cuts.end());
    std::filesystem::create_directories(at(folder));
    for (std::size_t i = 0; i < count; ++i) {
      const Points part(points.begin() + static_cast<std::ptrdiff_t>(cuts[i]),
                        points.begin() + static_cast<std::ptrdiff_t>(cuts[i + 1]));
      i % 3 == 2 ? text(path_of(folder, i), part) : binary(path_of(folder, i), part);
    }
    return at(folder);
  }

  /// Adds two inputs that cannot be read to a folder of tiles. The header of one of them is good.
  void add_bad_tiles(const std::string& folder) const {
    file(folder + "/99.pcd", "no cloud");
    file(folder + "/00a.pcd", header(100) + "1 2 3\n1 x 3\n");
  }

  /// Expects one line for each of the inputs of add_bad_tiles(), and no other.
  static void expect_bad_tiles_named(const Result& result, const std::string& folder) {
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, testing::HasSubstr(folder + "/99.pcd: "));
    EXPECT_THAT(result.err, testing::HasSubstr(folder + "/00a.pcd: "));
    EXPECT_EQ(result.error_lines(), 2U);
  }

  /// Writes the shares of the inputs to a folder of their own, which is returned.
  std::string shares(const std::string& name, std::size_t count, const std::vector<std::string>& options,
                     const std::vector<std::string>& inputs) const {
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<std::string> all{"--partial", at(name + "/" + std::to_string(k)), "--part",
                                   std::to_string(k) + "/" + std::to_string(count)};
      all.insert(all.end(), options.begin(), options.end());
      all.insert(all.end(), inputs.begin(), inputs.end());
      const Result result = run(all);
      EXPECT_EQ(result.status, 0) << result.err;
      EXPECT_EQ(result.out, "");
    }
    return at(name);
  }

  /// Expects a number of files with the same names and bytes in two folders.
  static void expect_same_files(const std::string& found, const std::string& expected, std::size_t count) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(expected)) {
      const std::filesystem::path same = std::filesystem::path(found) / entry.path().filename();
      EXPECT_TRUE(std::filesystem::exists(same) && read_file(same) == read_file(entry.path())) << same;
      ++files;
    }
    EXPECT_EQ(files, count);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(found), {}),
              static_cast<std::ptrdiff_t>(count));
  }

  /// Expects the inputs of add_bad_tiles() in a report, with the reasons.
  void expect_bad_tiles_listed(const Json& report, const std::string& folder) const {
    ASSERT_EQ(report["left_out"].size(), 2U);
    EXPECT_EQ(report["left_out"][0]["file"], at(folder + "/00a.pcd"));
    EXPECT_EQ(report["left_out"][1]["file"], at(folder + "/99.pcd"));
    EXPECT_NE(report["left_out"][0]["error"], "");
  }

  /// What a report says of the cloud, whatever it is called.
  static Json found(const Result& result) {
    EXPECT_EQ(result.status, 0) << result.err;
    Json report = result.json();
    report.erase("file");
    report.erase("parts");
    return report;
  }
};

}  // namespace pcl_bv::test
