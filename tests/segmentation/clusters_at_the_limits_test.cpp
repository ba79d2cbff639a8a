// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where rounding, overflow and the width of cell keys could make the clusters wrong: against the definition,
// evaluated pair by pair.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace {

using namespace pcl_bv;
using namespace pcl_bv::test;

template <typename T>
void expect_exact(const Cloud<T>& cloud, float tolerance) {
  SCOPED_TRACE(testing::Message() << cloud.size() << " points, tolerance " << tolerance);
  EXPECT_EQ(cluster(cloud, tolerance), brute_force(cloud, tolerance));
}

float ulps_from(float value, int ulps) {
  for (; ulps > 0; --ulps)
    value = std::nextafter(value, INFINITY);
  for (; ulps < 0; ++ulps)
    value = std::nextafter(value, -INFINITY);
  return value;
}

TEST(ClustersAtTheLimits, AreExactOnDiagonalsAsLongAsTheTolerance) {
  // Corner to corner of one cell, give or take the last bits.
  std::mt19937 random(1);
  for (int round = 0; round < 500; ++round) {
    SCOPED_TRACE(round);
    const float r = std::exp2(std::uniform_real_distribution<float>(-60.F, 60.F)(random));
    const float d = r / std::sqrt(3.F);
    for (int ulps = -8; ulps <= 8; ++ulps) {
      const float e = ulps_from(d, ulps);
      expect_exact<float>({{0, 0, 0}, {e, e, e}}, r);
      expect_exact<float>({{0.3F * d, 7 * d, -d}, {0.3F * d + e, 7 * d - e, e - d}}, r);
    }
  }
}

TEST(ClustersAtTheLimits, AreExactWhereCellNumbersAreRounded) {
  // From 2^28 cells on numbers are computed without rounding; from 2^53 on they go by the bits of a double.
  const double side = 1 / (std::sqrt(3.0) * (1 + 1e-6));
  for (const double cells : {0x1p28, 0x1p40, 0x1p52, 0x1p53, 0x1p54}) {
    const double step = std::max(1.0, cells * 0x1p-53);
    for (const double sign : {1.0, -1.0}) {
      for (int k = -40; k <= 40; ++k) {
        const double x = sign * (cells + 0.1 * step * k) * side;
        expect_exact<double>(
            {{x, 0, 0}, {x + 0.7 * step, 0, 0}, {x + 1.9 * step, 0, 0}, {x - 0.9 * step, 0.3, 0}}, 1.F);
      }
    }
  }
}

TEST(ClustersAtTheLimits, AreExactFarFromTheOriginAndFromEachOther) {
  for (const double far : {1e9, 3e11, 1e15, 1e20}) {
    SCOPED_TRACE(far);
    Cloud<double> cloud = uniform_cloud(300, 2.0, 24, {far, -7 * far, far / 3});
    for (const auto& p : uniform_cloud(300, 2.0, 25))
      cloud.push_back(p);
    for (const auto& p : uniform_cloud(100, far, 26))
      cloud.push_back(p);
    for (const float r : {1e-5F, 0.3F, 2.F})
      expect_exact(cloud, r);
  }
}

TEST(ClustersAtTheLimits, AreExactBetweenCellsTwoAwayAlongEachAxis) {
  // Near corners of such cells are less than the tolerance apart, since cells are a little smaller than
  // r/sqrt(3).
  for (const float r : {0.2F, 0.5F, 1.F, 3.F}) {
    const auto side = static_cast<float>(static_cast<double>(r) / (std::sqrt(3.0) * (1 + 1e-6)));
    for (int low = -4; low <= 4; ++low) {
      for (int high = -4; high <= 4; ++high) {
        const float p = ulps_from(side, low);
        const float q = ulps_from(2 * side, high);
        expect_exact<float>({{p, p, p}, {q, q, q}}, r);
        expect_exact<float>({{p, -q, p}, {q, -p, q}}, r);
      }
    }
  }
}

TEST(ClustersAtTheLimits, AreExactOnLatticesSpacedByTheTolerance) {
  for (const float r : {0.01F, 0.1F, 0.25F, 0.3F, 1.F, 5.F}) {
    for (const float factor : {1.F, 1.F + 1e-7F, 1.F - 1e-7F, 1.F / std::sqrt(2.F), 1.F / std::sqrt(3.F)}) {
      expect_exact(lattice(7, r * factor), r);
      expect_exact(lattice(7, r * factor, -100.F), r);
    }
  }
}

TEST(ClustersAtTheLimits, AreExactAtUtmOffsets) {
  // Floats near 5e6 are 0.5 apart, near 4e5 0.03125.
  for (const float r : {0.02F, 0.3F, 0.5F, 0.50001F, 0.7072F, 1.F, 2.F}) {
    expect_exact(uniform_cloud(800, 6.F, 11, {4e5F, 5e6F, 100.F}), r);
  }
}

TEST(ClustersAtTheLimits, AreExactWithAFarOutlier) {
  for (const float far : {1e6F, -1e9F, 3e30F, std::numeric_limits<float>::max()}) {
    SCOPED_TRACE(far);
    for (const float r : {0.01F, 0.1F, 1e-12F}) {
      Cloud<float> cloud = uniform_cloud(700, 0.1F, 12);
      cloud.push_back({far, 0, 0});
      cloud.push_back({0, -far, far});
      cloud.push_back({far, 0, 0});
      expect_exact(cloud, r);
    }
  }
}

TEST(ClustersAtTheLimits, AreExactAtEveryMagnitude) {
  for (const float scale : {1e-38F, 1e-22F, 3e-22F, 1e-20F, 1e-10F, 1e10F, 1e18F, 1e20F, 1e37F}) {
    for (const float factor : {0.02F, 0.1F, 0.2F, 1.F}) {
      expect_exact(uniform_cloud(500, scale, 13), factor * scale);
    }
  }
}

TEST(ClustersAtTheLimits, AreExactWhereTheSquareOfTheToleranceIsAFewSmallestFloats) {
  for (int i = 1; i < 60; ++i) {
    const float r = 0.7e-23F * static_cast<float>(i);  // its square: 0 to 126 times 1.4e-45
    expect_exact(uniform_cloud(150, 3e-22F, 14), r);
    expect_exact(lattice(4, 3.7e-23F), r);
  }
}

TEST(ClustersAtTheLimits, AreExactWherePointsOfOneCellAreApart) {
  // The tolerance squared is two of the smallest floats, and squares of most of a cell's side are rounded up
  // to one.
  const float r = 5.29e-23F, near = 6e-25F, far = 2.96e-23F, middle = 1.5e-23F, below = -3e-24F;
  EXPECT_EQ(cluster(Cloud<float>{{near, near, middle}, {far, far, middle}, {far, far, below}}, r),
            (ClusterList{{1, 2}, {0}}));
  for (int axis = 0; axis < 3; ++axis) {
    Cloud<float> cloud{{near, near, middle}, {far, far, middle}, {far, far, below}};
    for (auto& p : cloud)
      std::swap(p[axis], p[2]);
    expect_exact(cloud, r);
    std::swap(cloud[0], cloud[1]);
    expect_exact(cloud, r);
  }
}

TEST(ClustersAtTheLimits, AreExactWhereAllMagnitudesMeet) {
  std::mt19937 random(15);
  std::uniform_real_distribution<float> exponent(-126.F, 127.F);
  Cloud<float> cloud(600);
  for (auto& p : cloud) {
    for (float& v : p)
      v = (random() % 2 ? 1.F : -1.F) * std::exp2(exponent(random));
    if (random() % 2) p[1] = 0;
    if (random() % 2) p[2] = p[0];
  }
  for (const float r : {1e-44F, 1e-30F, 1e-20F, 1e-3F, 1.F, 1e10F, 1e19F, 2e19F, 1e38F})
    expect_exact(cloud, r);
}

TEST(ClustersAtTheLimits, AreExactForManyCopiesOfFewPoints) {
  Cloud<float> cloud;
  for (int i = 0; i < 900; ++i)
    cloud.push_back({static_cast<float>(i % 3) * 0.5F, 0, static_cast<float>(i % 2)});
  for (const float r : {1e-30F, 0.4F, 0.5F, 0.6F, 1.01F})
    expect_exact(cloud, r);
}

TEST(ClustersAtTheLimits, AreExactOnDenseSheetsBarelyApart) {
  for (const float slope : {0.F, 0.3F, 1.F}) {
    for (const float gap : {0.49F, 0.5F, 0.505F, 0.55F, 0.7F}) {
      Cloud<float> cloud = uniform_cloud(2000, 0.4F, 16);
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        cloud[i][2] = slope * cloud[i][0] + (i % 2 ? gap * std::sqrt(1 + slope * slope) : 0.F);
      }
      expect_exact(cloud, 0.5F);
    }
  }
}

TEST(ClustersAtTheLimits, AreExactForDoubles) {
  for (const float r : {1e-4F, 0.01F, 0.1F, 0.5F}) {
    expect_exact(uniform_cloud(800, 0.5, 21, {4e5, 5e6, 100.0}), r);
    expect_exact(lattice(6, static_cast<double>(r), 5e6), r);
  }
  // Cells that do not fit 2^40 of them to an axis, and differences near the last bit of the coordinates.
  for (const float r : {1e-10F, 1e-9F, 3e-9F, 1e-8F}) {
    expect_exact(uniform_cloud(400, 1e-8, 22, {4e5, 5e6, 100.0}), r);
    expect_exact(uniform_cloud(400, 1e-8, 22), r);
  }
  Cloud<double> cloud = uniform_cloud(400, 1.0, 23);
  cloud.push_back({1e99, -1e99, 1e50});
  cloud.push_back({0.0, 1e50, 0.0});
  for (const float r : {1e-40F, 0.1F, 0.3F, 1e38F})
    expect_exact(cloud, r);
}

TEST(ClustersAtTheLimits, SkipDoublesBeyondTheValidRange) {
  const Cloud<double> cloud{{0, 0, 0}, {1.1e100, 0, 0}, {0.1, 0, 0}};
  EXPECT_EQ(cluster(cloud, 1.F), (ClusterList{{0, 2}}));
}

#if defined(__SSE__)
TEST(ClustersAtTheLimits, AreTheSameWhenTheHostFlushesDenormals) {
  const Cloud<float> cloud = uniform_cloud(500, 1e-20F, 31);
  const ClusterList expected = brute_force(cloud, 2e-21F);
  const unsigned saved = _mm_getcsr();
  _mm_setcsr(saved | 0x8040);
  const ClusterList found = cluster(cloud, 2e-21F);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(saved);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(after & 0x8040, 0x8040U);
}
#endif

}  // namespace
