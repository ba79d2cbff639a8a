// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Along an axis a volume's box says how far it reaches. For another direction the volume is turned, so that
// it becomes an axis: transformed() holds the image by exact arithmetic on the stored matrix, and so does its
// box.

#include "reaches.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"
#include "plane_body.h"

namespace pcl_bv {
namespace {

Eigen::Vector3d cube_vector(std::size_t i) {
  const CubeDirection& d = kCubeDirections[i];
  return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}

// A rotation whose first rows are directions of the cube, made shorter; from row 1 on maybe others.
struct Turn {
  Eigen::Isometry3d rotation = Eigen::Isometry3d::Identity();
  std::vector<std::size_t> directions;

  Turn(const Eigen::Vector3d& a, const Eigen::Vector3d& b, std::vector<std::size_t> to)
      : directions(std::move(to)) {
    rotation.linear().row(0) = unit3(a).transpose();
    rotation.linear().row(1) = unit3(b).transpose();
    rotation.linear().row(2) = unit3(cross3(a, b)).transpose();
  }
};

// One for each of the directions through the corners, then one for each two through the edges.
const std::vector<Turn>& turns() {
  static const std::vector<Turn> made = [] {
    std::vector<Turn> all;
    for (std::size_t i = 3; i < 7; ++i)
      all.emplace_back(cube_vector(i), cross3(cube_vector(i), Eigen::Vector3d(Eigen::Vector3d::UnitX())),
                       std::vector{i});
    for (std::size_t i = 7; i < 13; i += 2)
      all.emplace_back(cube_vector(i), cube_vector(i + 1), std::vector{i, i + 1});
    return all;
  }();
  return made;
}

// Of n . p, if n' . p is at most `reach` for an n' that is nearly parallel, and |p[k]| at most size[k].
double reach_along(const Eigen::Vector3d& n, const Eigen::Vector3d& row, double reach,
                   const Eigen::Vector3d& size) {
  const double weight = dot3(n, row) / dot3(row, row);
  Expansion bound;
  bound.add_product(weight, reach);
  for (int k = 0; k < 3; ++k) {
    const double rest = Expansion().add(n[k]).add_product(-weight, row[k]).magnitude_up();
    bound.add(multiply_up(rest, size[k]));
  }
  return bound.up();
}

void add_turned(const AnyVolume& volume, const Aabb& box, std::size_t count, Reaches& found) {
  const Eigen::Vector3d size = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
  for (const Turn& turn : turns()) {
    if (turn.directions.front() >= count) continue;
    const Aabb turned = aabb(transformed(volume, turn.rotation));
    for (std::size_t k = 0; k < turn.directions.size(); ++k) {
      const std::size_t i = turn.directions[k];
      const auto axis = static_cast<int>(k);
      const Eigen::Vector3d n = cube_vector(i), row = turn.rotation.linear().row(axis).transpose();
      found.up[i] = reach_along(n, row, turned.max()[axis], size);
      found.down[i] = reach_along(n, row, -turned.min()[axis], size);
    }
  }
}

void add_axes(const Aabb& box, Reaches& found) {
  for (std::size_t k = 0; k < 3; ++k) {
    found.up[k] = box.max()[static_cast<int>(k)];
    found.down[k] = -box.min()[static_cast<int>(k)];
  }
}

struct Measure {
  std::size_t count;

  Reaches operator()(const Aabb& box) const {
    Reaches found;
    add_axes(box, found);
    for (std::size_t i = 3; i < count; ++i) {
      const Eigen::Vector3d n = cube_vector(i);
      found.up[i] = Expansion().add_dot(n, box.support(n)).up();
      found.down[i] = Expansion().add_dot(-n, box.support(-n)).up();
    }
    return found;
  }

  Reaches operator()(const Kdop& kdop) const {
    const PlaneBody body(kdop);
    Reaches found = of_planes(body);
    add_axes(kdop.aabb(), found);
    for (std::size_t i = 3; i < count; ++i) {
      for (std::size_t slab = 0; slab < kdop.size(); ++slab) {
        if (kdop.set()->direction(slab) != cube_vector(i)) continue;
        found.up[i] = kdop.max(slab);
        found.down[i] = -kdop.min(slab);
      }
    }
    return found;
  }

  Reaches operator()(const Hull& hull) const { return of_planes(PlaneBody(hull)); }

  template <typename Shape>
  Reaches operator()(const Shape& shape) const {
    Reaches found;
    const Aabb box = shape.aabb();
    add_axes(box, found);
    add_turned(shape, box, count, found);
    return found;
  }

  Reaches of_planes(const PlaneBody& body) const {
    Reaches found;
    for (std::size_t i = 0; i < count; ++i) {
      found.up[i] = body.reach_up(cube_vector(i));
      found.down[i] = body.reach_up(-cube_vector(i));
    }
    return found;
  }
};

}  // namespace

Reaches reaches(const AnyVolume& volume, std::size_t count) {
  return std::visit(Measure{count}, volume);
}

}  // namespace pcl_bv
