// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Many inputs as one source of points.

#include "commands/pcd_bv/tiles.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "tiles.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

class TilesTest : public Tiled {
 protected:
  static Tiles open(const std::vector<std::string>& files, std::size_t threads = 1) {
    std::vector<Job> jobs;
    std::vector<TileHeader> headers;
    for (const std::string& file : files) {
      jobs.push_back({file});
      headers.push_back(describe_tile(jobs.back()));
    }
    return {std::move(jobs), std::move(headers), threads};
  }

  static std::vector<std::string> files_of(const std::string& folder, std::size_t count) {
    std::vector<std::string> files;
    for (std::size_t i = 0; i < count; ++i)
      files.push_back(path_of(folder, i));
    return files;
  }

  static std::size_t open_files() {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
  }
};

// Any NaN is as good as another.
bool same(const PointView& loaded, const Points& points, std::size_t first) {
  for (std::size_t i = 0; i < loaded.count; ++i) {
    const Coordinates p = load_point(loaded, i);
    const double xyz[3] = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const float wanted = points[first + i][k];
      if (std::isnan(wanted) ? !std::isnan(xyz[k]) : xyz[k] != wanted) return false;
    }
    if (loaded.index(i) != first + i) return false;
  }
  return true;
}

TEST_F(TilesTest, LoadWhatOneFileHoldsWhateverBordersAreInBetween) {
  const Points points = gaussian(200'000, 1);
  const Tiles all = open(files_of(tiles("tiles", points, 25), 25));
  ASSERT_EQ(all.xyz().count, points.size());
  EXPECT_EQ(all.xyz().scalar, ScalarType::float32);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const std::size_t first = random() % points.size();
    const std::size_t count = std::min<std::size_t>(random() % kChunkPoints, points.size() - first);
    const LoadedPoints part(all.xyz(), first, count);
    ASSERT_EQ(part.view().count, count);
    ASSERT_TRUE(same(part.view(), points, first)) << first << ' ' << count;
  }
}

TEST_F(TilesTest, ServeManyThreadsAndKeepFewFilesOpen) {
  const Points points = gaussian(300'000, 2);
  const Tiles all = open(files_of(tiles("tiles", points, 90), 90), 4);
  const std::size_t before = open_files();
  std::vector<char> good(chunk_count(points.size()));
  for (int pass = 0; pass < 3; ++pass) {
    for_each_chunk(Threads{4}, good.size(), [&](std::size_t chunk) {
      const LoadedPoints part = load_chunk(all.xyz(), chunk);
      good[chunk] = same(part.view(), points, chunk * kChunkPoints);
    });
    EXPECT_EQ(std::count(good.begin(), good.end(), 1), static_cast<std::ptrdiff_t>(good.size()));
  }
  EXPECT_LE(open_files(), before + 5);
}

TEST_F(TilesTest, SharesCoverTheCloudOnceAndBeginWhereChunksAndFilesDo) {
  const Points points = gaussian(500'000, 3);
  const std::string folder = at("tiles");
  std::filesystem::create_directories(folder);
  binary(path_of("tiles", 0), Points(points.begin(), points.begin() + 300'000));
  text(path_of("tiles", 1), Points(points.begin() + 300'000, points.begin() + 450'000));
  binary(path_of("tiles", 2), Points(points.begin() + 450'000, points.end()));
  const Tiles all = open(files_of(folder, 3));
  for (const std::size_t count : {1UL, 2UL, 3UL, 7UL, 64UL, 1000UL}) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const PointRange share = all.share(i, count);
      EXPECT_EQ(share.first, end);
      EXPECT_LE(share.first, share.second);
      EXPECT_LE(share.second - share.first, 500'000 / count + 150'000);
      end = share.second;
      if (end == 300'000 || end == 500'000) continue;  // the text file, and the cloud, end there
      if (end > 300'000) {
        EXPECT_GE(end, 450'000);  // no share ends within the text file
      }
      EXPECT_EQ((end < 300'000 ? end : end - 450'000) % kChunkPoints, 0) << end;
    }
    EXPECT_EQ(end, points.size());
  }
}

TEST_F(TilesTest, NameTheFileThatIsNoLongerWhatItWas) {
  const Points points = gaussian(100'000, 4);
  const std::string a = binary("a.pcd", points),
                    b = text("b.pcd", Points(points.begin(), points.begin() + 50)),
                    c = binary("c.pcd", points);
  const auto fails = [](const Tiles& tiles, std::size_t first) -> std::optional<std::size_t> {
    try {
      LoadedPoints(tiles.xyz(), first, 10);
      tiles.require_unchanged();
      return std::nullopt;
    } catch (const TileError& error) {
      EXPECT_STREQ(error.what(), "the file was changed while it was read");
      return error.tile();
    }
  };
  const Tiles all = open({a, b, c});
  EXPECT_EQ(fails(all, 0), std::nullopt);
  EXPECT_EQ(fails(all, 100'000), std::nullopt);
  EXPECT_EQ(fails(all, 100'050), std::nullopt);
  text("b.pcd", Points(points.begin() + 50, points.begin() + 100));  // found when all is done
  EXPECT_EQ(fails(all, 0), 1U);
  const Tiles others = open({a, b, c});
  text("b.pcd", Points(points.begin(), points.begin() + 51));  // found when it is read first
  EXPECT_EQ(fails(others, 100'000), 1U);
}

TEST_F(TilesTest, LeavesOutAFileAndNumbersTheRestAnew) {
  const Points points = gaussian(1000, 5);
  Tiles all = open({binary("a.pcd", Points(points.begin(), points.begin() + 400)),
                    binary("b.pcd", Points(points.begin() + 400, points.begin() + 500)),
                    binary("c.pcd", Points(points.begin() + 500, points.end())), at("nowhere.pcd")});
  EXPECT_EQ(all.included_count(), 3U);
  all.exclude(1, "for a test");
  EXPECT_EQ(all.included_count(), 2U);
  ASSERT_EQ(all.xyz().count, 900U);
  const LoadedPoints part(all.xyz(), 400, 500);
  Points rest(points.begin(), points.begin() + 400);
  rest.insert(rest.end(), points.begin() + 500, points.end());
  EXPECT_TRUE(same(part.view(), rest, 400));
}

}  // namespace
}  // namespace pcl_bv::test
