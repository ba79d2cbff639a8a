// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/trees/collision.h"
#include "pcl_bv/trees/volume_tree.h"
#include "pcl_bv/volumes/pair_queries.h"
#include "timing.h"
#include "tree_rows.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Places = std::vector<Eigen::Vector3d>;

Places places_in(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> along(-50, 50), up(0, 3);
  Places places;
  for (std::size_t i = 0; i < count; ++i)
    places.emplace_back(along(random), along(random), up(random));
  return places;
}

// Objects of a street: boxes, upright ones, spheres, capsules and 26-DOPs in turns, 1 to 4 m long.
std::vector<AnyVolume> objects(std::size_t count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> half(0.5, 2), turn(0, std::numbers::pi);
  std::vector<AnyVolume> volumes;
  for (const Eigen::Vector3d& at : places_in(count, 4)) {
    const Eigen::Vector3d size(half(random), 0.5, 0.7);
    const Eigen::Matrix3d axes = Eigen::AngleAxisd(turn(random), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Obb upright(at, axes, size);
    Kdop kdop;
    for (const Eigen::Vector3d& corner : upright.corners())
      kdop.extend(corner);
    const AnyVolume kinds[] = {Aabb(at - size, at + size), upright, Sphere(at, size.x()),
                               Capsule(at - axes.col(0), at + axes.col(0), 0.4), kdop};
    volumes.push_back(kinds[volumes.size() % 5]);
  }
  return volumes;
}

template <typename Loop, typename Tree>
void add_over_loop(const std::string& what, std::size_t count, Loop loop, Tree by_tree) {
  add_turns("volumes/over-loop/" + what + "/n:" + std::to_string(count) + "/threads:1", kPairs,
            [=](benchmark::State& state) {
              const std::vector<AnyVolume> volumes = objects(count);
              const VolumeTree tree(volumes);
              const Places places = places_in(tiny() ? 16 : 256, 5);
              const auto sum = [&](const auto& answer) {
                double all = 0;
                for (const Eigen::Vector3d& place : places)
                  all += answer(place);
                benchmark::DoNotOptimize(all);
                return all;
              };
              const auto one_by_one = [&] { return sum([&](const auto& p) { return loop(volumes, p); }); };
              const auto asked = [&] { return sum([&](const auto& p) { return by_tree(tree, p); }); };
              if (one_by_one() != asked()) throw std::logic_error("the tree answers otherwise");
              compare(state, one_by_one, asked);
              state.counters["questions"] = static_cast<double>(places.size());
            });
}

void add_volume_trees(std::size_t count) {
  add_over_loop(
      "contains", count,
      [](const std::vector<AnyVolume>& volumes, const Eigen::Vector3d& p) {
        return static_cast<double>(
            std::any_of(volumes.begin(), volumes.end(), [&](const AnyVolume& v) { return contains(v, p); }));
      },
      [](const VolumeTree& tree, const Eigen::Vector3d& p) {
        return static_cast<double>(tree.any_containing(p));
      });
  const Eigen::Vector3d direction(1, 0.5, 0.01);
  add_over_loop(
      "first-hit", count,
      [=](const std::vector<AnyVolume>& volumes, const Eigen::Vector3d& p) {
        double first = 1e9;
        for (const AnyVolume& v : volumes) {
          if (const auto hit = intersect(v, p, direction)) first = std::min(first, hit->enter);
        }
        return first;
      },
      [=](const VolumeTree& tree, const Eigen::Vector3d& p) {
        const auto hit = tree.first_hit(p, direction);
        return hit ? hit->interval.enter : 1e9;
      });
}

// A robot of ten links among the points of a sweep: which of them are within 5 cm of a point.
void add_links(Isa isa) {
  add_turns("volumes/links/" + tree_input_name(isa, "street", 128'000) + "/threads:1", kPairs,
            [=](benchmark::State& state) {
              const PointTree tree(point_view(*tree_input("street", 128'000).cloud), {Serial{}, isa});
              std::vector<AnyVolume> links;
              for (int i = 0; i < 10; ++i)
                links.emplace_back(Capsule({0.3 * i, 0, 1}, {0.3 * i + 0.3, 0, 1}, 0.1));
              const MovingVolumes robot(links);
              const Places places = places_in(tiny() ? 8 : 256, 6);
              std::size_t touched = 0;
              for (auto _ : state) {
                touched = 0;
                state.SetIterationTime(seconds(
                    [&] {
                      for (const Eigen::Vector3d& place : places) {
                        std::vector<std::int32_t> found;
                        list_within(tree, robot, Eigen::Isometry3d(Eigen::Translation3d(place)), 0.05, found);
                        touched += found.size();
                      }
                    },
                    1));
              }
              state.counters["touched"] = static_cast<double>(touched);
              state.counters["questions"] = static_cast<double>(places.size());
            });
}

}  // namespace

void add_volumes(Isa isa) {
  for (const std::size_t count : {std::size_t{100}, std::size_t{1000}})
    add_volume_trees(count);
  add_links(isa);
}

}  // namespace pcl_bv::bench
