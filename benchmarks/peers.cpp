// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Peers are built as this file is, with -O3; their answers are judged in double, where sums of three floats
// of like magnitude are exact.

#include "peers.h"

#include <benchmark/benchmark.h>
#include <pcl/common/common.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "fits.h"
#include "plain_dop.h"

#ifdef PCL_BV_BENCH_FCL
#include <fcl/math/bv/utility.h>
#endif

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Direction = std::array<double, 3>;

std::vector<Direction> cube_directions(std::size_t count) {
  std::vector<Direction> all;
  for (std::size_t k = 0; k < count; ++k)
    all.push_back({1.0 * kCubeDirections[k][0], 1.0 * kCubeDirections[k][1], 1.0 * kCubeDirections[k][2]});
  return all;
}

// Bounds as a peer gives them, along directions that it chose.
struct Bounds {
  std::vector<Direction> directions;
  std::vector<double> low, high;
};

// Points outside; throws where bounds are far from the points that should touch them.
std::size_t count_outside(const Cloud& cloud, const Bounds& bounds) {
  std::vector<double> least(bounds.low.size(), HUGE_VAL), greatest(bounds.low.size(), -HUGE_VAL);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < cloud.view.count; ++i) {
    const pcl_bv::Coordinates p = load_point(cloud.view, i);
    if (!is_valid(p)) continue;
    bool inside = true;
    for (std::size_t k = 0; k < bounds.low.size(); ++k) {
      const Direction& d = bounds.directions[k];
      const double projection = d[0] * p.x + d[1] * p.y + d[2] * p.z;
      inside = inside && projection >= bounds.low[k] && projection <= bounds.high[k];
      least[k] = std::min(least[k], projection);
      greatest[k] = std::max(greatest[k], projection);
    }
    outside += !inside;
  }
  for (std::size_t k = 0; k < bounds.low.size(); ++k) {
    const double slack = 1e-5 * (greatest[k] - least[k]);
    require(std::abs(bounds.low[k] - least[k]) <= slack && std::abs(bounds.high[k] - greatest[k]) <= slack,
            "a peer's answer is far from " + cloud.name.text());
  }
  return outside;
}

template <typename Low, typename High>
Bounds cube_bounds(std::size_t count, const Low& low, const High& high) {
  Bounds bounds{cube_directions(count), {}, {}};
  for (std::size_t k = 0; k < count; ++k) {
    bounds.low.push_back(low[k]);
    bounds.high.push_back(high[k]);
  }
  return bounds;
}

using Box = std::pair<Eigen::Vector4f, Eigen::Vector4f>;

template <bool dense>
Box pcl_box(const Cloud& cloud) {
  auto& points = const_cast<pcl::PointCloud<pcl::PointXYZ>&>(*cloud.pcl);  // the flag is all that differs
  points.is_dense = dense;
  Box box;
  pcl::getMinMax3D(points, box.first, box.second);
  points.is_dense = true;
  return box;
}

Box eigen_minmax(const Cloud& cloud) {
  const auto matrix = cloud.pcl->getMatrixXfMap();  // 4 x n
  return {matrix.rowwise().minCoeff(), matrix.rowwise().maxCoeff()};
}

Box eigen_box(const Cloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const pcl::PointXYZ& p : *cloud.pcl)
    box.extend(p.getVector3fMap());
  const Eigen::Vector3f &low = box.min(), &high = box.max();
  return {{low.x(), low.y(), low.z(), 0}, {high.x(), high.y(), high.z(), 0}};
}

// A plain loop's bounds along the first `k` directions.
template <std::size_t k>
struct Slabs {
  PlainDop kdop;
};

template <std::size_t k, PlainDop (*loop)(const float*, std::size_t)>
Slabs<k> plain(const Cloud& cloud) {
  return {loop(cloud.pcl->points.front().data, cloud.pcl->size())};
}

Bounds bounds_of(const Box& box) {
  return cube_bounds(3, box.first, box.second);
}
template <std::size_t k>
Bounds bounds_of(const Slabs<k>& slabs) {
  return cube_bounds(k, slabs.kdop.low, slabs.kdop.high);
}

#ifdef PCL_BV_BENCH_FCL
template <std::size_t k>
fcl::KDOP<float, k> fcl_kdop(const Cloud& cloud) {
  static_assert(sizeof(fcl::Vector3<float>) == 12);
  fcl::KDOP<float, k> kdop;
  fcl::fit(reinterpret_cast<const fcl::Vector3<float>*>(cloud.view.data), static_cast<int>(cloud.view.count),
           kdop);
  return kdop;
}

// Of fcl/math/bv/kDOP.h: the axes, six edges of the cube, for 24 three of its corners.
template <std::size_t k>
Bounds bounds_of(const fcl::KDOP<float, k>& kdop) {
  const std::vector<Direction> all = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, 0, 1},  {0, 1, 1},
                                      {1, -1, 0}, {1, 0, -1}, {0, 1, -1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
  Bounds bounds{all, {}, {}};
  for (std::size_t i = 0; i < k / 2; ++i) {
    bounds.low.push_back(kdop.dist(i));
    bounds.high.push_back(kdop.dist(i + k / 2));
  }
  return bounds;
}
#endif

template <auto fit>
Peer make_peer(const std::string& name, const std::string& layout = "xyz") {
  return {name, layout, [](const Cloud& cloud) { benchmark::DoNotOptimize(fit(cloud)); },
          [](Cloud& cloud) { return count_outside(cloud, bounds_of(fit(cloud))); }};
}

}  // namespace

const std::vector<Peer>& peers() {
  static const std::vector<Peer> all = {
      make_peer<pcl_box<true>>("pcl-dense"),
      make_peer<pcl_box<false>>("pcl-non-dense"),
      make_peer<eigen_minmax>("eigen-minmax"),
      make_peer<eigen_box>("eigen-box"),
      make_peer<plain<3, naive_dop<3>>>("naive-aabb"),
      make_peer<plain<7, naive_dop<7>>>("naive-dop14"),
      make_peer<plain<13, naive_dop<13>>>("naive-dop26"),
      make_peer<plain<13, plain_dop26>>("plain-dop26"),
#ifdef PCL_BV_BENCH_FCL
      make_peer<fcl_kdop<18>>("fcl-kdop18", "packed"),
      make_peer<fcl_kdop<24>>("fcl-kdop24", "packed"),
#endif
  };
  return all;
}

const Peer& peer(const std::string& name) {
  const auto found =
      std::find_if(peers().begin(), peers().end(), [&](const Peer& p) { return p.name == name; });
  require(found != peers().end(), "no peer " + name);
  return *found;
}

void Unchecked::check(Isa isa, const Cloud& cloud) const {
  const UncheckedExtents extents = run(isa, cloud.view);
  const PlainDop expected = plain<kMaxDirections, plain_dop26>(cloud).kdop;
  for (std::size_t k = 0; k < directions; ++k) {
    require(extents.low[k] == expected.low[k] && extents.high[k] == expected.high[k],
            name + " of " + cloud.name.text() + ": not the plain loop's answer");
  }
}

const std::vector<Unchecked>& unchecked() {
  static const std::vector<Unchecked> all = {{"unchecked-aabb", "aabb", unchecked_aabb, 3},
                                             {"unchecked-dop26", "dop26", unchecked_dop26, kMaxDirections},
                                             {"tested-dop26", "dop26", tested_dop26, kMaxDirections}};
  return all;
}

}  // namespace pcl_bv::bench
