// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters of shares, when they are joined, are those of the whole cloud.

#include "pcl_bv/segmentation/cluster_share.h"

#include <gtest/gtest.h>

#include <barrier>
#include <map>
#include <numeric>
#include <set>
#include <thread>

#include "stored_scenes.h"

namespace pcl_bv::detail {
namespace {

// Sorts the points of a cloud by tile, and returns where the tiles begin and end.
template <typename T>
std::vector<std::size_t> make_tiles(std::mt19937_64& random, test::TestCloud<T>& cloud) {
  const std::size_t tiles = 1 + random() % 8, kind = random() % 3;
  const double side = std::pow(10, std::uniform_real_distribution<double>(-0.5, 2)(random));
  std::vector<std::size_t> tile(cloud.size()), order(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double x = cloud.xyz[3 * i], y = cloud.xyz[3 * i + 1];
    const double square = std::isnan(x) ? 0 : std::floor(x / side) * 7 + std::floor(y / side) * 3;
    const std::size_t by_square = static_cast<std::size_t>(static_cast<std::int64_t>(square) + (1 << 20));
    tile[i] = (kind == 0 ? by_square : kind == 1 ? random() : i * tiles / cloud.size()) % tiles;
  }
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tile[a] < tile[b]; });
  test::TestCloud<T> sorted{
      cloud.name + ", " + std::to_string(tiles) + " tiles of kind " + std::to_string(kind), {}};
  std::vector<std::size_t> ends{0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto from = cloud.xyz.begin() + static_cast<std::ptrdiff_t>(3 * order[i]);
    sorted.xyz.insert(sorted.xyz.end(), from, from + 3);
    if (i + 1 == order.size() || tile[order[i]] != tile[order[i + 1]]) ends.push_back(i + 1);
  }
  cloud = sorted;
  return ends;
}

ClusterOptions random_options(std::mt19937_64& random) {
  ClusterOptions options;
  options.tolerance =
      static_cast<float>(std::pow(10, std::uniform_real_distribution<double>(-1.2, 0.5)(random)));
  options.min_size = random() % 2 == 0 ? 1 : 10;
  options.min_points = std::array{1, 2, 4, 8}[random() % 4];
  if (random() % 4 == 0) options.max_size = 300;
  return options;
}

using Shares = std::vector<std::unique_ptr<MadeClusterShare>>;

std::vector<const ClusterShare*> pointers(const Shares& shares) {
  std::vector<const ClusterShare*> all;
  for (const auto& share : shares)
    all.push_back(share.get());
  return all;
}

// A cluster that is a component of a share has the points of that component.
void expect_components_to_match(const Shares& shares, ClusterOptions options, const StoredClusters& joined) {
  options.min_size = 1;
  options.oversized = Oversized::keep;
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const StoredClusters alone({shares[s].get()}, options);
    std::map<std::uint32_t, std::size_t> number;  // of the component, to the number in `alone`
    for (std::size_t i = 0; i < alone.size(); ++i)
      number[alone.component(i).value().number] = i;
    EXPECT_EQ(number.size(), shares[s]->components().size());
    const ClusterBytes of_share = bytes_of(alone), of_all = bytes_of(joined);
    for (std::size_t i = 0; i < joined.size(); ++i) {
      const auto component = joined.component(i);
      if (component && component->share == s) {
        EXPECT_EQ(of_all[i], of_share[number.at(component->number)]);
      }
    }
  }
}

template <typename T>
class ClusterSharesOf : public testing::Test {};
using ScalarTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(ClusterSharesOf, ScalarTypes);

TYPED_TEST(ClusterSharesOf, AreJoinedToThoseOfTheWholeCloudForAnyTilingAndOrder) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    test::TestCloud<TypeParam> cloud = scene<TypeParam>(seed);
    std::mt19937_64 random(seed);
    const std::vector<std::size_t> ends = make_tiles(random, cloud);
    const ClusterOptions options = random_options(random);
    SCOPED_TRACE(testing::Message() << cloud.name << ", min_points " << options.min_points << ", tolerance "
                                    << options.tolerance);
    const std::size_t in_memory = std::array{1U, 40U, 1U << 20U}[random() % 3];
    Shares shares;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const bool own_numbers = seed % 2 == 0;
      PointView part = cloud.view().slice(ends[i], ends[i + 1] - ends[i]);
      if (own_numbers) part.first = 0;
      shares.push_back(
          std::make_unique<MadeClusterShare>(part, options, StoredClusterOptions{in_memory, {}}));
      if (own_numbers) shares.back()->first_number = ends[i];
    }
    std::shuffle(shares.begin(), shares.end(), random);
    const StoredClusters joined(pointers(shares), options, {in_memory, {}});
    const Clusters expected = cluster(cloud.view(), options);
    EXPECT_EQ(bytes_of(joined), bytes_of(cloud.view(), expected));
    EXPECT_EQ(joined.counts().small, expected.small_points);
    EXPECT_EQ(joined.counts().large, expected.large_points);
    EXPECT_EQ(joined.counts().noise, expected.noise_points);
    expect_components_to_match(shares, options, joined);
    if (testing::Test::HasFailure()) return;
  }
}

// Makes all shares at the same time, each in a thread, with records only where other shares are near.
template <typename T>
class SharesThatTalk {
 public:
  SharesThatTalk(const PointView& points, const std::vector<std::size_t>& ends, const ClusterOptions& options,
                 std::size_t in_memory)
      : visited_(ends.size() - 1),
        sent_(ends.size() - 1),
        all_here_(static_cast<std::ptrdiff_t>(sent_.size())) {
    shares_.resize(sent_.size());
    std::vector<std::thread> threads;
    for (std::size_t s = 0; s < sent_.size(); ++s)
      threads.emplace_back([&, s] {
        StoredClusterOptions store{in_memory, {}};
        store.visit = [&, s](std::size_t brick, const std::vector<PointView>& clusters, const Execution&) {
          ClusterBytes& bytes = visited_[s][brick];
          for (const PointView& cluster : clusters)
            append_bytes(cluster, bytes.emplace_back());
        };
        ShareRecords records;
        records.gather = [&, s](const std::vector<std::uint64_t>& own) { return gather(s, own); };
        shares_[s] = std::make_unique<MadeClusterShare>(points.slice(ends[s], ends[s + 1] - ends[s]), options,
                                                        store, Serial{}, records);
      });
    for (std::thread& thread : threads)
      thread.join();
  }

  const Shares& shares() const { return shares_; }

  // Returns the points of the clusters: those that were visited, or those in the shares.
  ClusterBytes bytes_of(const StoredClusters& joined) const {
    ClusterBytes all;
    for (std::size_t i = 0; i < joined.size(); ++i) {
      const auto component = joined.component(i);
      const auto visit = component ? shares_[component->share]->visit(component->number) : std::nullopt;
      if (visit)
        all.push_back(visited_[component->share].at(visit->brick)[visit->number]);
      else
        append_bytes(joined.points(i).view(), all.emplace_back());
    }
    return all;
  }

 private:
  std::vector<std::uint64_t> gather(std::size_t share, const std::vector<std::uint64_t>& own) {
    sent_[share] = own;
    all_here_.arrive_and_wait();
    std::vector<std::uint64_t> others;
    for (std::size_t s = 0; s < sent_.size(); ++s)
      if (s != share) others.insert(others.end(), sent_[s].begin(), sent_[s].end());
    all_here_.arrive_and_wait();
    return others;
  }

  Shares shares_;
  std::vector<std::map<std::size_t, ClusterBytes>> visited_;  // of each share, by brick
  std::vector<std::vector<std::uint64_t>> sent_;
  std::barrier<> all_here_;
};

TYPED_TEST(ClusterSharesOf, NeedOnlyThePointsNearOtherShares) {
  std::uint64_t unwritten = 0, points = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    test::TestCloud<TypeParam> cloud = scene<TypeParam>(seed);
    std::mt19937_64 random(seed);
    const std::vector<std::size_t> ends = make_tiles(random, cloud);
    const ClusterOptions options = random_options(random);
    const std::size_t in_memory = std::array{40U, 1U << 20U}[random() % 2];
    SCOPED_TRACE(testing::Message() << cloud.name << ", min_points " << options.min_points << ", tolerance "
                                    << options.tolerance);
    const SharesThatTalk<TypeParam> all(cloud.view(), ends, options, in_memory);
    StoredClusterOptions known{in_memory, {}};
    known.is_known = [&](const ComponentOfShare& c) {
      return all.shares()[c.share]->visit(c.number).has_value();
    };
    const StoredClusters joined(pointers(all.shares()), options, known);
    const Clusters expected = cluster(cloud.view(), options);
    EXPECT_EQ(all.bytes_of(joined), bytes_of(cloud.view(), expected));
    EXPECT_EQ(joined.counts().small, expected.small_points);
    EXPECT_EQ(joined.counts().large, expected.large_points);
    EXPECT_EQ(joined.counts().noise, expected.noise_points);
    if (testing::Test::HasFailure()) return;
    points += cloud.size();
    for (const auto& share : all.shares())
      for (const ShareRun& run : share->runs())
        unwritten += run.check_sum == 0 ? run.points : 0;
  }
  EXPECT_GT(unwritten, points / 8);
}

TYPED_TEST(ClusterSharesOf, AreJoinedToThoseOfTheWholeCloudOnNastyClouds) {
  for_each_nasty_clustering<TypeParam>([](const PointView& points, const ClusterOptions& options) {
    const std::size_t half = points.count / 2;
    Shares shares;
    shares.push_back(std::make_unique<MadeClusterShare>(points.slice(0, half), options));
    shares.push_back(std::make_unique<MadeClusterShare>(points.slice(half, points.count - half), options));
    EXPECT_EQ(bytes_of(StoredClusters(pointers(shares), options)),
              bytes_of(points, cluster(points, options)));
  });
}

// Two clumps far apart, and a line of points across the border of the shares at x = 0.
test::TestCloud<float> two_clumps_and_a_line() {
  test::TestCloud<float> cloud{"clumps and line", {}};
  const auto add = [&](float x, float y) { cloud.xyz.insert(cloud.xyz.end(), {x, y, 0}); };
  for (int side : {-1, 1}) {
    for (int i = 0; i < 100; ++i)
      add(static_cast<float>(side * 100) + 0.01F * static_cast<float>(i), 0);
    for (int i = 0; i < 50; ++i)
      add(static_cast<float>(side) * (0.05F + 0.1F * static_cast<float>(i)), 0);
  }
  return cloud;
}

TEST(ClusterShares, SayWhichClustersAreComponentsOfAShareAndDoNotReadThosePoints) {
  const test::TestCloud<float> cloud = two_clumps_and_a_line();
  ClusterOptions options;
  options.tolerance = 0.5F;
  std::size_t visited = 0;
  StoredClusterOptions store;
  store.visit = [&](std::size_t, const std::vector<PointView>& clusters, const Execution&) {
    visited += clusters.size();
  };
  Shares shares;
  shares.push_back(std::make_unique<MadeClusterShare>(cloud.view().slice(0, 150), options, store));
  shares.push_back(std::make_unique<MadeClusterShare>(cloud.view().slice(150, 150), options, store));
  EXPECT_EQ(visited, 4U);
  StoredClusterOptions known;
  known.is_known = [&](const ComponentOfShare& c) { return shares[c.share]->visit(c.number).has_value(); };
  const StoredClusters joined(pointers(shares), options, known);
  ASSERT_EQ(joined.size(), 3U);
  EXPECT_EQ(
      joined.component(0).has_value() + joined.component(1).has_value() + joined.component(2).has_value(), 2);
}

TEST(ClusterShares, OfMoreRunsThanAreReadAtATimeKeepTheOrderOfTheCloud) {
  test::TestCloud<float> cloud{"a line in any order", {}};
  std::vector<float> along(8000);
  std::iota(along.begin(), along.end(), 0.0F);
  std::mt19937_64 random(1);
  std::shuffle(along.begin(), along.end(), random);
  for (const float x : along)
    cloud.xyz.insert(cloud.xyz.end(), {x, 0, 0});
  ClusterOptions options;
  options.tolerance = 1.01F;
  Shares shares;
  for (const std::size_t first : {0U, 4000U})
    shares.push_back(std::make_unique<MadeClusterShare>(cloud.view().slice(first, 4000), options));
  EXPECT_GT(shares[0]->runs().size() + shares[1]->runs().size(), 2048U);
  EXPECT_EQ(bytes_of(StoredClusters(pointers(shares), options)),
            bytes_of(cloud.view(), cluster(cloud.view(), options)));
}

// A share of which every run with a number that has the remainder 3 has changed after it was made.
class DamagedShare final : public ClusterShare {
 public:
  DamagedShare(const ClusterShare& good, std::size_t divisor) : good_(good) {
    std::uint64_t at = 0;
    for (std::size_t r = 0; r < good.runs().size(); ++r) {
      if (r % divisor == 3) damaged_.push_back(at);
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

TYPED_TEST(ClusterSharesOf, ThatAreDamagedLeaveClustersThatAreRightOrIncomplete) {
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
      damaged.push_back(std::make_unique<DamagedShare>(*shares.back(), 50));
      all.push_back(damaged.back().get());
    }
    StoredClusterOptions store;
    std::uint64_t lost = 0;
    store.on_lost = [&](const ShareError&, std::uint64_t points) { lost += points; };
    const StoredClusters joined(all, options, store);
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

TEST(ClusterShares, ThatAreDamagedAreNamed) {
  const test::TestCloud<float> cloud = two_clumps_and_a_line();
  ClusterOptions options;
  options.tolerance = 0.5F;
  const MadeClusterShare good(cloud.view().slice(0, 150), options),
      other(cloud.view().slice(150, 150), options);
  const DamagedShare bad(other, 4);
  try {
    const StoredClusters joined({&good, &bad}, options);
    FAIL() << "no error";
  } catch (const ShareError& error) {
    EXPECT_EQ(error.share(), 1U);
    EXPECT_STREQ(error.what(), "its points are damaged");
  }
}

TEST(ClusterShares, WithNumbersThatDoNotFitInARecordAreNamed) {
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

TEST(ClusterShares, OfNoPointAreNone) {
  ClusterOptions options;
  options.tolerance = 1;
  const MadeClusterShare none(PointView{}, options);
  EXPECT_EQ(StoredClusters({&none}, options).size(), 0U);
  EXPECT_EQ(StoredClusters(std::vector<const ClusterShare*>{}, options).size(), 0U);
}

}  // namespace
}  // namespace pcl_bv::detail
