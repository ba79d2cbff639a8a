// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A host that flushes denormals must get the same bits of every fit.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "clouds.h"
#include "encloses.h"
#include "fits.h"
#include "flush_to_zero.h"
#include "numbers.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

// All that a host does with a cloud of this size, which flushes denormals, and what it gets without that.
template <typename T>
void expect_same_in_flushing_host(double size) {
  const TestCloud<T> cloud = gaussian<T>(700, 7, size);
  for (const Method& method : methods()) {
    SCOPED_TRACE(testing::Message() << method.name << ", size " << size);
    AnyVolume expected, volume;
    const EstimationResult result = test::take(method.fit(cloud.view()), expected);
    Verification verification;
    {
      const FlushToZero host;
      EXPECT_EQ(test::take(method.fit(cloud.view()), volume).rank, result.rank);
      verification = verify(volume, cloud.view());
    }
    EXPECT_EQ(bits(volume), bits(expected));
    EXPECT_EQ(verification.outside, 0U);
    expect_encloses(volume, cloud.view());
  }
}

TEST(FlushingHost, LosesNoDenormalFloatOfAnyMethod) {
  expect_same_in_flushing_host<float>(1e-41);
}

TEST(FlushingHost, LosesNoDenormalDoubleOfAnyMethod) {
  expect_same_in_flushing_host<double>(1e-310);
}

TEST(FlushingHost, LosesNoDenormalDoubleOfOwnDirectionsAndOfTheSummary) {
  const TestCloud<double> cloud = gaussian<double>(50, 7, 1e-310);
  const auto own =
      std::make_shared<const KdopSet>(std::vector<Eigen::Vector3d>{{1, 2, 3}, {-1, 5, 0}, {0.1, 0, 1}});
  Kdop kdop, dop26;
  Aabb box;
  {
    const FlushToZero host;
    kdop = *fit_kdop(cloud.view(), own);
    const CloudSummary summary = summarize(cloud.view());
    box = summary.aabb;
    dop26 = summary.dop26;
  }
  for (const AnyVolume& volume : {AnyVolume(kdop), AnyVolume(box), AnyVolume(dop26)})
    expect_encloses(volume, cloud.view());
}

TEST(FlushingHost, GetsTheSameSmallestVolume) {
  // Of a size of 1e-104, volumes are denormal numbers.
  const TestCloud<double> cloud = gaussian<double>(50, 7, 1e-104);
  const std::vector<const Method*> among{find_method("sphere-ritter"), find_method("dop26")};
  const AnyVolume expected = *pcl_bv::fit_smallest(cloud.view(), among);
  AnyVolume volume;
  ASSERT_EQ(shape_name(expected), "kdop");
  {
    const FlushToZero host;
    volume = *pcl_bv::fit_smallest(cloud.view(), among);
  }
  EXPECT_EQ(bits(volume), bits(expected));
}

TEST(FlushingHost, LearnsWhatIsOutsideByADenormal) {
  const double p[] = {0, 0, 0, 2e-310, 0, 0};
  Verification result;
  {
    const FlushToZero host;
    result = verify(Aabb({0, 0, 0}, {1e-310, 0, 0}), PointView::of(p, 24, 2));
  }
  EXPECT_EQ(result.outside, 1U);
  EXPECT_EQ(result.max_violation, 2e-310 - 1e-310);
}

}  // namespace
}  // namespace pcl_bv::test
