// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Calls that would read past an array, run instructions of another processor or measure other points than
// those meant are refused.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "clouds.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/kernels/half_spaces.h"
#include "pcl_bv/kernels/moments.h"
#include "pcl_bv/kernels/region_states.h"
#include "pcl_bv/kernels/slab_extents.h"
#include "pcl_bv/kernels/support.h"
#include "pcl_bv/points/point_groups.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

struct Kernel {
  std::string name;
  std::size_t most;  // points in a call
  std::function<void(Isa, const PointView&)> run;
};

SupportDirections one_direction() {
  SupportDirections set;
  set.add({1, 2, 3});
  return set;
}

std::vector<std::uint32_t> room(const PointView& points) {
  return std::vector<std::uint32_t>(std::min(points.count, std::size_t{100'000}));
}

const std::vector<Kernel>& kernels() {
  static const std::vector<Kernel> all = {
      {"axis_extents", kAny, [](Isa isa, const PointView& points) { axis_extents(isa, points); }},
      {"slab_extents", kAny,
       [](Isa isa, const PointView& points) {
         slab_extents(isa, points, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
       }},
      {"chunk_supports of the cube", kChunkPoints,
       [](Isa isa, const PointView& points) {
         ChunkSupports out;
         chunk_supports(isa, points, SupportDirections::of(DirectionSet::dop26), no_support_bounds(), out);
       }},
      {"chunk_supports", kChunkPoints,
       [](Isa isa, const PointView& points) {
         ChunkSupports out;
         chunk_supports(isa, points, one_direction(), no_support_bounds(), out);
       }},
      {"block_moments", kBlockPoints, [](Isa isa, const PointView& points) { block_moments(isa, points); }},
      {"scan_octants", kBlockPoints,
       [](Isa isa, const PointView& points) {
         OctantScan scan;
         scan_octants(isa, points, scan);
       }},
      {"list_distant_by_bounds", kBlockPoints,
       [](Isa isa, const PointView& points) {
         const std::vector<float> bounds(kBlockBounds, 1.0F);
         list_distant_by_bounds(isa, points, {bounds.data(), 0}, {}, 1, room(points).data());
       }},
      {"list_distant", std::size_t{1} << 32,
       [](Isa isa, const PointView& points) {
         list_distant(isa, points, {}, 1, FloatFilter::off, room(points).data());
       }},
      {"list_outside", std::size_t{1} << 32,
       [](Isa isa, const PointView& points) { list_outside(isa, points, {}, room(points).data()); }},
      {"region_states", kAny,
       [](Isa isa, const PointView& points) {
         std::vector<std::uint8_t> states(room(points).size());
         region_states(isa, points, RegionTests({}), states.data());
       }},
      {"PointGroups", kAny, [](Isa isa, const PointView& points) { PointGroups(points, isa); }}};
  return all;
}

class NoSource : public PointSource {
 public:
  PointView load(std::size_t, std::size_t, std::vector<std::byte>&) const override { return {}; }
};

TEST(Misuse, NoKernelRunsOnASetThatTheMachineLacks) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 1);
  const std::vector<Isa> usable = usable_isas();
  int refused = 0;
  for (const Isa isa :
       {Isa::sse4, Isa::avx2, Isa::avx512, Isa::neon, Isa::sve, Isa::sve2, static_cast<Isa>(8)}) {
    if (std::find(usable.begin(), usable.end(), isa) != usable.end()) continue;
    ++refused;
    for (const Kernel& kernel : kernels())
      EXPECT_THROW(kernel.run(isa, cloud.view()), std::invalid_argument) << kernel.name;
  }
  EXPECT_GE(refused, 4);  // those of the other architecture, and what is no set
}

TEST(Misuse, EveryKernelLooksUpTheAutomaticSet) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 1);
  for (const Kernel& kernel : kernels())
    EXPECT_NO_THROW(kernel.run(Isa::automatic, cloud.view())) << kernel.name;
  EXPECT_EQ(axis_extents(Isa::automatic, cloud.view()).high, axis_extents(Isa::scalar, cloud.view()).high);
}

TEST(Misuse, NoKernelTakesMorePointsThanItHasRoomFor) {
  const test::TestCloud<float> cloud = test::gaussian<float>(kChunkPoints + 1, 2);
  for (const Kernel& kernel : kernels()) {
    PointView points = cloud.view();
    points.count = std::min(kernel.most, points.count);
    EXPECT_NO_THROW(kernel.run(Isa::scalar, points)) << kernel.name;
    if (kernel.most == kAny) continue;
    points.count = kernel.most + 1;
    EXPECT_THROW(kernel.run(Isa::scalar, points), std::invalid_argument) << kernel.name;
  }
}

TEST(Misuse, NoKernelReadsPointsThatAreNotInMemory) {
  const NoSource source;
  PointView nowhere;
  nowhere.count = 1;
  for (const Kernel& kernel : kernels()) {
    EXPECT_THROW(kernel.run(Isa::scalar, view_of(source, 100, ScalarType::float32)), std::invalid_argument)
        << kernel.name;
    EXPECT_THROW(kernel.run(Isa::scalar, nowhere), std::invalid_argument) << kernel.name;
    EXPECT_NO_THROW(kernel.run(Isa::scalar, PointView())) << kernel.name;
  }
}

TEST(Misuse, AnOriginThatIsNoPointOfTheCloudsTypeIsRefused) {
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 4);
  const test::TestCloud<double> doubles = test::gaussian<double>(10, 4);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto measure = [](const PointView& points, const Coordinates& origin) {
    slab_extents(Isa::scalar, points, origin, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = [axis](double c) {
      return Coordinates{axis == 0 ? c : 0, axis == 1 ? c : 0, axis == 2 ? c : 0};
    };
    for (const double bad : {nan, 1.1e100, 0.1}) {
      EXPECT_THROW(measure(cloud.view(), along(bad)), std::invalid_argument) << bad;
    }
    EXPECT_THROW(measure(doubles.view(), along(1.1e100)), std::invalid_argument);
    EXPECT_NO_THROW(measure(doubles.view(), along(0.1)));
    EXPECT_NO_THROW(measure(cloud.view(), along(0.5)));
  }
}

TEST(Misuse, DistancesOfFloatsHaveNoUnitOfTheirOwnAndBoundsBelongToFloats) {
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 5);
  const test::TestCloud<double> doubles = test::gaussian<double>(10, 5);
  const DistanceCenter half{0, 0, 0, 0.5};
  OctantScan scan{half};
  EXPECT_THROW(scan_octants(Isa::scalar, cloud.view(), scan), std::invalid_argument);
  EXPECT_NO_THROW(scan_octants(Isa::scalar, doubles.view(), scan));
  const std::vector<float> bounds(kBlockBounds, 1.0F);
  std::uint32_t positions[10];
  EXPECT_THROW(list_distant_by_bounds(Isa::scalar, doubles.view(), {bounds.data(), 0}, {}, 0, positions),
               std::invalid_argument);
  EXPECT_THROW(list_distant_by_bounds(Isa::scalar, cloud.view(), {}, {}, 0, positions),
               std::invalid_argument);
}

TEST(Misuse, APolytopeHasNoMoreHalfSpacesThanThereIsRoomFor) {
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 6);
  HalfSpaces inside;
  std::uint32_t positions[10];
  inside.count = kMaxHalfSpaces;
  EXPECT_NO_THROW(list_outside(Isa::scalar, cloud.view(), inside, positions));
  inside.count = kMaxHalfSpaces + 1;
  EXPECT_THROW(list_outside(Isa::scalar, cloud.view(), inside, positions), std::invalid_argument);
}

TEST(Misuse, ASetOfDirectionsTakesSoManyDirectionsAndNoMore) {
  SupportDirections set;
  for (std::size_t k = 0; k < kMaxSupportDirections; ++k)
    EXPECT_NO_THROW(set.add({1, 0, static_cast<double>(k)}));
  EXPECT_THROW(set.add({1, 0, 0}), std::invalid_argument);
  EXPECT_EQ(set.count, kMaxSupportDirections);
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 7);
  ++set.count;
  ChunkSupports out;
  EXPECT_THROW(chunk_supports(Isa::scalar, cloud.view(), set, {}, out), std::invalid_argument);
}

TEST(Misuse, WhatIsNoDirectionIsNotAddedToASet) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  SupportDirections set;
  for (const double bad : {nan, inf, -inf, 0.0, 0.9e-30, -1.1e30}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Direction direction{};
      direction[axis] = bad;
      EXPECT_THROW(set.add(direction), std::invalid_argument) << bad;
      direction[(axis + 1) % 3] = 1;
      if (!(std::abs(bad) < 1)) {
        EXPECT_THROW(set.add(direction), std::invalid_argument) << bad;
      }
    }
  }
  EXPECT_EQ(set.count, 0U);
  set.add({0, -1e-30, 0});
  set.add({1, 0, 1e30});
  EXPECT_EQ(set.count, 2U);
}

template <typename T>
concept MakesAView = requires(const T* xyz) {
  PointView::of(xyz, 12, 1);
};

TEST(Misuse, OnlyFloatsAndDoublesMakeAView) {
  EXPECT_TRUE(MakesAView<float>);
  EXPECT_TRUE(MakesAView<double>);
  EXPECT_FALSE(MakesAView<std::int32_t>);
  EXPECT_FALSE(MakesAView<std::uint64_t>);
}

struct Return {
  double time, x, y, z;
  unsigned char ring;
};

TEST(PointView, OfAVectorHasItsPointsWhateverTheirType) {
  const std::vector<Eigen::Vector3f> vectors = {{1, 2, 3}, {4, 5, 6}};
  const std::vector<Eigen::Vector4d> padded = {{1, 2, 3, 9}, {4, 5, 6, 9}};
  const std::vector<std::array<float, 3>> arrays = {{1, 2, 3}, {4, 5, 6}};
  const std::vector<Return> records = {{9, 1, 2, 3, 0}, {9, 4, 5, 6, 0}};
  for (const PointView& points : {view(vectors), view(padded), view(arrays), view(records)}) {
    ASSERT_EQ(points.count, 2U);
    EXPECT_EQ(load_point(points, 0), (Coordinates{1, 2, 3}));
    EXPECT_EQ(load_point(points, 1), (Coordinates{4, 5, 6}));
  }
  EXPECT_EQ(view(vectors).scalar, ScalarType::float32);
  EXPECT_EQ(view(padded).scalar, ScalarType::float64);
  EXPECT_TRUE(view(std::as_const(*std::make_unique<std::vector<Eigen::Vector3f>>())).empty());
}

TEST(Misuse, SubsetsHaveTheIndicesOfTheCloud) {
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 8);
  const std::vector<std::int32_t> indices = {2, 5};
  const auto expect_third_and_sixth = [&](const PointView& subset) {
    ASSERT_EQ(subset.count, 2U);
    EXPECT_EQ(subset.index(1), 5U);
    EXPECT_EQ(load_point(subset, 0), load_point(cloud.view(), 2));
    EXPECT_EQ(load_point(subset, 1), load_point(cloud.view(), 5));
  };
  const std::vector<std::int32_t> list = {5, 9, 2};
  const PointGroups groups(cloud.view());
  expect_third_and_sixth(cloud.view().subset(indices));
  expect_third_and_sixth(cloud.view().slice(2, 4).subset(indices));
  expect_third_and_sixth(cloud.view().subset(list).subset(indices));
  expect_third_and_sixth(groups.view().subset(indices));
  expect_third_and_sixth(groups.view().slice(1, 7).subset(indices));
  const std::vector<std::int32_t> none;
  EXPECT_TRUE(cloud.view().subset(none).empty());
  EXPECT_TRUE(PointView().subset(none).empty());
}

TEST(Misuse, SubsetsOfPointsThatAreNotThereAreRefused) {
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 8);
  const auto refused = [](const PointView& points, const std::vector<std::int32_t>& indices) {
    try {
      points.subset(indices);
      return false;
    } catch (const std::out_of_range&) {
      return true;
    }
  };
  EXPECT_TRUE(refused(cloud.view(), {0, 10}));
  EXPECT_TRUE(refused(cloud.view(), {-1}));
  EXPECT_TRUE(refused(cloud.view().slice(3, 4), {2}));
  EXPECT_TRUE(refused(cloud.view().slice(3, 4), {7}));
  EXPECT_TRUE(refused(PointView(), {0}));
  const std::vector<std::int32_t> wrong = {-1, 3};  // a view does not check its indices
  PointView unchecked = cloud.view();
  unchecked.indices = wrong.data();
  unchecked.count = wrong.size();
  EXPECT_TRUE(refused(unchecked, {-1}));
  EXPECT_TRUE(refused(unchecked, {3}));
  const std::vector<std::int32_t> list = {5, 4, 6}, one = {1};
  EXPECT_TRUE(refused(cloud.view().subset(list), {3}));
  EXPECT_TRUE(refused(cloud.view().subset(list), {7}));
  const NoSource source;
  EXPECT_THROW(view_of(source, 10, ScalarType::float32).subset(one), std::invalid_argument);
  EXPECT_THROW(subsets(cloud.view(), {{0, 1, 10}, {0, 2, 3}}), std::out_of_range);
}

TEST(Misuse, ViewsAreTheSamePlacesOnlyIfNothingDiffers) {
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 9), other = cloud;
  const std::vector<std::int32_t> indices(10, 1);
  const NoSource source;
  const PointView view = cloud.view();
  EXPECT_TRUE(same_memory(view, cloud.view()));
  EXPECT_FALSE(same_memory(view, other.view()));
  const auto differs = [&](const auto& change) {
    PointView changed = view;
    change(changed);
    return !same_memory(view, changed) && !same_memory(changed, view);
  };
  EXPECT_TRUE(differs([](PointView& v) { v.stride = 24; }));
  EXPECT_TRUE(differs([](PointView& v) { v.count = 9; }));
  EXPECT_TRUE(differs([&](PointView& v) { v.indices = indices.data(); }));
  EXPECT_TRUE(differs([](PointView& v) { v.first = 1; }));
  EXPECT_TRUE(differs([](PointView& v) { v.scalar = ScalarType::float64; }));
  EXPECT_TRUE(differs([](PointView& v) { v.order = PointOrder::groups; }));
  EXPECT_TRUE(differs([&](PointView& v) { v.source = &source; }));
}

}  // namespace
}  // namespace pcl_bv::detail
