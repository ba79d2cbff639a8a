// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests of objects of tiled clouds.
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pcl_bv/io/read_cloud.h"
#include "tiles.h"

namespace pcl_bv::test {

class TiledObjects : public Tiled {
 protected:
  // Walls, poles and clumps in a yard of 60 m, in the order of a sensor that turns, and noise.
  static Points yard(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 65536) / 65536;
    };
    Points points;
    for (int object = 0; object < 60; ++object) {
      const double x = uniform(-30, 30), y = uniform(-30, 30),
                   length = object % 4 == 0 ? 25 : uniform(0.1, 3), angle = uniform(0, 6.28),
                   height = uniform(0.5, 4);
      const int count = object % 4 == 0 ? 2500 : static_cast<int>(uniform(1, 400));
      for (int i = 0; i < count; ++i) {
        const double along = uniform(0, length);
        points.push_back({static_cast<float>(x + along * std::cos(angle) + uniform(-0.1, 0.1)),
                          static_cast<float>(y + along * std::sin(angle) + uniform(-0.1, 0.1)),
                          static_cast<float>(uniform(0, height))});
      }
    }
    for (int i = 0; i < 500; ++i)
      points.push_back({static_cast<float>(uniform(-30, 30)), static_cast<float>(uniform(-30, 30)), 2});
    if (seed % 2 == 0) std::shuffle(points.begin(), points.end(), random);
    for (std::size_t i = 70; i < points.size(); i += 200)
      points[i][i % 3] = std::numeric_limits<float>::quiet_NaN();
    return points;
  }

  // Options that use all parts of the clustering.
  static std::vector<std::vector<std::string>> cluster_options() {
    return {{"--cluster", "0.4", "--volume", "all,hull,best"},
            {"--cluster", "0.4", "--min-points", "5", "--min-size", "20", "--volume", "aabb,obb-lshape"},
            {"--cluster", "1.5", "--max-size", "3000", "--volume", "sphere-epos26"},
            {"--cluster", "1.5", "--max-size", "3000", "--oversized", "keep", "--volume", "dop26,prism"},
            {"--cluster", "0.4", "--min-extent", "0.5,0.1,1", "--max-extent", "20,5,9", "--volume", "prism"}};
  }

  // The field `label` of a file.
  static std::vector<std::uint32_t> labels_in(const std::string& path) {
    const RawCloud cloud = read_cloud(path);
    const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                    [](const PointField& f) { return f.name == "label"; });
    std::vector<std::uint32_t> labels(field == cloud.fields.end() ? 0 : cloud.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
      std::memcpy(&labels[i], cloud.data.data() + i * cloud.point_step + field->offset, sizeof labels[i]);
    return labels;
  }

  Result objects(const std::vector<std::string>& options, const std::vector<std::string>& more,
                 const std::string& input) const {
    std::vector<std::string> all{"--format", "jsonl"};
    all.insert(all.end(), options.begin(), options.end());
    all.insert(all.end(), more.begin(), more.end());
    all.push_back(input);
    return run(all);
  }
};

}  // namespace pcl_bv::test
