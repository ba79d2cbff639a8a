// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shares that know the cells of all others write only what merging needs.

#include <gtest/gtest.h>

#include <barrier>
#include <map>
#include <thread>

#include "share_scenes.h"

namespace pcl_bv::detail {
namespace {

template <typename T>
class ExchangedCellsOf : public testing::Test {};
using ScalarTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(ExchangedCellsOf, ScalarTypes);

// Makes all shares at the same time, each in a thread, with records only where other shares are near.
template <typename T>
class SharesWithExchangedCells {
 public:
  SharesWithExchangedCells(const PointView& points, const std::vector<std::size_t>& ends,
                           const ClusterOptions& options, std::size_t in_memory)
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

TYPED_TEST(ExchangedCellsOf, NeedOnlyThePointsNearOtherShares) {
  std::uint64_t unwritten = 0, points = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    test::TestCloud<TypeParam> cloud = scene<TypeParam>(seed);
    std::mt19937_64 random(seed);
    const std::vector<std::size_t> ends = make_tiles(random, cloud);
    const ClusterOptions options = random_options(random);
    const std::size_t in_memory = std::array{40U, 1U << 20U}[random() % 2];
    SCOPED_TRACE(testing::Message() << cloud.name << ", min_points " << options.min_points << ", tolerance "
                                    << options.tolerance);
    const SharesWithExchangedCells<TypeParam> all(cloud.view(), ends, options, in_memory);
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
        unwritten += run.check_sum == ShareRun::kNotWritten ? run.points : 0;
  }
  EXPECT_GT(unwritten, points / 8);
}

// Cells are numbered modulo 2^21: some of the points of the second share have the number of the first's cell.
TEST(ExchangedCells, OfTheSameNumberFarApartAreReadable) {
  test::TestCloud<double> cloud{"far apart", {0.5, 0, 0, 0.8, 0, 0}};
  for (int i = 0; i < 300; ++i)
    cloud.xyz.insert(cloud.xyz.end(), {4'194'295 + 0.1 * i, 0, 0});
  ClusterOptions options;
  options.tolerance = 0.5F;
  const SharesWithExchangedCells<double> all(cloud.view(), {0, 2, cloud.size()}, options, 1U << 20);
  StoredClusterOptions known;
  known.is_known = [&](const ComponentOfShare& c) {
    return all.shares()[c.share]->visit(c.number).has_value();
  };
  const StoredClusters joined(pointers(all.shares()), options, known);
  EXPECT_EQ(all.bytes_of(joined), bytes_of(cloud.view(), cluster(cloud.view(), options)));
}

}  // namespace
}  // namespace pcl_bv::detail
