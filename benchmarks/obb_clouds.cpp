// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "obb_clouds.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "meshes.h"
#include "obb_peers.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/points/point_view.h"
#include "program.h"

namespace pcl_bv::bench {
namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;

class Shape {
 public:
  Shape(std::string kind, std::uint64_t seed) : kind_(std::move(kind)), random_(seed) {
    turn_ = Eigen::Quaterniond(normal_(random_), normal_(random_), normal_(random_), normal_(random_))
                .normalized()
                .toRotationMatrix();
    yaw_ = Eigen::AngleAxisd(uniform_(random_), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }

  Eigen::Vector3d point() {
    const Eigen::Vector3d g(normal_(random_), normal_(random_), normal_(random_));
    const Eigen::Vector3d u(uniform_(random_), uniform_(random_), uniform_(random_));
    if (kind_ == "sphere") return g.normalized();
    if (kind_ == "ball") return g.normalized() * std::cbrt((u.x() + 1) / 2);
    if (kind_ == "box") return turn_ * Eigen::Vector3d(2 * u.x(), u.y(), 0.5 * u.z());
    if (kind_ == "car" || kind_ == "L") {  // with the noise of a LiDAR
      const Eigen::Vector3d half(2.25, 0.9, 0.75);
      Eigen::Vector3d p = half.cwiseProduct(u);
      const auto side = static_cast<int>(random_() % (kind_ == "L" ? 2 : 3));
      p[side] = (side == 2 ? 1 : -1) * half[side];
      return yaw_ * (p + 0.02 * g) + Eigen::Vector3d(20, 7, 0);
    }
    return g;
  }

 private:
  std::string kind_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
  Eigen::Matrix3d turn_, yaw_;
};

void append(Points& points, const Eigen::Vector3d& p) {
  const Eigen::Vector3f f = p.cast<float>();
  points.push_back({f.x(), f.y(), f.z()});
}

Points::Ptr make_shape(const std::string& kind, std::size_t count) {
  const auto points = pcl::make_shared<Points>();
  Shape shape(kind, 1);
  while (points->size() < count)
    append(*points, shape.point());
  return points;
}

Points::Ptr make_points(const std::string& name) {
  const std::size_t colon = name.find(':');
  if (colon != std::string::npos)
    return make_shape(name.substr(0, colon), points_in_this_run(std::stoul(name.substr(colon + 1))));
  const auto points = pcl::make_shared<Points>();
  const std::vector<float>& xyz = find_mesh(name)->xyz;
  for (std::size_t i = 0; i < points_in_this_run(xyz.size() / 3); ++i)
    points->push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
  return points;
}

}  // namespace

ObbCloud::ObbCloud(const PointView& points) : points_(pcl::make_shared<Points>()) {
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    append(*points_, {p.x, p.y, p.z});
  }
}

PointView ObbCloud::view() const {
  return view_records(points_->points.data(), points_->size());
}

const std::vector<std::string>& obb_cloud_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"gauss:300", "gauss:1000",   "car:300",    "L:3000",      "gauss:3000",
                                 "car:10000", "gauss:100000", "box:100000", "ball:100000", "sphere:3000"};
    for (const std::string mesh : {"stanford-bunny", "armadillo"}) {
      if (find_mesh(mesh) != nullptr) all.push_back(mesh);
    }
    return all;
  }();
  return names;
}

const ObbCloud& obb_cloud(const std::string& name) {
  static std::map<std::string, ObbCloud> clouds;
  const auto found = clouds.find(name);
  if (found != clouds.end()) return found->second;
  return clouds.emplace(name, ObbCloud(name, make_points(name))).first->second;
}

ObbCloud make_clusters(std::size_t clusters, std::size_t points) {
  const auto all = pcl::make_shared<Points>();
  for (std::size_t c = 0; c < clusters; ++c) {
    Shape shape(c % 3 == 0 ? "car" : c % 3 == 1 ? "L" : "gauss", c + 1);
    for (std::size_t i = 0; i < points; ++i)
      append(*all, shape.point());
  }
  return {"clusters", all};
}

double least_volume(const ObbCloud& cloud) {
  static std::map<std::string, double> known;
  const auto [place, fresh] = known.try_emplace(cloud.name());
  if (fresh) {
    Obb box = *fit_obb(cloud.view(), ObbMethod::minimal);
    place->second = box.volume();
    for (const ObbPeer& peer : obb_peers()) {
      if (peer.against == "obb-min") place->second = std::min(place->second, peer.run(cloud).volume());
    }
  }
  return place->second;
}

void require_enclosed(const AnyVolume& volume, const PointView& points) {
  if (verify(volume, points).outside != 0) throw std::logic_error("a point is outside");
}

}  // namespace pcl_bv::bench
