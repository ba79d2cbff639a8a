// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

#include "copc_files.h"
#include "files.h"
#include "las_bytes.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

class Copc : public FileTest {
 protected:
  void SetUp() override {
    write_text(file("a.las"), made_.las);
    write_text(file("a.copc.laz"), made_.copc);
  }

  RawCloud read(const BoxPredicate& can_skip) const {
    return read_las(file("a.copc.laz"), Threads{2}, can_skip);
  }

  // Skips nodes with x > 0.
  RawCloud read_with_gaps(const std::string& bytes) const {
    write_text(file("b.laz"), bytes);
    return read_las(file("b.laz"), Serial{}, [](const LasBox& box) { return box.low[0] > -1; });
  }

  static constexpr const char* kMismatch =
      "the COPC octree does not match the table of chunks; all points are read";

  const std::vector<CopcNode> nodes_{
      {0, {0, 0, 0}, 100},      {1, {0, 0, 0}, 50},       {1, {1, 1, 1}, 70},     {1, {1, 0, 0}, 0},
      {2, {3, 3, 3}, 20, true}, {2, {0, 1, 0}, 30, true}, {3, {7, 7, 7}, 1, true}};
  const CopcFile made_ = make_copc(nodes_, folder());
};

TEST_F(Copc, HasThePointsOfTheLasFileInTheOrderOfTheFile) {
  const RawCloud cloud = read_cloud(file("a.copc.laz"), {}, Threads{2});
  EXPECT_EQ(cloud.size(), 271U);
  EXPECT_TRUE(cloud.data == read_cloud(file("a.las")).data);
  EXPECT_EQ(cloud.note, "");
  EXPECT_TRUE(read({}).data == cloud.data);
}

TEST_F(Copc, SkippedNodesHaveTheirCentreForEachPoint) {
  const RawCloud all = read_cloud(file("a.las"));
  std::size_t asked = 0;
  const RawCloud some = read([&](const LasBox& box) {
    ++asked;
    return box.low[0] > -1;  // those with x > 0
  });
  EXPECT_EQ(asked, 6U);
  EXPECT_EQ(some.note, "");
  ASSERT_EQ(some.size(), all.size());
  std::size_t i = 0, skipped = 0;
  for (const CopcNode& node : nodes_) {
    const bool is_skipped = node.low(0) > -1;
    for (const std::size_t end = i + node.points; i < end; ++i) {
      const std::byte* const record = some.data.data() + i * some.point_step;
      if (!is_skipped) {
        ASSERT_EQ(std::memcmp(record, all.data.data() + i * all.point_step, all.point_step), 0) << i;
        continue;
      }
      ++skipped;
      const Coordinates p = load_point(some.xyz(), i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(p[axis], node.low(axis) + node.side() / 2, 1e-9) << i;
      for (std::size_t k = 24; k < some.point_step; ++k)
        ASSERT_EQ(record[k], std::byte{0}) << i;
    }
  }
  EXPECT_EQ(skipped, 91U);
}

TEST_F(Copc, BoxesHaveAllPointsOfTheirNodes) {
  std::vector<LasBox> boxes;
  read([&](const LasBox& box) {
    boxes.push_back(box);
    return false;
  });
  const RawCloud all = read_cloud(file("a.las"));
  std::size_t i = 0, node = 0;
  for (const CopcNode& n : nodes_) {
    for (const std::size_t end = i + n.points; i < end; ++i) {
      const Coordinates p = load_point(all.xyz(), i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_TRUE(p[axis] >= boxes[node].low[axis] && p[axis] <= boxes[node].high[axis]) << i;
    }
    node += n.points > 0 ? 1 : 0;
  }
}

// Each value of each entry. A tree is used only if it has each chunk once, so that a note comes with all
// points.
TEST_F(Copc, WithAnInvalidTreeIsReadCompletely) {
  const RawCloud all = read_cloud(file("a.las"));
  const std::size_t words = (made_.copc.size() - made_.first_entry) / 4;
  std::size_t refused = 0;
  for (std::size_t word = 0; word < words; ++word) {
    for (const std::int32_t value : {-2, -1, 0x7FFFFFFF}) {
      std::string bytes = made_.copc;
      LasFile::put(bytes, made_.first_entry + 4 * word, value);
      const RawCloud cloud = read_with_gaps(bytes);
      ASSERT_EQ(cloud.data.size(), all.data.size()) << word << ", " << value;
      if (cloud.note.empty()) continue;
      ASSERT_EQ(cloud.note, kMismatch);
      ASSERT_TRUE(cloud.data == all.data) << word << ", " << value;
      ++refused;
    }
  }
  EXPECT_EQ(words, 64U);
  EXPECT_GT(refused, 160U);  // nodes without points may be anywhere
}

TEST_F(Copc, WhoseTreeHasAChunkTwiceAndAnotherNeverIsReadCompletely) {
  const RawCloud all = read_cloud(file("a.las"));
  const auto copied = [&](std::size_t from, std::size_t to) {
    std::string bytes = made_.copc;
    return bytes.replace(made_.first_entry + 32 * to, 32, made_.copc, made_.first_entry + 32 * from, 32);
  };
  EXPECT_FALSE(read_with_gaps(made_.copc).data == all.data);
  for (const auto& [from, to] : {std::pair{3, 4}, {3, 5}, {0, 1}, {5, 0}}) {
    const RawCloud cloud =
        read_with_gaps(copied(static_cast<std::size_t>(from), static_cast<std::size_t>(to)));
    EXPECT_EQ(cloud.note, kMismatch) << from << " to " << to;
    EXPECT_TRUE(cloud.data == all.data) << from << " to " << to;
  }
}

TEST_F(Copc, WhoseCubeDoesNotContainTheBoundsIsReadCompletely) {
  const RawCloud all = read_cloud(file("a.las"));
  constexpr std::size_t info = 375 + 54;
  for (const auto& [at, value] : {std::pair{0, 1.0}, {8, -1.0}, {16, 128.0}, {24, 63.9}}) {
    std::string bytes = made_.copc;
    LasFile::put(bytes, info + static_cast<std::size_t>(at), value);
    const RawCloud cloud = read_with_gaps(bytes);
    EXPECT_EQ(cloud.note,
              "the COPC cube does not contain the bounding box of the header; all points are read");
    EXPECT_TRUE(cloud.data == all.data) << at;
  }
}

// Memory for more than 32 points per byte is taken step by step, also if nodes are skipped.
TEST_F(Copc, OfManyEqualPointsHasSkippedNodesToo) {
  const CopcFile made = make_copc({{1, {0, 0, 0}, 200'000, false, true}, {1, {1, 1, 1}, 50}}, folder());
  write_text(file("b.las"), made.las);
  const RawCloud all = read_cloud(file("b.las")), cloud = read_with_gaps(made.copc);
  ASSERT_EQ(cloud.data.size(), all.data.size());
  EXPECT_EQ(cloud.note, "");
  const std::size_t first = 200'000 * all.point_step;
  EXPECT_EQ(std::memcmp(cloud.data.data(), all.data.data(), first), 0);
  for (std::size_t i = 200'000; i < all.size(); ++i) {
    const Coordinates p = load_point(cloud.xyz(), i);
    ASSERT_TRUE(p.x == 32 && p.y == 32 && p.z == 32) << i;
  }
}

TEST_F(Copc, WhosePagesNameEachOtherIsReadCompletely) {
  std::string bytes = made_.copc;
  const std::size_t link = bytes.size() - 32;  // the entry with the second page
  LasFile::put<std::uint64_t>(bytes, link + 16, made_.first_entry + 3 * 32);
  LasFile::put<std::int32_t>(bytes, link + 24, 5 * 32);
  write_text(file("b.laz"), bytes);
  const RawCloud cloud = read_las(file("b.laz"), Serial{}, [](const LasBox&) { return true; });
  EXPECT_TRUE(cloud.data == read_cloud(file("a.las")).data);
}

}  // namespace
}  // namespace pcl_bv::detail
