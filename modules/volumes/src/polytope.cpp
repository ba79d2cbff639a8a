// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The intersection of the three basis slabs is a parallelepiped. It is mapped to the unit cube, which is then
// clipped by the other slabs. In the unit cube, all numbers are well scaled, however long, thin or far from
// the origin the k-DOP is.
#include "polytope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bounds.h"
#include "clipped_cube.h"
#include "kdop_support.h"
#include "pcl_bv/numeric/constants.h"

namespace pcl_bv::detail {
namespace {

// The map p = corner + edges * y of the unit cube to the parallelepiped of the basis slabs.
struct CubeMap {
  Eigen::Vector3d corner;
  Eigen::Matrix3d edges;
};

CubeMap cube_map(const LocalSlabs& slabs) {
  Eigen::Vector3d low, width;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = slabs.set().basis()[k];
    low[k] = slabs.min(i);
    width[k] = slabs.max(i) - slabs.min(i);
  }
  return {slabs.basis_inverse() * low, slabs.basis_inverse() * width.asDiagonal()};
}

// Returns the volume of the parallelepiped. If products of two of its edges overflow or underflow, the edges
// are first divided by their lengths.
double volume_of(const CubeMap& map) {
  const double volume = std::abs(map.edges.determinant());
  if (volume > 0x1p-400 && volume < 0x1p400) return volume;
  Eigen::Vector3d lengths;
  Eigen::Matrix3d units;
  for (int k = 0; k < 3; ++k) {
    units.col(k) = unit_vector(map.edges.col(k));
    lengths[k] = map.edges.col(k).stableNorm();
  }
  return product_of(lengths[0] * std::abs(units.determinant()), lengths[1], lengths[2]);
}

struct MappedSlab {
  Eigen::Vector3d normal;
  double min, max;
  double rounding;  // error bound of min and max; large if an extent is near a last-place unit of coordinates

  double width() const { return (max - min) / normal.cwiseAbs().maxCoeff(); }
};

// Returns the slabs that clip the unit cube, in the coordinates of the cube. Two kinds of slabs are left out:
// the basis slabs, which define the cube, and slabs in whose direction the parallelepiped has no extent.
std::vector<MappedSlab> mapped_slabs(const LocalSlabs& slabs, const CubeMap& map) {
  std::vector<MappedSlab> result;
  for (std::size_t i = 0; i < slabs.set().size(); ++i) {
    const auto& basis = slabs.set().basis();
    if (std::find(basis.begin(), basis.end(), i) != basis.end()) continue;
    const Eigen::Vector3d& n = slabs.set().direction(i);
    const double shift = n.dot(map.corner);
    const double magnitude =
        n.cwiseAbs().dot(map.corner.cwiseAbs()) + std::abs(slabs.min(i)) + std::abs(slabs.max(i));
    const Eigen::Vector3d normal = map.edges.transpose() * n;
    if (normal.isZero(0)) continue;
    result.push_back({normal, slabs.min(i) - shift, slabs.max(i) - shift, 0x1p-48 * magnitude});
  }
  // Thin slabs clip first. If the polytope collapses onto the cap of a thin slab, the cap is then still one
  // whole face.
  std::stable_sort(result.begin(), result.end(),
                   [](const MappedSlab& a, const MappedSlab& b) { return a.width() < b.width(); });
  return result;
}

ClippedCube clipped(const LocalSlabs& slabs, const CubeMap& map) {
  ClippedCube cube;
  for (int k = 0; k < 3; ++k) {
    if (map.edges.col(k).isZero(0)) cube.cut(Eigen::Vector3d::Unit(k), 0);
  }
  for (const MappedSlab& slab : mapped_slabs(slabs, map)) {
    cube.cut(slab.normal, slab.max, slab.rounding);
    cube.cut(-slab.normal, -slab.min, slab.rounding);
  }
  return cube;
}

// Copies the faces and their vertices. The vertices are renumbered in the order of their first use by a face.
void compact(const ClippedCube& cube, std::vector<Eigen::Vector3d>& vertices, std::vector<Face>& faces) {
  std::vector<std::int32_t> number(cube.vertices().size(), -1);
  for (const Face& loop : cube.loops()) {
    Face face;
    for (const std::int32_t v : loop) {
      std::int32_t& n = number[v];
      if (n < 0) {
        n = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(cube.vertices()[v]);
      }
      face.push_back(n);
    }
    if (face.size() > 1) faces.push_back(std::move(face));
  }
}

double distance_to_edge(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d edge = b - a;
  const Eigen::Vector3d unit = edge.stableNormalized();  // zero for an edge of length 0
  const double along = std::clamp(unit.dot(p - a), 0.0, edge.stableNorm());
  return (p - a - along * unit).stableNorm();
}

// Returns the outward normal of a face. Its length is twice the area of the face.
Eigen::Vector3d twice_area(const Polytope& polytope, const Face& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& a = polytope.vertices[face[0]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    sum += (polytope.vertices[face[i]] - a).cross(polytope.vertices[face[i + 1]] - a);
  }
  return sum;
}

double distance_to_face(const Polytope& polytope, const Face& face, const Eigen::Vector3d& p) {
  const Eigen::Vector3d normal = twice_area(polytope, face).stableNormalized();
  bool over_face = !normal.isZero(0);
  double nearest = kInfinity;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Eigen::Vector3d& a = polytope.vertices[face[i]];
    const Eigen::Vector3d& b = polytope.vertices[face[(i + 1) % face.size()]];
    nearest = std::min(nearest, distance_to_edge(p, a, b));
    over_face = over_face && normal.dot((b - a).cross(p - a)) >= 0;
  }
  if (!over_face) return nearest;
  return std::min(nearest, std::abs(normal.dot(p - polytope.vertices[face[0]])));
}

}  // namespace

Eigen::Vector3d Measure::centroid(const std::vector<Eigen::Vector3d>& vertices) const {
  if (size > 0) return moment / size;
  return std::accumulate(vertices.begin(), vertices.end(), Eigen::Vector3d::Zero().eval()) /
         static_cast<double>(vertices.size());
}

Measure measure(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Face>& faces, int rank) {
  Measure result;
  const Eigen::Vector3d& apex = vertices.front();
  for (const Face& face : faces) {
    const Eigen::Vector3d& a = vertices[face[0]];
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const Eigen::Vector3d &b = vertices[face[i]], &c = vertices[face[i + 1]];
      const Eigen::Vector3d area = (b - a).cross(c - a);
      if (rank == 3) {
        result.add(area.dot(a - apex) / 6, (a + b + c + apex) / 4);
      } else {
        result.add(area.stableNorm() / 2, (a + b + c) / 3);
      }
    }
  }
  return result;
}

Polytope intersect_slabs(const Kdop& kdop) {
  const LocalSlabs slabs(kdop);
  const CubeMap map = cube_map(slabs);
  const ClippedCube cube = clipped(slabs, map);
  Polytope result;
  result.origin = slabs.origin();
  compact(cube, result.vertices, result.faces);
  if (result.vertices.empty()) return result;

  // Affine maps preserve centroids, so the centroid is computed in the cube, where all numbers are well
  // scaled.
  const Measure m = measure(result.vertices, result.faces, cube.rank());
  result.centroid = map.corner + map.edges * m.centroid(result.vertices);
  if (cube.rank() == 3) result.volume = std::max(0.0, m.size) * volume_of(map);
  if (slabs.basis_inverse().determinant() < 0) {  // a left-handed basis mirrors the cube
    for (Face& face : result.faces)
      std::reverse(face.begin(), face.end());
  }
  for (Eigen::Vector3d& v : result.vertices)
    v = map.corner + map.edges * v;
  return result;
}

double surface_area(const Polytope& polytope) {
  double twice = 0;
  for (const Face& face : polytope.faces)
    twice += twice_area(polytope, face).stableNorm();
  return twice / 2;
}

// In units of the largest coordinate, so that the normals of small faces do not underflow.
double distance(const Polytope& polytope, const Eigen::Vector3d& point) {
  Polytope scaled = polytope;
  scaled.vertices.push_back(point);
  const double unit = power_of_two_near(scaled.vertices);
  for (Eigen::Vector3d& v : scaled.vertices)
    v /= unit;
  const Eigen::Vector3d p = scaled.vertices.back();
  double nearest = kInfinity;
  for (const Face& face : scaled.faces)
    nearest = std::min(nearest, distance_to_face(scaled, face, p));
  if (polytope.vertices.size() == 1) nearest = (p - scaled.vertices.front()).stableNorm();
  return nearest * unit;
}

double power_of_two_near(const std::vector<Eigen::Vector3d>& vertices) {
  double largest = 0;
  for (const Eigen::Vector3d& v : vertices)
    largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return largest > 0 ? std::ldexp(1.0, std::max(std::ilogb(largest), -1000)) : 1.0;
}

}  // namespace pcl_bv::detail
