// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds that stay in their file hold the same points as those that are read, in little memory.
#include "pcl_bv/io/cloud_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <fstream>

#include "allocations.h"
#include "files.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/io/read_cloud.h"
#include "sample_clouds.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kPoints = kChunkPoints + 1000;

class CloudInFile : public FileTest {
 protected:
  std::filesystem::path write(const RawCloud& cloud, PcdEncoding encoding = PcdEncoding::binary) const {
    write_pcd(file("a.pcd"), cloud, encoding);
    return file("a.pcd");
  }

  static std::string reason_for_open(const std::filesystem::path& path) {
    try {
      CloudFile::open(path);
    } catch (const IoError& error) {
      return error.what();
    }
    return "";
  }
};

void expect_same_points(const PointView& in_file, const PointView& held) {
  ASSERT_EQ(in_file.count, held.count);
  ASSERT_EQ(in_file.scalar, held.scalar);
  for (const auto& [begin, count] : {std::pair<std::size_t, std::size_t>{0, kChunkPoints},
                                     {kChunkPoints, kPoints - kChunkPoints},
                                     {12'345, 1},
                                     {kPoints - 1, 1}}) {
    const LoadedPoints part(in_file, begin, count);
    ASSERT_EQ(part.view().count, count);
    for (std::size_t i = 0; i < count; ++i) {
      const Coordinates a = load_point(part.view(), i), b = load_point(held, begin + i);
      ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0) << begin + i;  // NaN too
      ASSERT_EQ(part.view().index(i), begin + i);
    }
  }
}

std::vector<Layout> layouts() {
  std::vector<Layout> all = sample_layouts();
  // Records of 3 kB, more than what is read at a time holds of a chunk, with y before x and z far behind.
  all.push_back(
      {"long",
       {{"y", 'F', 4, 1, 0}, {"histogram", 'F', 8, 380, 0}, {"x", 'F', 4, 1, 0}, {"z", 'F', 4, 1, 0}}});
  all.push_back({"doubles in a row",
                 {{"ring", 'U', 2, 1, 0}, {"x", 'F', 8, 1, 0}, {"y", 'F', 8, 1, 0}, {"z", 'F', 8, 1, 0}}});
  return all;
}

TEST_F(CloudInFile, HoldsThePointsOfEveryLayout) {
  for (const Layout& layout : layouts()) {
    SCOPED_TRACE(layout.name);
    const RawCloud cloud = sample_cloud(layout, kPoints, 1, 3);
    const std::filesystem::path path = write(cloud);
    const auto opened = CloudFile::open(path);
    ASSERT_NE(opened, nullptr);
    EXPECT_EQ(opened->header().size(), kPoints);
    EXPECT_EQ(opened->header().fields.size(), cloud.fields.size());
    EXPECT_TRUE(opened->header().data.empty());
    const RawCloud held = read_cloud(path);
    expect_same_points(opened->xyz(), held.xyz());
  }
}

TEST_F(CloudInFile, HoldsThePointsOfAKittiSweep) {
  const RawCloud cloud = sample_cloud(sample_layouts()[1], kPoints, 1, 9);
  write_text(file("1.BIN"), {reinterpret_cast<const char*>(cloud.data.data()), cloud.data.size()});
  const auto opened = CloudFile::open(file("1.BIN"));
  ASSERT_NE(opened, nullptr);
  expect_same_points(opened->xyz(), cloud.xyz());
}

TEST_F(CloudInFile, IsNoneWhereAllMustBeReadOrLittleIsThere) {
  const Layout& layout = sample_layouts()[0];
  EXPECT_EQ(CloudFile::open(write(sample_cloud(layout, kPoints, 1, 1), PcdEncoding::ascii)), nullptr);
  EXPECT_EQ(CloudFile::open(write(sample_cloud(layout, kPoints, 1, 1), PcdEncoding::binary_compressed)),
            nullptr);
  EXPECT_EQ(CloudFile::open(write(sample_cloud(layout, kChunkPoints, 1, 1))), nullptr);
  EXPECT_EQ(CloudFile::open(write(sample_cloud(layout, 0, 1, 1))), nullptr);
}

TEST_F(CloudInFile, IsRefusedForTheReasonsOfReading) {
  const std::filesystem::path path = write(sample_cloud(sample_layouts()[0], kPoints, 1, 1));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_EQ(reason_for_open(path), reason_for(path));
  EXPECT_NE(reason_for_open(path).find("truncated"), std::string::npos);
  EXPECT_EQ(reason_for_open(file("gone.pcd")), "no such file or directory");
  EXPECT_EQ(reason_for_open(folder()), "is a directory");
  write_text(file("odd.bin"), "12345");
  EXPECT_EQ(reason_for_open(file("odd.bin")), reason_for(file("odd.bin")));
}

TEST_F(CloudInFile, ThatIsCutWhileItIsReadIsAnError) {
  const std::filesystem::path path = write(sample_cloud(sample_layouts()[0], kPoints, 1, 1));
  const auto opened = CloudFile::open(path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  for (const Execution& execution : {Execution{}, Execution{OpenMP{2}}}) {
    AnyVolume box;
    try {
      box = *find_method("dop26")->fit(opened->xyz(), {}, execution);
      FAIL();
    } catch (const IoError& error) {
      EXPECT_STREQ(error.what(), "truncated: the file became shorter while it was read");
    }
  }
}

// Overwrites the last byte of a file, or appends one, until its status tells: the clock of files has ticks.
void change_in_place(const std::filesystem::path& path, long from_end) {
  const auto changed = [&path] {
    struct stat status;
    EXPECT_EQ(::stat(path.c_str(), &status), 0);
    return std::pair(status.st_ctim.tv_sec, status.st_ctim.tv_nsec);
  };
  const auto before = changed();
  while (changed() == before) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(from_end, std::ios::end).put('x');
  }
}

std::string reason_for_fit(const CloudFile& cloud) {
  try {
    AnyVolume box = *find_method("aabb")->fit(cloud.xyz());
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST_F(CloudInFile, ThatIsRewrittenWhileItIsReadIsAnError) {
  const RawCloud cloud = sample_cloud(sample_layouts()[0], kPoints, 1, 1);
  for (const long from_end : {-1, 0}) {
    const std::filesystem::path path = write(cloud);
    const auto opened = CloudFile::open(path);
    EXPECT_EQ(reason_for_fit(*opened), "");
    change_in_place(path, from_end);
    EXPECT_EQ(reason_for_fit(*opened), "the file was changed while it was read");
  }
}

TEST_F(CloudInFile, ThatIsRewrittenByOneWhoHidesItIsAnErrorToo) {
  const std::filesystem::path path = write(sample_cloud(sample_layouts()[0], kPoints, 1, 1));
  const auto written = std::filesystem::last_write_time(path);
  const auto opened = CloudFile::open(path);
  change_in_place(path, -1);
  std::filesystem::last_write_time(path, written);
  EXPECT_EQ(reason_for_fit(*opened), "the file was changed while it was read");
}

// With what other writers can hide: the size is the same, st_mtim put back, and st_ctim counts for nothing
// once the file has another link.
void rewrite_unseen(const std::filesystem::path& path, std::string content) {
  const auto written = std::filesystem::last_write_time(path);
  ASSERT_EQ(content.size(), std::filesystem::file_size(path));
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << content;
  std::filesystem::last_write_time(path, written);
  std::filesystem::create_hard_link(path, path.string() + ".link");
}

constexpr char kChanged[] = "the file was changed while it was read";

TEST_F(CloudInFile, ThatIsRewrittenBetweenPassesUnseenIsAnErrorWhateverItsLayout) {
  for (const Layout& layout : layouts()) {
    SCOPED_TRACE(layout.name);
    const std::filesystem::path path = write(sample_cloud(layout, kPoints, 1, 2));
    const std::string other = file_content(path);
    write(sample_cloud(layout, kPoints, 1, 1));
    const auto opened = CloudFile::open(path);
    EXPECT_EQ(reason_for_fit(*opened), "");
    rewrite_unseen(path, other);
    opened->require_unchanged();
    EXPECT_EQ(reason_for_fit(*opened), kChanged);
    std::filesystem::remove(path.string() + ".link");
  }
}

TEST_F(CloudInFile, IsTheSameForEachPassOfManyThreadsAndNotAfterItWasRewritten) {
  const std::filesystem::path path = write(sample_cloud(sample_layouts()[0], 5 * kPoints, 1, 2));
  const std::string other = file_content(path);
  write(sample_cloud(sample_layouts()[0], 5 * kPoints, 1, 1));
  const auto opened = CloudFile::open(path);
  const Execution four{Threads{4}};
  AnyVolume box;
  for (int pass = 0; pass < 10; ++pass)
    box = *find_method("aabb")->fit(opened->xyz(), {}, four);
  EXPECT_EQ(verify(box, opened->xyz(), four).outside, 0U);
  rewrite_unseen(path, other);
  EXPECT_THROW(verify(box, opened->xyz(), four), IoError);
}

TEST_F(CloudInFile, KnowsEveryBlockAgainHoweverItIsCut) {
  const std::filesystem::path path = write(sample_cloud(sample_layouts()[0], kPoints, 1, 2));
  const std::string other = file_content(path);
  write(sample_cloud(sample_layouts()[0], kPoints, 1, 1));
  const auto opened = CloudFile::open(path);
  EXPECT_EQ(reason_for_fit(*opened), "");
  const PointView points = opened->xyz();
  const auto load = [&](std::size_t first, std::size_t count) { LoadedPoints(points, first, count); };
  const std::vector<std::pair<std::size_t, std::size_t>> cuts = {{0, kBlockPoints},
                                                                 {5 * kBlockPoints, kBlockPoints},
                                                                 {100, 2 * kBlockPoints},
                                                                 {kChunkPoints, kPoints - kChunkPoints}};
  for (const auto& [first, count] : cuts)
    EXPECT_NO_THROW(load(first, count)) << first;
  rewrite_unseen(path, other);
  for (const auto& [first, count] : cuts)
    EXPECT_THROW(load(first, count), IoError) << first;
}

TEST_F(CloudInFile, SaysInTheEndWhetherItWasChanged) {
  for (const long from_end : {-1, 0}) {
    const std::filesystem::path path = write(sample_cloud(sample_layouts()[0], kPoints, 1, 1));
    const auto opened = CloudFile::open(path);
    EXPECT_NO_THROW(opened->require_unchanged());
    change_in_place(path, from_end);
    EXPECT_THROW(opened->require_unchanged(), IoError);
  }
}

TEST_F(CloudInFile, ThatAnotherTakesThePlaceOfIsReadToItsEnd) {
  const RawCloud cloud = sample_cloud(sample_layouts()[0], kPoints, 1, 1);
  const std::filesystem::path path = write(cloud);
  const auto opened = CloudFile::open(path);
  write(sample_cloud(sample_layouts()[0], kPoints, 1, 2));
  EXPECT_EQ(reason_for_fit(*opened), "");
  expect_same_points(opened->xyz(), cloud.xyz());
}

TEST_F(CloudInFile, IsFittedInLittleMemory) {
  const std::vector<Layout> all = layouts();
  const Layout& layout = all[all.size() - 2];
  const std::filesystem::path path = write(sample_cloud(layout, kPoints, 1, 4));
  ASSERT_GT(std::filesystem::file_size(path), 100'000'000U);
  largest_allocation = 0;
  const auto opened = CloudFile::open(path);
  for (const char* name : {"aabb", "dop26", "sphere-exact", "sphere-epos26", "obb-pca", "obb-dito14"}) {
    AnyVolume volume = *find_method(name)->fit(opened->xyz());
  }
  EXPECT_LT(largest_allocation, 2'000'000U);
}

TEST_F(CloudInFile, HasAHeaderThatSaysHowManyPointsWithoutReadingThem) {
  const RawCloud cloud = sample_cloud({"doubles", {{"x", 'F', 8}, {"y", 'F', 8}, {"z", 'F', 8}}}, 30, 4, 9);
  for (const PcdEncoding encoding :
       {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed}) {
    const CloudHeader header = read_cloud_header(write(cloud, encoding));
    EXPECT_EQ(header.cloud.size(), 120U);
    EXPECT_EQ(header.cloud.data.size(), 0U);
    EXPECT_EQ(header.scalar, ScalarType::float64);
    EXPECT_EQ(header.random_access, encoding == PcdEncoding::binary);
  }
  std::ofstream(file("a.bin"), std::ios::binary) << std::string(160, '\0');
  EXPECT_EQ(read_cloud_header(file("a.bin")).cloud.size(), 10U);
  EXPECT_EQ(read_cloud_header(file("a.bin"), {5}).cloud.size(), 8U);
  EXPECT_TRUE(read_cloud_header(file("a.bin")).random_access);
  std::ofstream(file("a.ply"))
      << "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n";
  EXPECT_EQ(read_cloud_header(file("a.ply")).cloud.size(), 7U);
  EXPECT_FALSE(read_cloud_header(file("a.ply")).random_access);
}

TEST_F(CloudInFile, HasAHeaderOnlyIfItHoldsAllPoints) {
  const RawCloud cloud = sample_cloud({"floats", {{"x"}, {"y"}, {"z"}}}, 30, 4, 9);
  const auto path = write(cloud);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_THROW(read_cloud_header(path), IoError);
  EXPECT_THROW(read_cloud_header(file("nowhere.pcd")), IoError);
  EXPECT_THROW(read_cloud_header(file("a.obj")), IoError);
}

}  // namespace
}  // namespace pcl_bv::detail
