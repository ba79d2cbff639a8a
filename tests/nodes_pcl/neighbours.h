// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds of PCL's, what is near by looking at every point, and answers of two searches side by side.
#pragma once

#include <gtest/gtest.h>
#include <pcl/common/point_tests.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "pcl_bv/nodes_pcl/point_tree_search.h"
#include "pcl_bv/synth/street.h"

namespace pcl_bv::test {
using namespace detail;

using PointsXyz = pcl::PointCloud<pcl::PointXYZ>;
using SearchXyz = pcl::search::Search<pcl::PointXYZ>;

inline PointsXyz::Ptr points_of(const std::vector<float>& xyz) {
  const PointsXyz::Ptr cloud(new PointsXyz);
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
    cloud->push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  return cloud;
}

inline PointsXyz::Ptr uniform(std::size_t n, float half_side, unsigned seed, float offset = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-half_side, half_side);
  std::vector<float> xyz(3 * n);
  for (float& c : xyz)
    c = offset + coordinate(random);
  return points_of(xyz);
}

/// A sweep without the rays that met nothing, which are all at (0, 0, 0).
inline PointsXyz::Ptr street(std::size_t rays) {
  StreetOptions options;
  options.points = rays;
  const SynthCloud sweep = make_street_frame(options, 0).cloud;
  const PointsXyz::Ptr cloud(new PointsXyz);
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const float* const p = &sweep.xyz[3 * i];
    if (p[0] != 0 || p[1] != 0 || p[2] != 0) cloud->push_back({p[0], p[1], p[2]});
  }
  return cloud;
}

inline pcl::IndicesPtr every(std::size_t step, std::size_t size) {
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (std::size_t i = 0; i < size; i += step)
    indices->push_back(static_cast<pcl::index_t>(i));
  return indices;
}

/// All valid points of the cloud, or of those that the indices name, nearest first, as Neighbor says.
template <typename PointT>
std::vector<Neighbor> by_distance(const pcl::PointCloud<PointT>& cloud, const pcl::Indices* indices,
                                  const PointT& place) {
  std::vector<Neighbor> all;
  const std::size_t count = indices != nullptr ? indices->size() : cloud.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = indices != nullptr ? (*indices)[i] : static_cast<pcl::index_t>(i);
    const PointT& p = cloud[static_cast<std::size_t>(index)];
    const double x = double{p.x} - place.x, y = double{p.y} - place.y, z = double{p.z} - place.z;
    const double square = (x * x + y * y) + z * z;
    if (std::isfinite(square)) all.push_back({index, square});
  }
  std::sort(all.begin(), all.end());
  return all;
}

struct Answer {
  int count = 0;
  pcl::Indices indices;
  std::vector<float> squares;

  bool operator==(const Answer& other) const {
    return count == other.count && indices == other.indices && squares == other.squares;
  }
};

template <typename Search, typename... Question>
Answer nearest(const Search& search, const Question&... question) {
  Answer answer{0, {7, 7, 7}, {-1}};
  answer.count = search.nearestKSearch(question..., answer.indices, answer.squares);
  return answer;
}

template <typename Search, typename Where>
Answer within(const Search& search, const Where& where, double radius, unsigned most = 0) {
  Answer answer{0, {7, 7, 7}, {-1}};
  answer.count = search.radiusSearch(where, radius, answer.indices, answer.squares, most);
  return answer;
}

/// The first `most` of them that are nearer than the radius.
inline Answer first_of(const std::vector<Neighbor>& sorted, std::size_t most,
                       double radius = std::numeric_limits<double>::infinity()) {
  Answer answer;
  for (const Neighbor& one : sorted) {
    if (answer.indices.size() == most || !(one.squared_distance < radius * radius)) break;
    answer.indices.push_back(one.index);
    answer.squares.push_back(static_cast<float>(one.squared_distance));
  }
  answer.count = static_cast<int>(answer.indices.size());
  return answer;
}

/// Five roundings of float, and one of ours: 6 * 2^-24, and as much again for what PCL spares by rounded
/// bounds.
inline constexpr float kFloatError = 12 * 0x1p-24F;

/// The same points at the same distances, but for those as far as `limit`: of them either may have more.
inline void expect_same_up_to_rounding(const Answer& ours, const Answer& theirs, float limit) {
  std::map<pcl::index_t, float> left;
  for (std::size_t i = 0; i < theirs.indices.size(); ++i)
    left[theirs.indices[i]] = theirs.squares[i];
  const auto at_limit = [limit](float square) { return std::abs(square - limit) <= kFloatError * limit; };
  for (std::size_t i = 0; i < ours.indices.size(); ++i) {
    const auto found = left.find(ours.indices[i]);
    if (found == left.end()) {
      EXPECT_TRUE(at_limit(ours.squares[i])) << "PCL lacks point " << ours.indices[i];
      continue;
    }
    EXPECT_NEAR(found->second, ours.squares[i], kFloatError * ours.squares[i]) << "point " << found->first;
    left.erase(found);
  }
  for (const auto& [index, square] : left)
    EXPECT_TRUE(at_limit(square)) << "PCL has point " << index << ", too";
}

}  // namespace pcl_bv::test
