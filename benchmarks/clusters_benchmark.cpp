// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground, and Euclidean clusters beside other people's, both sides in turns (timing.h: the counter `ratio`
// says how many times faster ours is), after a check that both find the same. Rows are named
// over-PEER/SCENE/n:POINTS/r:TOLERANCE.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <stdexcept>

#include "cluster_peers.h"
#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "pcl_bv/synth/street.h"
#include "timing.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

/// Scenes: "street" (a LiDAR sweep above ground), "street-whole" (with its ground), "sweep" (the first of
/// $PCL_BV_DATA/lidar_sequence, without ground and dead beams), "sheets" (two, dense, just out of reach of
/// 0.5 m), "sparse" (hardly a point within 0.5 m of another). `size` is rays for the first two, of no use for
/// the third.
struct Scene {
  std::string name;
  std::size_t size;
  auto operator<=>(const Scene&) const = default;
};

ClusterCloud::Ptr street(std::size_t rays, bool with_ground) {
  StreetOptions options;
  options.points = rays;
  const SynthCloud sweep = make_street_frame(options, 0).cloud;
  const auto cloud = std::make_shared<ClusterCloud>();
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const float* const p = &sweep.xyz[3 * i];
    const bool returned =
        p[0] != 0 || p[1] != 0 || p[2] != 0;  // PCL takes seconds over the copies of (0, 0, 0).
    if (returned && (with_ground || sweep.ground[i] == 0)) cloud->push_back({p[0], p[1], p[2]});
  }
  return cloud;
}

ClusterCloud::Ptr scattered(std::size_t points, float half_side, bool as_sheets) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-half_side, half_side);
  const auto cloud = std::make_shared<ClusterCloud>();
  for (std::size_t i = 0; i < points; ++i) {
    const float x = coordinate(random), y = coordinate(random), z = coordinate(random);
    cloud->push_back({x, y, as_sheets ? (i % 2 ? 0.505F : 0.F) : z});
  }
  return cloud;
}

ClusterCloud::Ptr sweep() {
  const RawCloud raw = read_cloud(std::string(std::getenv("PCL_BV_DATA")) + "/lidar_sequence/0000000000.pcd");
  GroundSplit split;
  GroundZones().split(raw.xyz(), {}, split);
  const auto cloud = std::make_shared<ClusterCloud>();
  for (const std::int32_t i : split.rest) {
    const Coordinates p = load_point(raw.xyz(), static_cast<std::size_t>(i));
    if (p.x != 0 || p.y != 0 || p.z != 0)
      cloud->push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  return cloud;
}

ClusterCloud::Ptr make(const Scene& scene) {
  const std::size_t size = points_in_this_run(scene.size);
  if (scene.name == "sweep") return sweep();
  if (scene.name == "sheets") return scattered(size, 5, true);
  if (scene.name == "sparse") return scattered(size, std::cbrt(static_cast<float>(size)), false);
  return street(size, scene.name == "street-whole");
}

ClusterCloud::Ptr cloud_of(const Scene& scene) {
  static std::map<Scene, ClusterCloud::Ptr> made;
  ClusterCloud::Ptr& cloud = made[scene];
  if (!cloud) cloud = make(scene);
  return cloud;
}

ClusterSets sorted(ClusterSets sets) {
  std::sort(sets.begin(), sets.end());
  return sets;
}

class Ours {
 public:
  Ours(const ClusterCloud& cloud, float tolerance, ParallelPolicy policy, std::size_t min_points = 1,
       float per_metre = 0)
      : view_(point_view(cloud)), settings_{tolerance}, policy_(policy) {
    settings_.min_points = min_points;
    settings_.tolerance_per_metre = per_metre;
  }

  void operator()() { clusterer_.extract(view_, settings_, clusters_, policy_); }

  ClusterSets sets() const {
    ClusterSets all;
    for (std::size_t i = 0; i < clusters_.size(); ++i)
      all.emplace_back(clusters_.list(i), clusters_.list(i) + clusters_.list_size(i));
    return all;
  }

 private:
  PointView view_;
  ClusterOptions settings_;
  ParallelPolicy policy_;
  EuclideanClusterer clusterer_;
  Clusters clusters_;
};

std::string row_name(const std::string& what, const Scene& scene, float tolerance) {
  return what + '/' + scene.name + "/n:" + std::to_string(cloud_of(scene)->size()) +
         "/r:" + std::to_string(tolerance).substr(0, 3);
}

// Registers a comparison of what first(cloud) returns with ours.
template <typename MakeFirst>
void add(const std::string& comparison, const Scene& scene, float tolerance, const ParallelPolicy& policy,
         int pairs, MakeFirst make_first) {
  add_turns(row_name(comparison, scene, tolerance), pairs, [=](benchmark::State& state) {
    const ClusterCloud::ConstPtr cloud = cloud_of(scene);
    Ours ours(*cloud, tolerance, policy);
    ours();
    compare(state, make_first(cloud, ours), ours);
  });
}

void over_peers(const Scene& scene, float tolerance, int pairs) {
  for (const ClusterPeer& peer : cluster_peers()) {
    add("over-" + peer.name, scene, tolerance, Serial{}, pairs,
        [=](const ClusterCloud::ConstPtr& cloud, const Ours& ours) {
          if (sorted(peer.run(cloud, tolerance)) != sorted(ours.sets())) {
            throw std::runtime_error(peer.name + " finds other clusters in " + scene.name);
          }
          return [=] { peer.run(cloud, tolerance); };
        });
  }
}

// How the cost grows.
void alone(const Scene& scene, float tolerance) {
  benchmark::RegisterBenchmark(row_name("clusters", scene, tolerance).c_str(), [=](benchmark::State& state) {
    Ours ours(*cloud_of(scene), tolerance, Serial{});
    for (auto _ : state)
      ours();
  })->Unit(benchmark::kMicrosecond);
}

void two_threads(const Scene& scene, float tolerance) {
  add("threads-2", scene, tolerance, policy_of(2), kPairs,
      [=](const ClusterCloud::ConstPtr& cloud, const Ours&) {
        return [cloud, one = std::make_shared<Ours>(*cloud, tolerance, Serial{})] { (*one)(); };
      });
}

// DBSCAN beside clusters without a core condition: the ratio is the latter's time over the former's.
void dbscan(const Scene& scene, float tolerance) {
  for (const std::size_t min_points : {2U, 5U, 20U}) {
    add_turns(row_name("dbscan-" + std::to_string(min_points), scene, tolerance), kPairs,
              [=](benchmark::State& state) {
                const ClusterCloud::ConstPtr cloud = cloud_of(scene);
                Ours plain(*cloud, tolerance, Serial{});
                Ours ours(*cloud, tolerance, Serial{}, min_points);
                ours();
                compare(
                    state, [&] { plain(); }, ours);
              });
  }
}

// Alternates a fixed and a growing tolerance. The ratio is the time of the fixed tolerance divided by that of
// the growing one.
void growing(const Scene& scene, float tolerance, float per_metre, unsigned threads) {
  const std::string what =
      "growing-" + std::to_string(per_metre).substr(0, 4) + "/threads:" + std::to_string(threads);
  add_turns(row_name(what, scene, tolerance), kPairs, [=](benchmark::State& state) {
    const ClusterCloud::ConstPtr cloud = cloud_of(scene);
    Ours plain(*cloud, tolerance, policy_of(threads));
    Ours ours(*cloud, tolerance, policy_of(threads), 1, per_metre);
    compare(
        state, [&] { plain(); }, ours);
  });
}

#ifdef PCL_BV_BENCH_OPEN3D
// Border points may go with another cluster than ours, which is that of the nearest core point.
void over_open3d(const Scene& scene, float tolerance, std::size_t min_points) {
  add_turns(row_name("dbscan-" + std::to_string(min_points) + "-over-open3d", scene, tolerance), 3,
            [=](benchmark::State& state) {
              const ClusterCloud::ConstPtr cloud = cloud_of(scene);
              Ours ours(*cloud, tolerance, Serial{}, min_points);
              ours();
              const std::vector<int> theirs = open3d_dbscan(*cloud, tolerance, min_points);
              const std::size_t clusters = *std::max_element(theirs.begin(), theirs.end()) + 1;
              std::size_t in_ours = 0;
              for (const std::vector<int>& cluster : ours.sets())
                in_ours += cluster.size();
              const auto in_theirs = static_cast<std::size_t>(
                  std::count_if(theirs.begin(), theirs.end(), [](int label) { return label >= 0; }));
              if (clusters != ours.sets().size() || in_theirs != in_ours)
                throw std::runtime_error("Open3D finds other clusters in " + scene.name);
              compare(
                  state, [&] { open3d_dbscan(*cloud, tolerance, min_points); }, ours);
            });
}
#endif

void register_all() {
#ifdef PCL_BV_BENCH_OPEN3D
  for (const float r : {0.2F, 0.5F}) {
    for (const std::size_t min_points : {2U, 20U})
      over_open3d({"street", 128'000}, r, min_points);
  }
#endif
  for (const float r : {0.2F, 0.5F, 100.F})
    dbscan({"street", 128'000}, r);
  for (const float r : {0.1F, 0.2F, 0.5F, 1.F}) {
    for (const std::size_t rays : {56'000U, 128'000U})  // 19 k and 43 k points
      over_peers({"street", rays}, r, 5);
    over_peers({"street", 300'000}, r, 3);                // 100 k points
    if (r < 0.3F) over_peers({"street", 900'000}, r, 1);  // 300 k points; PCL takes 9 s at 0.5 m
    over_peers({"street-whole", 128'000}, r, 3);
    two_threads({"street-whole", 128'000}, r);
  }
  for (const std::size_t points : {20'000U, 100'000U, 300'000U}) {
    over_peers({"sparse", points}, 0.5F, 3);
    two_threads({"sparse", points}, 0.5F);
    two_threads({"sheets", points}, 0.5F);
  }
  if (std::getenv("PCL_BV_DATA") != nullptr && !tiny()) {
    for (const float r : {0.2F, 0.5F}) {
      over_peers({"sweep", 0}, r, 5);
      dbscan({"sweep", 0}, r);
    }
    for (const unsigned threads : {1U, 2U}) {
      growing({"sweep", 0}, 0.5F, 0.01F, threads);
      growing({"sweep", 0}, 0.5F, 0.03F, threads);
    }
  }
  for (std::size_t rays = 3072; rays <= 3'145'728; rays *= 4)  // 1 k to 1 M points
    alone({"street", rays}, 0.5F);
  over_peers({"sheets", 20'000}, 0.5F, 3);  // Where a search finds thousands of neighbours.
}

// A town of 100 streets, clustered in memory and with 4 million points in memory at a time. The ratio is the
// former's time over the latter's. Both have two threads. The row is stored/town/n:POINTS/r:0.5.
void stored() {
  add_turns("stored/town/n:13000000/r:0.5", 5, [](benchmark::State& state) {
    const ClusterCloud::ConstPtr street = cloud_of({"street-whole", 128'000});
    std::vector<float> xyz;
    for (int x = 0; x < 10; ++x) {
      for (int y = 0; y < 10; ++y) {
        for (const auto& p : *street)
          xyz.insert(xyz.end(), {p.x + 100 * static_cast<float>(x), p.y + 60 * static_cast<float>(y), p.z});
      }
    }
    const PointView points = PointView::of(xyz.data(), 12, xyz.size() / 3);
    const ClusterOptions options{0.5F, 30};
    const auto in_memory = [&] { return cluster(points, options, {policy_of(2)}).size(); };
    StoredClusterOptions store;  // as pcd_bv uses it
    store.visit = [](std::size_t, const std::vector<PointView>&, const Execution&) {};
    store.keep_visited = false;
    const auto from_bricks = [&] { return StoredClusters(points, options, store, {policy_of(2)}).size(); };
    if (in_memory() != from_bricks()) throw std::runtime_error("other clusters from bricks");
    compare(state, in_memory, from_bricks);
    state.counters["points"] = static_cast<double>(points.count);
  });
}

// A whole sweep, by one plane and by zones: rows ground/KIND/n:POINTS, with precision and recall.
template <typename Split>
void add_ground(const std::string& kind, Split split) {
  benchmark::RegisterBenchmark(("ground/" + kind + "/n:128000").c_str(), [split](benchmark::State& state) {
    StreetOptions options;
    options.points = points_in_this_run(128'000);
    const SynthCloud sweep = make_street_frame(options, 0).cloud;
    const PointView view = PointView::of(sweep.xyz.data(), 12, sweep.size());
    GroundSplit result;
    for (auto _ : state)
      split(view, result);
    double truth = 0, right = 0;
    for (const std::uint32_t ground : sweep.ground)
      truth += ground;
    for (const std::int32_t i : result.ground)
      right += sweep.ground[static_cast<std::size_t>(i)];
    state.counters["recall"] = right / truth;
    state.counters["precision"] = right / static_cast<double>(result.ground.size());
  })->Unit(benchmark::kMicrosecond);
}

void ground() {
  add_ground("plane", [](const PointView& view, GroundSplit& result) { split_ground(view, {}, result); });
  add_ground("zones", [zones = std::make_shared<GroundZones>()](const PointView& view, GroundSplit& result) {
    zones->split(view, {}, result);
  });
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  pcl_bv::bench::register_all();
  pcl_bv::bench::ground();
  pcl_bv::bench::stored();
  return pcl_bv::bench::run_program(argc, argv);
}
