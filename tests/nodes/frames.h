// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/synth/street.h"

namespace pcl_bv {
using namespace detail;

inline std::vector<std::vector<float>> street(std::size_t frames, std::size_t points = 32'000) {
  std::vector<std::vector<float>> all;
  StreetOptions options;
  options.points = points;
  for (std::size_t i = 0; i < frames; ++i)
    all.push_back(make_street_frame(options, i).cloud.xyz);
  return all;
}

inline Frame third_orientation(const std::vector<float>& xyz, std::size_t number) {
  Frame frame;
  frame.header = {number, static_cast<std::int64_t>(number) * 100'000'000, "lidar"};
  frame.points = PointView::of(xyz.data(), 12, xyz.size() / 3);
  return frame;
}

/// Points that are not there until they are asked for.
class AskedFor final : public PointSource {
 public:
  explicit AskedFor(const std::vector<float>& xyz) : xyz_(xyz) {}
  PointView view() const { return view_of(*this, xyz_.size() / 3, ScalarType::float32); }
  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override {
    buffer.resize(12 * count);
    std::memcpy(buffer.data(), xyz_.data() + 3 * first, 12 * count);
    return packed_points(buffer.data(), ScalarType::float32, count, first);
  }

 private:
  const std::vector<float>& xyz_;
};

inline void expect_equal(const FrameResult& a, const FrameResult& b) {
  EXPECT_EQ(a.clusters.indices, b.clusters.indices);
  EXPECT_EQ(a.clusters.offsets, b.clusters.offsets);
  EXPECT_EQ(a.ground.ground, b.ground.ground);
  EXPECT_EQ(a.tracks, b.tracks);
  ASSERT_EQ(a.volumes.size(), b.volumes.size());
  for (std::size_t i = 0; i < a.volumes.size(); ++i)
    EXPECT_TRUE(a.volumes[i] == b.volumes[i]) << i;
  ASSERT_EQ(a.results.size(), a.volumes.size());
  ASSERT_EQ(b.results.size(), b.volumes.size());
  for (std::size_t i = 0; i < a.results.size(); ++i)
    EXPECT_EQ(a.results[i].rank, b.results[i].rank) << i;
}

}  // namespace pcl_bv
