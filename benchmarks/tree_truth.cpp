// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "clouds.h"
#include "pcl_bv/trees/point_tree.h"
#include "program.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

using Place = Eigen::Vector3d;

bool same(const Neighbor& a, const Neighbor& b) {
  return a.index == b.index && a.squared_distance == b.squared_distance;
}

// A cloud and its tree, and questions to both.
class Asked {
 public:
  Asked(const std::string& scene, Isa isa, std::uint64_t seed) : random_(seed) {
    const CloudName name{scene, 2048};
    const Cloud& made = cloud(name);
    for (const pcl::PointXYZ& p : *made.pcl)
      points_.push_back(p.getVector3fMap().cast<double>());
    tree_.assign(made.view, {Serial{}, isa});
    low_ = high_ = points_.front();
    for (const Place& p : points_)
      low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
    side_ = (high_ - low_).maxCoeff();
  }

  bool right(std::size_t question) {
    const Place place = draw_place();
    const double distance = draw_distance(place);
    switch (question % 7) {
      case 0:
        return nearest(place, distance);
      case 1:
        return k_nearest(place, distance);
      case 2:
        return near(place, distance);
      case 3:
        return tree_.any_inside(Sphere(place, distance)) == !inside(Sphere(place, distance)).empty();
      case 4: {
        const Eigen::Matrix3d axes =
            Eigen::Quaterniond(part() + 0.1, part(), part(), part()).normalized().toRotationMatrix();
        const Obb box(place, axes, Place(distance, 0.5 * distance, 0.1 * distance));
        return tree_.count_inside(box) == inside(box).size();
      }
      case 5: {
        const Capsule capsule(place, draw_place(), 0.2 * distance);
        tree_.all_inside(capsule, indices_);
        return indices_ == inside(capsule);
      }
      default:
        return first_hit(place, (draw_place() - place).normalized(), 0.1 * distance);
    }
  }

 private:
  double part() { return std::uniform_real_distribution<double>()(random_); }

  // In the box or somewhat beside it.
  Place draw_place() {
    Place place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = low_[axis] + (1.2 * part() - 0.1) * (high_[axis] - low_[axis]);
    return place;
  }

  double draw_distance(const Place& place) {
    if (part() < 0.25) {
      const auto i = static_cast<std::size_t>(part() * static_cast<double>(points_.size()));
      return std::sqrt(square(place, i));
    }
    return side_ * std::pow(10, -4 * part());
  }

  double square(const Place& place, std::size_t i) const {
    const double x = points_[i].x() - place.x(), y = points_[i].y() - place.y(),
                 z = points_[i].z() - place.z();
    return (x * x + y * y) + z * z;
  }

  // In the order of the cloud.
  std::vector<Neighbor> within(const Place& place, double distance) const {
    std::vector<Neighbor> found;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double d2 = square(place, i);
      if (d2 <= distance * distance) found.push_back({static_cast<std::int32_t>(i), d2});
    }
    return found;
  }

  template <typename Volume>
  std::vector<std::int32_t> inside(const Volume& volume) const {
    std::vector<std::int32_t> found;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (volume.contains(points_[i])) found.push_back(static_cast<std::int32_t>(i));
    }
    return found;
  }

  bool nearest(const Place& place, double distance) const {
    const std::vector<Neighbor> all = within(place, distance);
    const auto truth = std::min_element(all.begin(), all.end());
    const auto found = tree_.nearest(place, distance);
    return found ? truth != all.end() && same(*found, *truth) : all.empty();
  }

  bool k_nearest(const Place& place, double distance) {
    const auto k = static_cast<std::size_t>(40 * part());
    std::vector<Neighbor> truth = within(place, distance);
    std::sort(truth.begin(), truth.end());
    truth.resize(std::min(k, truth.size()));
    tree_.nearest(place, k, found_, distance);
    return std::equal(truth.begin(), truth.end(), found_.begin(), found_.end(), same);
  }

  bool near(const Place& place, double distance) {
    const std::vector<Neighbor> truth = within(place, distance);
    tree_.near(place, distance, found_);
    std::sort(found_.begin(), found_.end(),
              [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; });
    return std::equal(truth.begin(), truth.end(), found_.begin(), found_.end(), same);
  }

  bool first_hit(const Place& origin, const Place& direction, double radius) const {
    std::int32_t index = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto hit = Sphere(points_[i], radius).intersect(origin, direction);
      if (hit && hit->enter < least) least = hit->enter, index = static_cast<std::int32_t>(i);
    }
    const auto found = tree_.first_hit(origin, direction, radius);
    return found ? found->index == index && found->t == least : index == -1;
  }

  std::mt19937_64 random_;
  std::vector<Place> points_;
  PointTree tree_;
  Place low_, high_;
  double side_ = 0;
  std::vector<Neighbor> found_;
  std::vector<std::int32_t> indices_;
};

}  // namespace

TreeTruth count_wrong_answers(Isa isa, std::size_t questions) {
  TreeTruth truth;
  const std::vector<std::string> scenes = {"gauss", "cube", "ball", "car", "golfball", "surface", "street"};
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    Asked asked(scenes[s], isa, 11 + s);
    const std::size_t until = questions * (s + 1) / scenes.size();
    for (; truth.questions < until; ++truth.questions)
      truth.wrong += !asked.right(truth.questions);
  }
  return truth;
}

}  // namespace pcl_bv::bench
