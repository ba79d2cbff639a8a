// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree_inputs.h"

#include <pcl/common/common.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "clouds.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/synth/street.h"
#include "program.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

void add_point(TreeCloud& cloud, float x, float y, float z) {
  if (x != 0 || y != 0 || z != 0) cloud.push_back({x, y, z});
}

TreeCloud street_frame(std::size_t points, std::size_t frame) {
  StreetOptions options;
  options.points = points_in_this_run(points);
  const SynthCloud sweep = make_street_frame(options, frame).cloud;
  TreeCloud cloud;
  for (std::size_t i = 0; i < sweep.size(); ++i)
    add_point(cloud, sweep.xyz[3 * i], sweep.xyz[3 * i + 1], sweep.xyz[3 * i + 2]);
  return cloud;
}

TreeCloud recorded_sweep(const std::string& name) {
  const RawCloud raw = read_cloud(std::string(std::getenv("PCL_BV_DATA")) + "/lidar_sequence/" + name);
  TreeCloud cloud;
  for (std::size_t i = 0; i < raw.xyz().count; ++i) {
    const Coordinates p = load_point(raw.xyz(), i);
    add_point(cloud, static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  }
  return cloud;
}

std::vector<pcl::PointXYZ> all_of(const TreeCloud& cloud) {
  return {cloud.begin(), cloud.end()};
}

TreeInput make(const std::string& scene, std::size_t points) {
  TreeInput input;
  if (scene == "street" || scene == "sweep") {
    const bool recorded = scene == "sweep";
    input.cloud =
        std::make_shared<TreeCloud>(recorded ? recorded_sweep("0000000000.pcd") : street_frame(points, 0));
    input.near = all_of(recorded ? recorded_sweep("0000000001.pcd") : street_frame(points, 1));
    input.radius = 0.5F;
  } else {
    input.cloud = std::make_shared<TreeCloud>(*cloud({scene, points}).pcl);
  }
  Eigen::Vector4f low, high;
  pcl::getMinMax3D(*input.cloud, low, high);
  input.side = (high - low).head<3>().maxCoeff();
  std::mt19937_64 random(1);
  if (input.near.empty()) {
    input.radius = 0.5F * input.side / std::cbrt(static_cast<float>(input.cloud->size()));
    std::normal_distribution<float> normal(0, 0.1F * input.radius);
    std::uniform_int_distribution<std::size_t> any(0, input.cloud->size() - 1);
    for (int i = 0; i < 4096; ++i) {
      pcl::PointXYZ p = (*input.cloud)[any(random)];
      p.x += normal(random), p.y += normal(random), p.z += normal(random);
      input.near.push_back(p);
    }
  }
  std::uniform_real_distribution<float> part(0, 1);
  for (int i = 0; i < 4096; ++i) {
    pcl::PointXYZ p;
    for (int axis = 0; axis < 3; ++axis)
      p.data[axis] = low[axis] + part(random) * (high[axis] - low[axis]);
    input.centres.push_back(p);
  }
  return input;
}

}  // namespace

const TreeInput& tree_input(const std::string& scene, std::size_t points) {
  static std::string made;
  static TreeInput input;
  const std::string wanted = scene + std::to_string(points);
  if (made != wanted) {
    input = {};  // before the next one is made: memory holds one
    input = make(scene, points);
    made = wanted;
  }
  return input;
}

}  // namespace pcl_bv::bench
