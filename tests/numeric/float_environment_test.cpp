// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/float_environment.h"

#include <gtest/gtest.h>

#include <cfenv>

#include "flush_to_zero.h"

namespace pcl_bv::detail {
namespace {

// volatile: the compiler must neither fold nor move the conversion.
double widen_denormal() {
  volatile float denormal = 1e-41F;
  volatile double wide = denormal;
  return wide;
}

TEST(FloatEnvironment, KeepsDenormalsInAHostThatFlushesThem) {
  const test::FlushToZero host;
  EXPECT_EQ(widen_denormal(), 0.0) << "the host is meant to flush";
  {
    const FloatEnvironment environment;
    EXPECT_EQ(widen_denormal(), static_cast<double>(1e-41F));
  }
  EXPECT_EQ(widen_denormal(), 0.0) << "the host's choice must come back";
}

TEST(FloatEnvironment, RoundsToNearestInAHostThatRoundsUp) {
  const volatile double tiny = 0x1p-60;
  volatile double inside = 0, after = 0;
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  {
    const FloatEnvironment environment;
    inside = 1.0 + tiny;
  }
  after = 1.0 + tiny;
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(inside, 1.0);
  EXPECT_GT(after, 1.0) << "the host's choice must come back";
}

TEST(FloatEnvironment, OneInsideAnotherLeavesItInPlace) {
  const test::FlushToZero host;
  const FloatEnvironment outer;
  {
    const FloatEnvironment inner;
    EXPECT_GT(widen_denormal(), 0.0);
  }
  EXPECT_GT(widen_denormal(), 0.0);
}

}  // namespace
}  // namespace pcl_bv::detail
