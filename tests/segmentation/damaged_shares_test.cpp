// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shares whose points are damaged.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "share_scenes.h"

namespace pcl_bv::detail {
namespace {

template <typename T>
class DamagedSharesOf : public testing::Test {};
using ScalarTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(DamagedSharesOf, ScalarTypes);

// A share of which the runs with numbers that have a remainder have changed after it was made.
class DamagedShare final : public ClusterShare {
 public:
  DamagedShare(const ClusterShare& good, std::size_t divisor, std::size_t remainder) : good_(good) {
    std::uint64_t at = 0;
    for (std::size_t r = 0; r < good.runs().size(); ++r) {
      if (r % divisor == remainder) damaged_.push_back(at);
      at += good.runs()[r].points * share_record_bytes(good.scalar());
    }
    first_number = good.first_number;
  }
  ScalarType scalar() const override { return good_.scalar(); }
  const std::vector<ShareRun>& runs() const override { return good_.runs(); }
  const std::vector<ShareComponent>& components() const override { return good_.components(); }
  void read(std::uint64_t first_byte, std::byte* to, std::size_t count) const override {
    good_.read(first_byte, to, count);
    const auto bad = std::lower_bound(damaged_.begin(), damaged_.end(), first_byte);
    if (bad != damaged_.end() && *bad < first_byte + count) to[*bad - first_byte] ^= std::byte{1};
  }

 private:
  const ClusterShare& good_;
  std::vector<std::uint64_t> damaged_;  // first bytes of runs
};

// Each cluster has as many labels as points.
void expect_labels_of_points(std::size_t points, const StoredClusters& joined) {
  std::vector<std::size_t> counts(joined.size());
  for (const std::uint32_t label : joined.labels(0, points))
    if (label != StoredClusters::kNoCluster) ++counts[label];
  for (std::size_t i = 0; i < joined.size(); ++i)
    EXPECT_EQ(counts[i], joined.point_count(i));
}

TYPED_TEST(DamagedSharesOf, LeaveClustersThatAreRightOrIncomplete) {
  std::size_t complete = 0, incomplete = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    test::TestCloud<TypeParam> cloud = scene<TypeParam>(seed);
    std::mt19937_64 random(seed);
    const std::vector<std::size_t> ends = make_tiles(random, cloud);
    const ClusterOptions options = random_options(random);
    SCOPED_TRACE(cloud.name);
    Shares shares;
    std::vector<std::unique_ptr<DamagedShare>> damaged;
    std::vector<const ClusterShare*> all;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      shares.push_back(
          std::make_unique<MadeClusterShare>(cloud.view().slice(ends[i], ends[i + 1] - ends[i]), options));
      damaged.push_back(std::make_unique<DamagedShare>(*shares.back(), 50, 3));
      all.push_back(damaged.back().get());
    }
    StoredClusterOptions store;
    std::uint64_t lost = 0;
    store.on_lost = [&](const ShareError&, std::uint64_t points) { lost += points; };
    store.has_labels = seed % 2 == 0;
    store.points_of_shares = cloud.size();
    const StoredClusters joined(all, options, store);
    if (store.has_labels) expect_labels_of_points(cloud.size(), joined);
    const ClusterBytes found = bytes_of(joined),
                       expected = bytes_of(cloud.view(), cluster(cloud.view(), options));
    const std::set<std::vector<std::byte>> right(expected.begin(), expected.end());
    EXPECT_TRUE(lost > 0 || found == expected);
    for (std::size_t i = 0; i < joined.size(); ++i) {
      EXPECT_TRUE(joined.is_incomplete(i) || right.contains(found[i])) << "cluster " << i;
      ++(joined.is_incomplete(i) ? incomplete : complete);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(incomplete, 100U);
  EXPECT_GT(complete, incomplete);
}

// The lost core point (7.5, 0, 0) is in the cell before its neighbour q, which only the other share's points
// make a core point.
TEST(DamagedShares, LeaveClustersOfBorderPointsNearLostOnesIncomplete) {
  test::TestCloud<double> cloud{"border points", {6.7, 0, 0, 6.9, 0, 0, 7.5, 0, 0, 8.4, 0, 0}};
  for (const auto& [y, z] : {std::pair{1, 0}, {-1, 0}, {0, 1}})
    for (const double at : {0.9, 1.8, 2.6, 2.7})
      cloud.xyz.insert(cloud.xyz.end(), {8.4, at * y, at * z});
  ClusterOptions options;
  options.tolerance = 1;
  options.min_points = 4;
  const MadeClusterShare own(cloud.view().slice(0, 4), options),
      other(cloud.view().slice(4, cloud.size() - 4), options);
  ASSERT_EQ(own.runs().size(), 2U);
  const DamagedShare bad(own, 2, own.runs()[0].points == 3 ? 0 : 1);
  StoredClusterOptions store;
  std::uint64_t lost = 0;
  store.on_lost = [&](const ShareError&, std::uint64_t points) { lost += points; };
  const StoredClusters joined({&bad, &other}, options, store);
  EXPECT_EQ(lost, 3U);
  const ClusterBytes found = bytes_of(joined),
                     expected = bytes_of(cloud.view(), cluster(cloud.view(), options));
  ASSERT_NE(found, expected);
  for (std::size_t i = 0; i < joined.size(); ++i)
    EXPECT_TRUE(joined.is_incomplete(i) || std::count(expected.begin(), expected.end(), found[i]) == 1) << i;
}

TEST(DamagedShares, AreNamed) {
  const test::TestCloud<float> cloud = two_clumps_and_a_line();
  ClusterOptions options;
  options.tolerance = 0.5F;
  const MadeClusterShare good(cloud.view().slice(0, 150), options),
      other(cloud.view().slice(150, 150), options);
  const DamagedShare bad(other, 4, 3);
  try {
    const StoredClusters joined({&good, &bad}, options);
    FAIL() << "no error";
  } catch (const ShareError& error) {
    EXPECT_EQ(error.share(), 1U);
    EXPECT_STREQ(error.what(), "its points are damaged");
  }
}

TEST(DamagedShares, WithNumbersThatDoNotFitInARecordAreNamed) {
  const test::TestCloud<float> cloud = two_clumps_and_a_line();
  ClusterOptions options;
  options.tolerance = 0.5F;
  const MadeClusterShare good(cloud.view().slice(0, 150), options);
  MadeClusterShare bad(cloud.view().slice(150, 150), options);
  for (const unsigned bit : {61U, 62U, 63U}) {  // of marks in a record
    bad.first_number = std::uint64_t{1} << bit;
    try {
      const StoredClusters joined({&good, &bad}, options);
      FAIL() << "no error for bit " << bit;
    } catch (const ShareError& error) {
      EXPECT_EQ(error.share(), 1U);
      EXPECT_STREQ(error.what(), "has numbers of points that are too large");
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
