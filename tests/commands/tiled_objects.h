// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests of objects of tiled clouds.
#pragma once

#include <limits>
#include <random>
#include <string>
#include <vector>

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
