// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/float_environment.h"

#include <gtest/gtest.h>

#include "flush_to_zero.h"

namespace pcl_bv {
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

}  // namespace
}  // namespace pcl_bv
