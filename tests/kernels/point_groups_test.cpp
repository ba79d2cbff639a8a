// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/points/point_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "allocations.h"
#include "clouds.h"
#include "flush_to_zero.h"

namespace pcl_bv::detail {
namespace {

using test::Records;
using test::TestCloud;

template <typename T>
using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

// Values that an arithmetic operation on the way would change.
template <typename T>
TestCloud<T> delicate_points(std::size_t n) {
  TestCloud<T> cloud = test::gaussian<T>(n, 40 + n);
  Bits<T> signalling = 0;
  const T inf = std::numeric_limits<T>::infinity();
  std::memcpy(&signalling, &inf, sizeof inf);
  signalling |= 0x2345;
  for (std::size_t i = 0; i < cloud.xyz.size(); i += 7) {
    const T values[] = {-T(0), std::numeric_limits<T>::denorm_min(), inf, std::numeric_limits<T>::lowest()};
    cloud.xyz[i] = values[i / 7 % 4];
    if (i % 5 == 0) std::memcpy(&cloud.xyz[i], &signalling, sizeof signalling);
  }
  return cloud;
}

template <typename T>
bool same_point(const T (&a)[3], const T (&b)[3]) {
  return std::memcmp(a, b, sizeof a) == 0;
}

template <typename T>
void expect_padded_by_a_valid_point(const PointView& points, const PointView& groups) {
  PointView memory = groups;
  const std::size_t per_group = kGroupBytes / sizeof(T);
  memory.count = (groups.count + per_group - 1) / per_group * per_group;
  const bool any = [&points] {
    for (std::size_t i = 0; i < points.count; ++i)
      if (is_valid(load_point(points, i))) return true;
    return false;
  }();
  for (std::size_t i = groups.count; i < memory.count; ++i) {
    T pad[3], p[3];
    load_point(memory, i, pad);
    bool repeated = false;
    for (std::size_t k = 0; k < points.count && !repeated; ++k) {
      load_point(points, k, p);
      repeated = same_point(p, pad);
    }
    EXPECT_TRUE(repeated) << "lane " << i;
    EXPECT_EQ(is_valid(load_point(memory, i)), any) << "lane " << i;
  }
}

class PointGroupsTest : public testing::TestWithParam<Isa> {
 protected:
  template <typename T>
  void expect_copy(const PointView& points) {
    const PointGroups copy(points, GetParam());
    const PointView groups = copy.view();
    ASSERT_EQ(groups.count, points.count);
    ASSERT_EQ(copy.size(), points.count);
    ASSERT_EQ(groups.order, PointOrder::groups);
    ASSERT_EQ(groups.scalar, points.scalar);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(groups.data) % kGroupBytes, 0U);
    for (std::size_t i = 0; i < points.count; ++i) {
      T expected[3], found[3];
      load_point(points, i, expected);
      load_point(groups, i, found);
      ASSERT_TRUE(same_point(expected, found)) << "point " << i;
      ASSERT_EQ(groups.index(i), i);
    }
    expect_padded_by_a_valid_point<T>(points, groups);
  }
};

TEST_P(PointGroupsTest, KeepTheBitsOfEveryPointOfEveryRecordAndTail) {
  for (std::size_t n = 0; n <= 3 * 16 + 1; ++n) {
    const TestCloud<float> floats = delicate_points<float>(n);
    const TestCloud<double> doubles = delicate_points<double>(n);
    for (const auto& [stride, offset] : std::vector<std::pair<std::size_t, std::size_t>>{
             {12, 0}, {16, 0}, {16, 4}, {29, 13}, {32, 0}, {32, 16}, {48, 32}}) {
      SCOPED_TRACE(testing::Message() << n << " float points, stride " << stride << ", offset " << offset);
      expect_copy<float>(Records<float>(floats, stride, offset).view());
    }
    for (const auto& [stride, offset] :
         std::vector<std::pair<std::size_t, std::size_t>>{{24, 0}, {32, 0}, {37, 13}, {40, 16}}) {
      SCOPED_TRACE(testing::Message() << n << " double points, stride " << stride << ", offset " << offset);
      expect_copy<double>(Records<double>(doubles, stride, offset).view());
    }
  }
}

TEST_P(PointGroupsTest, KeepTheBitsOfGroupsAndTheirSlices) {
  const TestCloud<float> floats = delicate_points<float>(100);
  const TestCloud<double> doubles = delicate_points<double>(100);
  const PointGroups groups(floats.view(), GetParam());
  const PointGroups double_groups(doubles.view(), GetParam());
  for (std::size_t begin = 0; begin <= 34; ++begin) {
    for (const std::size_t n : {0, 1, 15, 16, 17, 50, 66}) {
      SCOPED_TRACE(testing::Message() << n << " points from " << begin);
      expect_copy<float>(groups.view().slice(begin, n));
      expect_copy<double>(double_groups.view().slice(begin, n));
      expect_copy<float>(floats.view().slice(begin, n));
    }
  }
}

TEST_P(PointGroupsTest, HoldAnIndexListInItsOrder) {
  const TestCloud<float> cloud = delicate_points<float>(200);
  std::vector<std::int32_t> indices;
  for (std::int32_t i = 0; i < 77; ++i)
    indices.push_back(i * 61 % 200);
  indices.push_back(199);
  for (const std::size_t stride : {12, 16, 32}) {
    const Records<float> records(cloud, stride);
    PointView view = records.view();
    view.indices = indices.data();
    view.count = indices.size();
    expect_copy<float>(view);
  }
}

TEST_P(PointGroupsTest, OfNastyCloudsArePaddedByAValidPoint) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_copy<float>(cloud.view());
  }
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    expect_copy<double>(cloud.view());
  }
}

TEST_P(PointGroupsTest, ArePaddedByTheFirstPointIfNoOtherIsValid) {
  TestCloud<float> cloud = test::gaussian<float>(20, 8);
  for (std::size_t i = 1; i < cloud.size(); ++i)
    cloud.xyz[3 * i + i % 3] = std::numeric_limits<float>::quiet_NaN();
  for (const std::size_t n : {1, 2, 3, 17, 20})
    expect_copy<float>(cloud.view().slice(0, n));
}

TEST_P(PointGroupsTest, KeepDenormalsUnderAHostThatFlushesThem) {
  const TestCloud<float> cloud = test::gaussian<float>(70, 7, 1e-41);
  const test::FlushToZero host;
  expect_copy<float>(cloud.view());
}

TEST_P(PointGroupsTest, AFillThatFitsDoesNotAllocate) {
  const TestCloud<float> large = test::gaussian<float>(1000, 1);
  const TestCloud<float> small = test::gaussian<float>(37, 2);
  const TestCloud<double> doubles = test::gaussian<double>(500, 3);
  PointGroups groups(large.view(), GetParam());
  const std::size_t capacity = groups.capacity();
  EXPECT_GE(capacity, 1000 * 12U);
  const std::byte* const memory = groups.view().data;
  const std::size_t before = allocations();
  for (const PointView& view : {small.view(), PointView(), doubles.view(), large.view()})
    groups.assign(view, GetParam());
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(groups.view().data, memory);
  EXPECT_EQ(groups.capacity(), capacity);
}

INSTANTIATE_TEST_SUITE_P(EveryUsableSet, PointGroupsTest, testing::ValuesIn(usable_isas()),
                         [](const auto& param) { return std::string(isa_name(param.param)); });

TEST(PointGroups, GrowByAnAlignedAllocation) {
  PointGroups groups;
  EXPECT_TRUE(groups.empty());
  EXPECT_EQ(groups.capacity(), 0U);
  const std::size_t before = allocations();
  groups.assign(test::gaussian<float>(100, 1).view());
  EXPECT_GT(allocations(), before) << "the count of allocations is blind";
}

TEST(PointGroups, ACopyOwnsItsPointsAndAMovedFromOneIsEmpty) {
  const TestCloud<float> cloud = test::gaussian<float>(100, 1);
  PointGroups groups(cloud.view());
  const PointGroups copy = groups;
  const PointGroups taken = std::move(groups);
  EXPECT_TRUE(groups.empty());  // NOLINT(bugprone-use-after-move): what is promised
  EXPECT_EQ(groups.view().count, 0U);
  EXPECT_NE(copy.view().data, taken.view().data);
  EXPECT_EQ(std::memcmp(copy.view().data, taken.view().data, 7 * 3 * kGroupBytes), 0);
}

TEST(PointGroups, AnUnusableInstructionSetIsAnErrorAndChangesNothing) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 1);
  PointGroups groups(cloud.view());
  const Isa foreign = usable_isas().back() >= Isa::neon ? Isa::avx2 : Isa::neon;
  EXPECT_THROW(groups.assign(PointView(), foreign), std::invalid_argument);
  EXPECT_EQ(groups.size(), 10U);
}

}  // namespace
}  // namespace pcl_bv::detail
