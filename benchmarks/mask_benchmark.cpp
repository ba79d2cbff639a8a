// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which of 300 k points are inside ten padded volumes, beside a loop over contains(), in turns: `ratio` says
// how many times faster the mask is. Rows are mask/SCENE/ISA/n:POINTS/threads:N, and /wait:POLICY. Rows
// mask/street/... and mask/shuffled/... are of many regions, beside masks of a few of them each, which test
// all points against all.

#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "convex_region.h"
#include "inflated.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/trees/region_mask.h"
#include "rows.h"

namespace pcl_bv::bench {
using namespace detail;
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

// The links and others like them, each about the first point of a square of ground of 2 m, chosen at random:
// as objects that are tracked stand in a street. A small cloud has fewer squares: then two may share one.
std::vector<Region> regions_about(const PointView& points, std::size_t count) {
  std::mt19937_64 random(2);
  std::set<std::pair<double, double>> taken;
  std::vector<Region> regions = links();
  for (std::size_t tried = 0; regions.size() < count; ++tried) {
    const Coordinates p = load_point(points, random() % points.count);
    const bool another = taken.emplace(std::floor(p.x / 2), std::floor(p.y / 2)).second;
    if (!another && tried < 100 * count) continue;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    const AnyVolume& link = regions[regions.size() % 10].volume;
    move.translation() = Eigen::Vector3d(p.x, p.y, p.z) - center(link);
    regions.push_back({transformed(link, move), 0.3});
  }
  return regions;
}

void add_many(const std::string& scene, Isa isa, std::size_t count, unsigned threads) {
  const std::string row = "mask/" + scene + '/' + std::string(isa_name(isa)) +
                          "/n:300032/regions:" + std::to_string(count) +
                          "/threads:" + std::to_string(threads) + (threads == 1 ? "" : wait_policy());
  add_turns(row, kPairs, [=](benchmark::State& state) {
    auto made = scene_of("sweep");
    if (scene == "shuffled") std::shuffle(made.begin(), made.end(), std::mt19937_64(3));
    const PointView points = PointView::of(made.points.data()->data, sizeof(pcl::PointXYZ), made.size());
    const std::vector<Region> regions = regions_about(points, count);
    std::vector<ConvexRegion> convex;
    for (const auto& [volume, padding] : regions)
      convex.push_back(convex_region(inflated(volume, padding)));
    const RegionTests tests(convex);
    const RegionMask mask(regions);
    const Execution execution{policy_of(threads), isa};
    std::vector<std::uint8_t> expected(points.count), inside;
    const auto against_all = [&] {
      for_each_chunk(execution.parallel, chunk_count(points.count), [&](std::size_t chunk) {
        const std::size_t begin = chunk * kChunkPoints, n = std::min(kChunkPoints, points.count - begin);
        region_states(isa, points.slice(begin, n), tests, expected.data() + begin);
      });
    };
    against_all();
    mask.mark(points, inside, execution);
    for (std::size_t i = 0; i < points.count; ++i) {
      if (expected[i] != static_cast<std::uint8_t>(RegionState::unclear) && inside[i] != expected[i])
        throw std::logic_error("other points are inside");
    }
    compare(state, against_all, [&] { mask.mark(points, inside, execution); });
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
  for (const std::string scene : {"street", "shuffled"}) {
    for (const pcl_bv::Isa isa : pcl_bv::usable_isas()) {
      for (const std::size_t regions : {std::size_t{100}, std::size_t{1000}})
        add_many(scene, isa, regions, 1);
    }
    add_many(scene, pcl_bv::usable_isas().back(), 1000, 2);
  }
  return run_program(argc, argv);
}
