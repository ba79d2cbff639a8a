// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds for tests: seeded, and nasty on purpose.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace pcl_bv::test {

/// Points x y z in one array, and a record layout to put them into.
template <typename T>
struct TestCloud {
  std::string name;
  std::vector<T> xyz;

  std::size_t size() const { return xyz.size() / 3; }
  PointView view() const { return PointView::of(xyz.data(), 3 * sizeof(T), size()); }
};

template <typename T>
TestCloud<T> gaussian(std::size_t n, std::uint64_t seed, double scale = 1, double offset = 0) {
  TestCloud<T> cloud{"gaussian n=" + std::to_string(n) + " seed=" + std::to_string(seed) +
                         " scale=" + std::to_string(scale) + " offset=" + std::to_string(offset),
                     {}};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < 3 * n; ++i)
    cloud.xyz.push_back(static_cast<T>(offset + scale * normal(random)));
  return cloud;
}

/// Shapes and magnitudes on which bounding volumes go wrong.
template <typename T>
std::vector<TestCloud<T>> nasty_clouds() {
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const T inf = std::numeric_limits<T>::infinity();
  std::vector<TestCloud<T>> clouds;
  for (const std::size_t n : {1, 2, 3, 5, 17, 300, 1024, 1025, 5000})
    clouds.push_back(gaussian<T>(n, 100 + n));
  for (const double scale : {1e-41, 1e-30, 1e-20, 1e-3, 1e3, 1e18, 1e20, 2e37}) {
    clouds.push_back(gaussian<T>(700, 7, scale));
  }
  clouds.push_back(gaussian<T>(3000, 8, 20, 5e6));  // UTM: a float step is half a metre
  clouds.push_back(gaussian<T>(3000, 9, 1e-3, 1));
  clouds.push_back({"one point far away", {T(5e6), T(-4e6), T(123.25)}});
  if (sizeof(T) == 8)  // a covariance whose squares underflow
    clouds.push_back({"nearly a line", {0, 0, 0, 1, 3, 0, 2, 6, 0, 3, 9, T(1e-150)}});
  clouds.push_back({"equal points", std::vector<T>(3 * 50, T(0.1))});
  clouds.push_back({"mixed zeros", {T(-0.0), T(0.0), T(-0.0), T(0.0), T(-0.0), T(-0.0)}});
  clouds.push_back(
      {"cancelling", {T(1e20), T(1), T(1e20), T(1e20), T(2), T(1e20), T(-1e20), T(3), T(-1e20)}});
  clouds.push_back(
      {"huge", {T(1.2e38), T(1.2e38), T(1.2e38), T(-1.2e38), T(3e38), T(1), T(3e38), T(3e38), T(-3e38)}});
  TestCloud<T> line{"line", {}}, plane{"tilted plane", {}}, lattice{"lattice", {}}, circle{"circle", {}};
  for (int i = 0; i < 200; ++i) {
    const T t = static_cast<T>(i * 0.37);
    line.xyz.insert(line.xyz.end(), {t, 2 * t, -t});
    const T u = static_cast<T>(i % 14), v = static_cast<T>((i * 7) % 13);
    plane.xyz.insert(plane.xyz.end(), {u, v, u + v});
    lattice.xyz.insert(lattice.xyz.end(), {u, v, static_cast<T>(i % 5)});
    circle.xyz.insert(circle.xyz.end(), {static_cast<T>(std::cos(i)), static_cast<T>(std::sin(i)), T(2)});
  }
  clouds.insert(clouds.end(), {line, plane, lattice, circle});
  for (const std::size_t bad : {0, 1, 500, 1023, 1024, 2998, 2999}) {
    TestCloud<T> cloud = gaussian<T>(3000, 20 + bad);
    cloud.name += " with NaN and infinity at " + std::to_string(bad);
    cloud.xyz[3 * bad + bad % 3] = bad % 2 == 0 ? nan : -inf;
    clouds.push_back(cloud);
  }
  // In each lane what reaches farthest comes before a NaN, and valid points after it.
  TestCloud<T> hole = gaussian<T>(1000, 32);
  hole.name = "a hole amid valid points";
  for (std::size_t i = 0; i < 540; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      hole.xyz[3 * i + axis] *= 3;
    if (i >= 500) hole.xyz[3 * i + i % 3] = i % 2 == 0 ? nan : -nan;
  }
  clouds.push_back(hole);
  TestCloud<T> organised = gaussian<T>(4000, 31);
  organised.name = "mostly NaN, as a depth camera gives";
  for (std::size_t i = 0; i < organised.size(); ++i) {
    if (i % 1024 > 100) organised.xyz[3 * i] = organised.xyz[3 * i + 1] = organised.xyz[3 * i + 2] = nan;
  }
  clouds.push_back(organised);
  clouds.push_back({"nothing finite", {nan, nan, nan, inf, T(0), T(0)}});
  clouds.push_back({"empty", {}});
  return clouds;
}

/// The cloud's points in records of `stride` bytes with x at `offset`; all other bytes are NaN patterns.
template <typename T>
struct Records {
  Records(const TestCloud<T>& cloud, std::size_t stride_bytes, std::size_t offset_bytes = 0)
      : stride(stride_bytes),
        offset(offset_bytes),
        bytes(cloud.size() * stride, std::byte{0xFF}),
        count(cloud.size()) {
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(bytes.data() + i * stride + offset, cloud.xyz.data() + 3 * i, 3 * sizeof(T));
    }
  }

  PointView view() const {
    PointView view = PointView::of<T>(nullptr, stride, count);
    view.data = bytes.data() + offset;
    view.readable = stride - offset;
    return view;
  }

  std::size_t stride;
  std::size_t offset;
  std::vector<std::byte>
      bytes;  // exactly as long as the points: a read past the end is caught by AddressSanitizer
  std::size_t count;
};

}  // namespace pcl_bv::test
