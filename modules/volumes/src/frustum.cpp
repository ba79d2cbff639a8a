// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/hull.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bounds.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "shape.h"

namespace pcl_bv {

using namespace detail;

namespace {

void require(bool holds, const char* name, double value, const char* range) {
  if (holds) return;
  std::ostringstream text;
  text << "frustum: " << name << " is " << value << ", must be " << range;
  throw std::invalid_argument(text.str());
}

Eigen::Vector3d rotated(const Eigen::Isometry3d& pose, const Eigen::Vector3d& v) {
  const Eigen::Matrix3d m = pose.linear();
  return {dot3(m.row(0), v), dot3(m.row(1), v), dot3(m.row(2), v)};
}

HullPlane plane_around(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d normal = (direction / length3(direction)).array() + 0.0;
  double offset = -kInfinity;
  for (const Eigen::Vector3d& v : vertices)
    offset = std::max(offset, Expansion().add_dot(normal, v).up());
  return {normal, offset};
}

}  // namespace

Hull frustum(const Eigen::Isometry3d& pose, double near, double far, double horizontal_tan,
             double vertical_tan) {
  const FloatEnvironment environment;
  require(near >= 0 && near < far, "near", near, "at least 0 and below far");
  require(far <= 1e100, "far", far, "at most 1e100");
  require(horizontal_tan > 0 && horizontal_tan <= 1e6, "horizontal_tan", horizontal_tan,
          "above 0 and at most 1e6");
  require(vertical_tan > 0 && vertical_tan <= 1e6, "vertical_tan", vertical_tan, "above 0 and at most 1e6");
  const Eigen::Matrix3d axes = pose.linear();
  const double off = orthonormality_error(axes);
  require(off <= 1e-6, "deviation of the pose's axes from unit and orthogonal", off, "at most 1e-6");
  const double handed = dot3(cross3(Eigen::Vector3d(axes.col(0)), Eigen::Vector3d(axes.col(1))), axes.col(2));
  require(handed > 0, "determinant of the pose", handed, "above 0 (right-handed axes)");
  for (int k = 0; k < 3; ++k)
    require(std::abs(pose(k, 3)) <= 1e100, "coordinate of the pose", pose(k, 3), "from -1e100 to 1e100");

  std::vector<Eigen::Vector3d> vertices;
  for (unsigned i = 0; i < 8; ++i) {
    const double z = i & 4 ? far : near;
    const double x = (i & 1 ? z : -z) * horizontal_tan, y = (i & 2 ? z : -z) * vertical_tan;
    vertices.push_back(pose.translation() + rotated(pose, {x, y, z}));
  }
  std::vector<HullPlane> planes;
  for (const Eigen::Vector3d& n :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, -horizontal_tan),
        Eigen::Vector3d(-1, 0, -horizontal_tan), Eigen::Vector3d(0, 1, -vertical_tan),
        Eigen::Vector3d(0, -1, -vertical_tan)}) {
    planes.push_back(plane_around(vertices, rotated(pose, n)));
  }
  // Two triangles for each plane, counter-clockwise seen from outside.
  std::vector<Hull::Triangle> triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {1, 3, 7}, {1, 7, 5},
                                        {0, 4, 6}, {0, 6, 2}, {2, 6, 7}, {2, 7, 3}, {0, 1, 5}, {0, 5, 4}};
  return {std::move(vertices), std::move(triangles), std::move(planes), 3};
}

}  // namespace pcl_bv
