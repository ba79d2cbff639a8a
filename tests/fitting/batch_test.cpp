// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"
#include "pcl_bv/fitting/fit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <utility>

#include "executions.h"

namespace pcl_bv::detail {
namespace {

std::vector<PointView> views_of_sizes(const std::vector<std::size_t>& sizes) {
  std::vector<PointView> views(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i)
    views[i].count = sizes[i];  // only the sizes matter here
  return views;
}

TEST(Batch, FitsEachViewOnceOnEveryExecution) {
  const std::vector<PointView> views = views_of_sizes({300, 0, 500'000, 7, 100'000, 250'000, 40'000});
  for (const auto& [name, execution] : test::every_execution()) {
    SCOPED_TRACE(name);
    std::vector<std::atomic<int>> calls(views.size());
    for_each_view(views, execution, [&](std::size_t i, const Execution&) { ++calls.at(i); });
    for (const auto& count : calls)
      EXPECT_EQ(count, 1);
  }
}

TEST(Batch, TakesTheLargestFirstAndEqualOnesInOrder) {
  std::vector<std::size_t> order;
  for_each_view(views_of_sizes({5, 300'000, 5, 90, 400'000}), {Serial{}, Isa::scalar},
                [&](std::size_t i, const Execution&) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{4, 1, 3, 0, 2}));
}

TEST(Batch, GivesBigCloudsTheWholePolicyAndOthersNone) {
  const std::vector<PointView> views = views_of_sizes({1'000'000, 1'000});
  std::vector<unsigned> threads(views.size());
  for_each_view(views, {Threads{3}, Isa::scalar}, [&](std::size_t i, const Execution& execution) {
    threads[i] = thread_count(execution.parallel);
  });
  EXPECT_EQ(threads, (std::vector<unsigned>{3, 1}));
}

TEST(Batch, LetsExceptionsThrough) {
  const auto fail = [](std::size_t, const Execution&) { throw std::runtime_error("no"); };
  EXPECT_THROW(for_each_view(views_of_sizes({1'000'000}), {Threads{2}, Isa::scalar}, fail),
               std::runtime_error);
  EXPECT_THROW(for_each_view(views_of_sizes({10, 20}), {Threads{2}, Isa::scalar}, fail), std::runtime_error);
}

}  // namespace
}  // namespace pcl_bv::detail
