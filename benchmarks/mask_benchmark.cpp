// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which of 300 k points are inside ten padded volumes, beside a loop over contains(), in turns: `ratio` says
// how many times faster the mask is. Rows are mask/SCENE/ISA/n:POINTS/threads:N, and /wait:POLICY.

#include <random>
#include <stdexcept>

#include "pcl_bv/trees/region_mask.h"
#include "rows.h"

namespace pcl_bv::bench {
namespace {

// The links of a robot, within a metre of the sensor and about 0.3 m in size: boxes, spheres, oriented boxes,
// cylinders and capsules, two of each.
std::vector<Region> links() {
  std::vector<Region> regions;
  for (const double side : {1.0, -1.0}) {
    const auto at = [&](double x, double y, double z) { return Eigen::Vector3d(side * x, y, 0.5 * z - 1); };
    const Eigen::Matrix3d axes = Eigen::Quaterniond(1, 0.3, -0.2 * side, 0.4).normalized().toRotationMatrix();
    const Eigen::Vector3d a = at(0.5, 0.1, 1), b = at(0.1, -0.4, 0.2);
    for (const AnyVolume& volume :
         {AnyVolume(Aabb(b.array() - 0.4, b.array() + 0.3)), AnyVolume(Sphere(at(0.2, 0.6, 0.6), 0.3)),
          AnyVolume(Obb(at(0.3, -0.2, 1), axes, {0.4, 0.2, 0.1})),
          AnyVolume(Cylinder(at(0.7, 0.3, 0.4), axes.col(0), 0.15, 0.4)),
          AnyVolume(Capsule(a, a + Eigen::Vector3d(0.3, 0.4, 0.2), 0.1))}) {
      regions.push_back({volume, 0.05});
    }
  }
  return regions;
}

// "sweep": of a street, a ninth of its columns of points taken by the robot, as links hide what is behind
// them. "links": all points about the robot, so that nearly every packet is in several boxes.
pcl::PointCloud<pcl::PointXYZ> scene_of(const std::string& scene) {
  pcl::PointCloud<pcl::PointXYZ> points = *cloud({"street", 300'032}).pcl;
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal(0, 0.5F);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (scene == "links" || i / 100 % 9 == 0)
      points[i] = {normal(random), normal(random), normal(random) - 0.7F};
  }
  return points;
}

void loop_over_contains(const RegionMask& mask, const PointView& points, std::vector<std::uint8_t>& inside) {
  inside.resize(points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    inside[i] = mask.contains({p.x, p.y, p.z});
  }
}

void add_mask(const std::string& scene, Isa isa, unsigned threads) {
  const std::string row = "mask/" + scene + '/' + std::string(isa_name(isa)) +
                          "/n:300032/threads:" + std::to_string(threads) +
                          (threads == 1 ? "" : wait_policy());
  add_turns(row, kPairs, [=](benchmark::State& state) {
    const auto made = scene_of(scene);
    const PointView points = PointView::of(made.points.data()->data, sizeof(pcl::PointXYZ), made.size());
    const RegionMask mask(links());
    const Execution execution{policy_of(threads), isa};
    std::vector<std::uint8_t> expected, inside;
    loop_over_contains(mask, points, expected);
    mask.mark(points, inside, execution);
    if (inside != expected) throw std::logic_error("other points are inside");
    compare(
        state, [&] { loop_over_contains(mask, points, expected); },
        [&] { mask.mark(points, inside, execution); });
    state.counters["points"] = static_cast<double>(points.count);
    state.counters["inside"] = static_cast<double>(std::count(inside.begin(), inside.end(), 1));
  });
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  using namespace pcl_bv::bench;
  for (const std::string scene : {"sweep", "links"}) {
    for (const pcl_bv::Isa isa : pcl_bv::usable_isas()) {
      for (const unsigned threads : {1U, 2U})
        add_mask(scene, isa, threads);
    }
  }
  return run_program(argc, argv);
}
