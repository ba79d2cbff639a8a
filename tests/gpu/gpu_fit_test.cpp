// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_fit.h"

#include <algorithm>
#include <numeric>

#include "clouds.h"
#include "flush_to_zero.h"
#include "gpu_test.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_groups.h"
#include "support_pass.h"

namespace pcl_bv {
namespace {

using test::expect_same;
using test::small_buffers;
using test::TestCloud;

// Sets of methods for which the device searches different directions.
std::vector<std::vector<const Method*>> method_lists() {
  return {
      test::methods_named({"aabb"}), test::methods_named({"sphere-ritter"}),
      test::methods_named({"dop14", "sphere-epos14"}), test::methods_named({"dop18"}),
      test::methods_named({"aabb", "dop6", "dop18", "dop26", "sphere-epos26", "sphere-exact", "obb-pca"})};
}

void expect_same_fits(const PointView& points, HostPoints host) {
  const GpuCloud cloud(small_buffers(), points, host);
  ASSERT_EQ(cloud.size(), points.count);
  for (const std::vector<const Method*>& methods : method_lists())
    expect_same(fit(cloud, methods), fit_methods(points, methods), methods);
}

// A cloud with one far block, so that candidates are few and none of them is the first block.
template <typename T>
TestCloud<T> large_cloud(std::size_t points, std::uint64_t seed) {
  TestCloud<T> cloud = test::gaussian<T>(points, seed, 30, 5e5);
  const std::size_t far = points / 2 / 1024 * 1024;
  for (std::size_t i = 3 * far; i < std::min(3 * (far + 20), cloud.xyz.size()); ++i)
    cloud.xyz[i] += static_cast<T>((i % 7) * 11) - 33;
  return cloud;
}

// The device lists the points that can be a support; equal coordinates on a face of a box are all listed.
TEST(GpuFit, ListsEverySupportPointAndFewOthers) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = large_cloud<float>(100'000, 3);
  const GpuCloud cloud(small_buffers(), points.view());
  const std::vector<std::int32_t> near =
      detail::find_extremes(cloud.on_device(), detail::DirectionSet::dop26, true).near_points;
  EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
  EXPECT_LT(near.size(), 200U);
  const detail::Supports supports =
      detail::find_supports(points.view(), detail::DirectionSet::dop26, detail::SupportDetail::points, {});
  for (std::size_t k = 0; k < 13; ++k) {
    for (const detail::SupportPoint& support : {supports.along[k].low_point, supports.along[k].high_point})
      EXPECT_TRUE(std::binary_search(near.begin(), near.end(), static_cast<std::int32_t>(support.index)));
  }
}

TEST(GpuFit, SearchesBlocksIfManyPointsCanBeASupport) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<float> points = test::gaussian<float>(100'000, 4);
  for (std::size_t i = 0; i < detail::max_near_points + 1; ++i)
    points.xyz[3 * (30'000 + i)] = 50;
  const GpuCloud cloud(small_buffers(), points.view());
  const detail::DeviceExtremes found =
      detail::find_extremes(cloud.on_device(), detail::DirectionSet::dop26, true);
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.near_points.empty());
  expect_same_fits(points.view(), HostPoints::keep);
}

TEST(GpuFit, HasTheBitsOfTheProcessorOnNastyClouds) {
  PCL_BV_NEEDS_DEVICE();
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_same_fits(cloud.view(), HostPoints::keep);
    expect_same_fits(cloud.view(), HostPoints::release);
  }
}

TEST(GpuFit, HasTheBitsOfTheProcessorOnNastyCloudsOfDoubles) {
  PCL_BV_NEEDS_DEVICE();
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    expect_same_fits(cloud.view(), HostPoints::keep);
  }
  for (const double scale : {1e-310, 1e-100, 1e60, 9e99}) {
    const TestCloud<double> cloud = test::gaussian<double>(3000, 77, scale / 10);
    SCOPED_TRACE(cloud.name);
    expect_same_fits(cloud.view(), HostPoints::keep);
  }
}

TEST(GpuFit, HasTheBitsOfTheProcessorAroundWholeBlocks) {
  PCL_BV_NEEDS_DEVICE();
  for (const std::size_t points : {1023, 1024, 1025, 2048, 32767, 32768, 32769}) {
    const TestCloud<float> cloud = large_cloud<float>(points, points);
    SCOPED_TRACE(cloud.name);
    expect_same_fits(cloud.view(), HostPoints::keep);
  }
}

TEST(GpuFit, HasTheBitsOfTheProcessorOnCloudsOfSeveralBuffers) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> floats = large_cloud<float>(300'000, 5);
  expect_same_fits(floats.view(), HostPoints::keep);
  expect_same_fits(floats.view(), HostPoints::release);
  EXPECT_GT(GpuCloud(small_buffers(), floats.view()).on_device().parts().size(), 3U);
  expect_same_fits(large_cloud<double>(300'000, 6).view(), HostPoints::keep);
}

TEST(GpuFit, TakesEveryKindOfView) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = large_cloud<float>(40'000, 9);
  const test::Records<float> records(cloud, 32, 4);
  expect_same_fits(records.view(), HostPoints::release);
  const PointGroups groups(cloud.view());
  expect_same_fits(groups.view(), HostPoints::keep);
  expect_same_fits(groups.view().slice(33, 30'001), HostPoints::keep);
  std::vector<std::int32_t> indices(20'000);
  std::iota(indices.begin(), indices.end(), 15'000);
  std::reverse(indices.begin(), indices.end());
  expect_same_fits(cloud.view().subset(indices), HostPoints::keep);
}

TEST(GpuFit, HasTheBitsOfTheProcessorUnderFlushToZero) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = test::gaussian<float>(5000, 3, 1e-40);
  const std::vector<const Method*> methods = method_lists().back();
  const std::vector<Fitted<AnyVolume>> expected = fit_methods(cloud.view(), methods);
  const test::FlushToZero flush;
  const GpuCloud on_device(small_buffers(), cloud.view());
  expect_same(fit(on_device, methods), expected, methods);
}

TEST(GpuFit, InspectsFewBlocksOfALargeCloud) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = large_cloud<float>(300'000, 12);
  const GpuCloud on_device(small_buffers(), cloud.view());
  const detail::DeviceExtremes found =
      detail::find_extremes(on_device.on_device(), detail::DirectionSet::dop26, true);
  EXPECT_TRUE(found.complete);
  EXPECT_GE(found.candidates.size(), 1U);
  EXPECT_LE(found.candidates.size(), 30U);
}

// Four blocks of the origin, but for points of the last block that are farther than 1 along every direction
// of the 26-DOP except (1, 1, 1), along which they are at -1.
template <typename T>
TestCloud<T> four_blocks() {
  TestCloud<T> cloud{"four blocks", std::vector<T>(3 * 4096, T(0))};
  T far[][3] = {{2, 2, -5}, {2, -5, 2}, {-5, 2, 2}, {2, -3, 0}, {-3, 2, 0},
                {2, 0, -3}, {-3, 0, 2}, {0, 2, -3}, {0, -3, 2}};
  std::copy_n(&far[0][0], 27, cloud.xyz.data() + 3 * 4000);
  return cloud;
}

template <typename T>
void set_point(TestCloud<T>& cloud, std::size_t index, T x, T y, T z) {
  cloud.xyz[3 * index] = x;
  cloud.xyz[3 * index + 1] = y;
  cloud.xyz[3 * index + 2] = z;
}

TEST(GpuFit, FindsSupportsThatFloatProjectionsMisorder) {
  PCL_BV_NEEDS_DEVICE();
  // Along (1, 1, 1) the first point is at 1 + 0.51 ulp, which a float rounds to 1 + ulp. The other is at 1 +
  // 0.98 ulp, of which float sums keep 1.
  constexpr float ulp = 0x1p-23F;
  TestCloud<float> cloud = four_blocks<float>();
  set_point(cloud, 10, 1.0F, 0.51F * ulp, 0.0F);
  set_point(cloud, 2500, 1.0F, 0.49F * ulp, 0.49F * ulp);
  expect_same_fits(cloud.view(), HostPoints::keep);
}

TEST(GpuFit, FindsSupportsThatTheDevicesFloatsOfDoublesMisorder) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<double> cloud = four_blocks<double>();
  constexpr double ulp = 0x1p-23;
  set_point(cloud, 10, 1 + 0.51 * ulp, 0.0, 0.0);
  set_point(cloud, 2500, 1 + 0.49 * ulp, 0.49 * ulp, 0.49 * ulp);
  expect_same_fits(cloud.view(), HostPoints::keep);
}

TEST(GpuFit, TreatsBothZerosAsEqual) {
  PCL_BV_NEEDS_DEVICE();
  // The first of two points with the largest x is the support point, and decides on the centre of the sphere.
  TestCloud<float> cloud = four_blocks<float>();
  for (float& coordinate : cloud.xyz)
    coordinate = coordinate == 0 ? -0.25F : coordinate;
  for (std::size_t i = 4000; i < 4009; ++i)
    cloud.xyz[3 * i] -= 5;
  set_point(cloud, 10, -0.0F, 0.5F, 0.25F);
  set_point(cloud, 2500, 0.0F, -0.5F, -0.25F);
  expect_same_fits(cloud.view(), HostPoints::keep);
}

TEST(GpuFit, HasTheBitsOfTheProcessorWhereFloatSumsOverflow) {
  PCL_BV_NEEDS_DEVICE();
  expect_same_fits(test::gaussian<float>(20'000, 15, 7e37).view(), HostPoints::keep);
  expect_same_fits(test::gaussian<float>(20'000, 16, 1e36, 1e38).view(), HostPoints::keep);
}

TEST(GpuFit, LeavesCloudsOfManyCandidatesToTheProcessor) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<float> grid{"grid", {}};
  for (int i = 0; i < 400'000; ++i) {
    for (const int coordinate : {i % 10, i / 10 % 10, i / 100 % 10})
      grid.xyz.push_back(static_cast<float>(coordinate));
  }
  const GpuCloud cloud(small_buffers(), grid.view());
  EXPECT_FALSE(detail::find_extremes(cloud.on_device(), detail::DirectionSet::dop26, true).complete);
  expect_same_fits(grid.view(), HostPoints::keep);
}

TEST(GpuFit, DropsAndCountsInvalidPoints) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<float> cloud = large_cloud<float>(100'000, 13);
  for (std::size_t i = 0; i < cloud.size(); i += 3)
    cloud.xyz[3 * i + i % 3 % 2] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<const Method*> methods = test::methods_named({"dop26"});
  const Fitted<AnyVolume> fitted = fit(GpuCloud(small_buffers(), cloud.view()), methods)[0];
  EXPECT_EQ(fitted.dropped, 33'334U);
  EXPECT_EQ(fitted.used, 66'666U);
  expect_same_fits(cloud.view(), HostPoints::release);
}

TEST(GpuFit, RefusesANullMethod) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = test::gaussian<float>(10, 1);
  EXPECT_THROW(fit(GpuCloud(small_buffers(), cloud.view()), {nullptr}), std::invalid_argument);
}

TEST(GpuFit, NoticesPointsThatHaveChanged) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<float> cloud = test::gaussian<float>(3000, 1);
  const GpuCloud on_device(small_buffers(), cloud.view());
  for (float& coordinate : cloud.xyz)
    coordinate /= 2;
  EXPECT_THROW(fit(on_device, test::methods_named({"dop26"})), std::invalid_argument);
}

TEST(GpuFit, IsCleanUnderTheValidationLayer) {
  PCL_BV_NEEDS_DEVICE();
  const std::optional<GpuDevice> device = test::validated_device();
  PCL_BV_NEEDS_VALIDATION(device);
  const TestCloud<float> cloud = large_cloud<float>(200'000, 14);
  {
    const GpuCloud on_device(*device, cloud.view(), HostPoints::release);
    for (const std::vector<const Method*>& methods : method_lists())
      expect_same(fit(on_device, methods), fit_methods(cloud.view(), methods), methods);
    const std::vector<const Method*> boxes = test::methods_named({"dop26"});
    EXPECT_EQ(fit(on_device, std::vector<std::size_t>{0, 1000, 150'000, 200'000}, boxes).size(), 3U);
    IndexLists lists{{5, 6, 7, 8, 9}, {0, 5}};
    EXPECT_EQ(fit(GpuCloud(*device, cloud.view().slice(0, 100)), lists, boxes).size(), 1U);
  }
  EXPECT_EQ(device->validation_messages(), std::vector<std::string>());
}

}  // namespace
}  // namespace pcl_bv
