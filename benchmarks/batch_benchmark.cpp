// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Many clusters at once against one after another: the estimation classes' compute(clusters, volumes) beside
// compute(volume) for each cluster, in turns. Rows are batch/ESTIMATORS/CLUSTERSxPOINTS/threads:N, and
// /wait:POLICY where threads wait for work as OMP_WAIT_POLICY says; `ratio` says how many times faster the
// batch is. Both give the same volumes, which is checked first.

#include <benchmark/benchmark.h>
#include <pcl/point_types.h>

#include <numeric>
#include <random>
#include <stdexcept>

#include "pcl_bv/estimation/bounding_volume_estimation.h"
#include "timing.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

struct Scene {
  Cloud::Ptr cloud{new Cloud};
  std::vector<pcl::PointIndices> clusters;
};

// Clusters 10 m apart, their points mixed in memory as in a sweep.
Scene make_scene(std::size_t clusters, std::size_t points) {
  Scene scene;
  scene.clusters.resize(clusters);
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal;
  for (std::size_t i = 0; i < clusters * points; ++i) {
    const std::size_t cluster = i % clusters;
    const float x = normal(random), y = normal(random);
    scene.cloud->emplace_back(10 * static_cast<float>(cluster) + x, 2 * y, normal(random));
    scene.clusters[cluster].indices.push_back(static_cast<int>(i));
  }
  return scene;
}

template <typename Estimation, typename Volume>
class Fitter {
 public:
  Fitter(const Scene& scene, unsigned threads) : scene_(scene) {
    estimation_.setInputCloud(scene.cloud);
    estimation_.setNumberOfThreads(threads);
    for (const pcl::PointIndices& cluster : scene.clusters)
      lists_.push_back(pcl::IndicesPtr(new pcl::Indices(cluster.indices)));
  }
  void at_once() { estimation_.compute(scene_.clusters, volumes_); }
  void one_by_one() {
    volumes_.resize(lists_.size());
    for (std::size_t i = 0; i < lists_.size(); ++i) {
      estimation_.setIndices(lists_[i]);
      estimation_.compute(volumes_[i]);
    }
    estimation_.setIndices(pcl::IndicesPtr());
  }
  const std::vector<Volume>& volumes() const { return volumes_; }

 private:
  const Scene& scene_;
  Estimation estimation_;
  std::vector<pcl::IndicesPtr> lists_;
  std::vector<Volume> volumes_;
};

struct Three {
  Three(const Scene& scene, unsigned threads)
      : boxes(scene, threads), spheres(scene, threads), oriented(scene, threads) {}
  void at_once() { boxes.at_once(), spheres.at_once(), oriented.at_once(); }
  void one_by_one() { boxes.one_by_one(), spheres.one_by_one(), oriented.one_by_one(); }

  struct Dito : ObbEstimation<pcl::PointXYZ> {
    Dito() { setMethod(ObbMethod::dito14); }
  };
  Fitter<AabbEstimation<pcl::PointXYZ>, Aabb> boxes;
  Fitter<SphereEstimation<pcl::PointXYZ>, Sphere> spheres;
  Fitter<Dito, Obb> oriented;
};

void check(Three& three) {
  three.one_by_one();
  const auto boxes = three.boxes.volumes();
  const auto spheres = three.spheres.volumes();
  const auto oriented = three.oriented.volumes();
  three.at_once();
  if (boxes != three.boxes.volumes() || oriented != three.oriented.volumes())
    throw std::logic_error("other boxes");
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (spheres[i].radius() != three.spheres.volumes()[i].radius()) throw std::logic_error("other spheres");
  }
}

void run(benchmark::State& state, std::size_t clusters, std::size_t points, unsigned threads) {
  const Scene scene = make_scene(clusters, points);
  Three single(scene, threads), batch(scene, threads);
  check(batch);
  compare(
      state, [&] { single.one_by_one(); }, [&] { batch.at_once(); });
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  using namespace pcl_bv::bench;
  const std::pair<std::size_t, std::size_t> sizes[] = {{100, 300}, {1000, 50}, {1, 300'000}};
  for (const auto& [clusters, points] : sizes) {
    for (const unsigned threads : {1U, 2U}) {
      const std::string row = "batch/aabb+sphere-exact+obb-dito14/" + std::to_string(clusters) + 'x' +
                              std::to_string(points) + "/threads:" + std::to_string(threads) + wait_policy();
      add_turns(row, kPairs, [=, clusters = clusters, points = points](benchmark::State& state) {
        run(state, clusters, points, threads);
      });
    }
  }
  return run_program(argc, argv);
}
