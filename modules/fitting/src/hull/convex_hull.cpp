// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hull/convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "hull/planar_hull.h"
#include "local_frame.h"

namespace pcl_bv {
namespace {

struct Facet {
  Triangle corners;
  Triangle beside;                  // the facets behind the edges from corner k to corner k + 1
  std::vector<std::int32_t> above;  // points that see it and wait to be added
  std::int32_t visited = -1;        // the last point that asked whether it sees it
  bool removed = false;
};

// Grows a tetrahedron by the points outside, farthest first. A facet is seen by what is strictly above its
// plane; so the facets that a point sees are connected, those in its own plane stay, and a point that sees
// none of the new facets is inside (Barber, Dobkin, Huhdanpaa 1996, which holds for exact predicates as is).
class Quickhull {
 public:
  explicit Quickhull(const std::vector<Coordinates>& points) : points_(points) {}

  /// False if all points are in a plane; `corners` are then as many of them as span what they span.
  bool run(std::vector<std::size_t>& corners) {
    if (!find_corners(corners)) return false;
    add_tetrahedron(corners);
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (!facets_[f].removed && !facets_[f].above.empty()) add_farthest(static_cast<std::int32_t>(f));
    }
    return true;
  }

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> found;
    for (const Facet& facet : facets_) {
      if (!facet.removed) found.push_back(facet.corners);
    }
    return found;
  }

  /// For each facet that is left, by its number in triangles(), a number that facets in one plane share.
  std::vector<std::size_t> faces() const {
    std::vector<std::size_t> face(facets_.size());
    std::iota(face.begin(), face.end(), std::size_t{0});
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (facets_[f].removed || face[f] != f) continue;
      std::vector<std::size_t> stack{f};
      while (!stack.empty()) {
        const Facet& facet = facets_[stack.back()];
        stack.pop_back();
        for (const std::int32_t beside : facet.beside) {
          const auto g = static_cast<std::size_t>(beside);
          if (face[g] == f || !in_plane(facet, facets_[g])) continue;
          face[g] = f;
          stack.push_back(g);
        }
      }
    }
    std::vector<std::size_t> left;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (!facets_[f].removed) left.push_back(face[f]);
    }
    return left;
  }

 private:
  const Coordinates& at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }

  bool sees(std::int32_t point, const Facet& facet) const {
    return side_of_plane(at(facet.corners[0]), at(facet.corners[1]), at(facet.corners[2]), at(point)) > 0;
  }

  bool in_plane(const Facet& facet, const Facet& other) const {
    const auto& [a, b, c] = facet.corners;
    return std::all_of(other.corners.begin(), other.corners.end(), [&, a = a, b = b, c = c](std::int32_t i) {
      return i == a || i == b || i == c || side_of_plane(at(a), at(b), at(c), at(i)) == 0;
    });
  }

  bool in_line(std::size_t a, std::size_t b, std::size_t c) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto flat = [&](std::size_t i) {
        return Eigen::Vector2d(points_[i][k], points_[i][(k + 1) % 3]);
      };
      if (turn(flat(a), flat(b), flat(c)) != 0) return false;
    }
    return true;
  }

  // The first point with the greatest measure; if that one is not good, the first one that is.
  template <typename Measure, typename Good>
  bool find(const Measure& measure, const Good& good, std::vector<std::size_t>& corners) const {
    std::size_t best = 0;
    double greatest = -1;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double measured = measure(vector(points_[i]));
      if (!(measured > greatest)) continue;
      greatest = measured;
      best = i;
    }
    for (std::size_t i = 0; !good(best) && i < points_.size(); ++i)
      best = i;
    if (!good(best)) return false;
    corners.push_back(best);
    return true;
  }

  bool find_corners(std::vector<std::size_t>& corners) const {
    corners = {0};
    const Eigen::Vector3d a = vector(points_[0]);
    const auto distance = [&](const Eigen::Vector3d& p) { return (p - a).cwiseAbs().maxCoeff(); };
    if (!find(
            distance, [&](std::size_t i) { return !(points_[i] == points_[0]); }, corners))
      return false;
    const Eigen::Vector3d ab = vector(points_[corners[1]]) - a;
    const auto across = [&](const Eigen::Vector3d& p) { return ab.cross(p - a).cwiseAbs().maxCoeff(); };
    if (!find(
            across, [&](std::size_t i) { return !in_line(0, corners[1], i); }, corners))
      return false;
    const Eigen::Vector3d normal = ab.cross(vector(points_[corners[2]]) - a);
    const auto height = [&](const Eigen::Vector3d& p) { return std::abs(normal.dot(p - a)); };
    const auto off = [&](std::size_t i) {
      return side_of_plane(points_[0], points_[corners[1]], points_[corners[2]], points_[i]) != 0;
    };
    return find(height, off, corners);
  }

  void add_tetrahedron(const std::vector<std::size_t>& corners) {
    std::array<std::int32_t, 4> c;
    std::copy(corners.begin(), corners.end(), c.begin());
    // The fourth is below the first three.
    if (side_of_plane(at(c[0]), at(c[1]), at(c[2]), at(c[3])) > 0) std::swap(c[1], c[2]);
    facets_ = {{{c[0], c[1], c[2]}, {1, 2, 3}, {}},
               {{c[1], c[0], c[3]}, {0, 3, 2}, {}},
               {{c[2], c[1], c[3]}, {0, 1, 3}, {}},
               {{c[0], c[2], c[3]}, {0, 2, 1}, {}}};
    std::vector<std::int32_t> all(points_.size());
    std::iota(all.begin(), all.end(), 0);
    hand_out(all, 0);
  }

  // Each point to the first facet from `first` on that it sees; those that see none are inside.
  void hand_out(const std::vector<std::int32_t>& points, std::size_t first) {
    for (const std::int32_t point : points) {
      const auto seen = std::find_if(facets_.begin() + static_cast<std::ptrdiff_t>(first), facets_.end(),
                                     [&](const Facet& facet) { return sees(point, facet); });
      if (seen != facets_.end()) seen->above.push_back(point);
    }
  }

  // Of equally far ones the first, which of equal points is the one that counts.
  std::int32_t farthest(const Facet& facet) const {
    const Eigen::Vector3d a = vector(at(facet.corners[0]));
    const Eigen::Vector3d normal = (vector(at(facet.corners[1])) - a).cross(vector(at(facet.corners[2])) - a);
    const auto height = [&](std::int32_t i) { return normal.dot(vector(at(i)) - a); };
    std::int32_t best = facet.above.front();
    double greatest = height(best);
    for (const std::int32_t i : facet.above) {
      const double h = height(i);
      if (h > greatest || (h == greatest && i < best)) {
        greatest = h;
        best = i;
      }
    }
    return best;
  }

  struct Edge {
    std::int32_t from, to;
    std::int32_t kept;  // the facet on the other side, which stays
  };

  // Removes the facets that the point sees, from one of them on, and gives the way around them.
  std::vector<Edge> remove_seen(std::int32_t point, std::int32_t start, std::vector<std::int32_t>& waiting) {
    std::vector<Edge> around;
    std::vector<std::int32_t> stack{start};
    const auto facet = [&](std::int32_t f) -> Facet& { return facets_[static_cast<std::size_t>(f)]; };
    facet(start).removed = true;
    while (!stack.empty()) {
      Facet& seen = facet(stack.back());
      stack.pop_back();
      waiting.insert(waiting.end(), seen.above.begin(), seen.above.end());
      std::vector<std::int32_t>().swap(seen.above);
      for (std::size_t k = 0; k < 3; ++k) {
        Facet& other = facet(seen.beside[k]);
        if (other.removed) continue;
        if (other.visited != point && sees(point, other)) {
          other.removed = true;
          stack.push_back(seen.beside[k]);
          continue;
        }
        other.visited = point;  // asked once
        around.push_back({seen.corners[k], seen.corners[(k + 1) % 3], seen.beside[k]});
      }
    }
    return around;
  }

  void add_farthest(std::int32_t start) {
    const std::int32_t point = farthest(facets_[static_cast<std::size_t>(start)]);
    std::vector<std::int32_t> waiting;
    const std::vector<Edge> around = remove_seen(point, start, waiting);
    const std::size_t first = facets_.size();
    beginning_.resize(points_.size());
    for (std::size_t i = 0; i < around.size(); ++i)
      beginning_[static_cast<std::size_t>(around[i].from)] = static_cast<std::int32_t>(first + i);
    for (const Edge& edge : around) {
      const auto number = static_cast<std::int32_t>(facets_.size());
      facets_.push_back({{edge.from, edge.to, point}, {edge.kept, -1, -1}, {}});
      Facet& kept = facets_[static_cast<std::size_t>(edge.kept)];
      for (std::size_t k = 0; k < 3; ++k)
        if (kept.corners[k] == edge.to) kept.beside[k] = number;
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      const std::int32_t next = beginning_[static_cast<std::size_t>(around[i].to)];
      facets_[first + i].beside[1] = next;
      facets_[static_cast<std::size_t>(next)].beside[2] = static_cast<std::int32_t>(first + i);
    }
    hand_out(waiting, first);
  }

  const std::vector<Coordinates>& points_;
  std::vector<Facet> facets_;
  std::vector<std::int32_t> beginning_;  // by corner, the new facet whose edge begins there
};

// Positions of the corners that are in three planes or more: the others are inside a face or an edge.
std::vector<std::size_t> extreme_corners(const std::vector<Triangle>& triangles,
                                         const std::vector<std::size_t>& faces) {
  std::vector<std::pair<std::size_t, std::size_t>> planes;  // of each corner
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::int32_t corner : triangles[t])
      planes.emplace_back(static_cast<std::size_t>(corner), faces[t]);
  }
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  std::vector<std::size_t> extreme;
  for (std::size_t i = 2; i < planes.size(); ++i) {
    const std::size_t corner = planes[i].first;
    if (planes[i - 2].first == corner && (extreme.empty() || extreme.back() != corner))
      extreme.push_back(corner);
  }
  return extreme;
}

// In a plane, or less. Along the axis that the plane is most across, which leaves every order as it is.
std::vector<std::size_t> extreme_in_plane(const std::vector<Coordinates>& points,
                                          const std::vector<std::size_t>& corners) {
  if (corners.size() < 2) return corners;
  const auto at = [&](std::size_t i) { return vector(points[corners[i]]); };
  std::size_t dropped = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto flat = [&](std::size_t i) { return Eigen::Vector2d(at(i)[(k + 1) % 3], at(i)[(k + 2) % 3]); };
    const bool spans = corners.size() < 3 ? flat(0) != flat(1) : turn(flat(0), flat(1), flat(2)) != 0;
    if (spans) dropped = k;
  }
  std::vector<Eigen::Vector2d> flat;
  for (const Coordinates& p : points)
    flat.emplace_back(p[(dropped + 1) % 3], p[(dropped + 2) % 3]);
  std::vector<std::size_t> extreme = planar_hull(flat);
  std::sort(extreme.begin(), extreme.end());
  return extreme;
}

void begin_with_smallest(std::vector<Triangle>& triangles) {
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
}

}  // namespace

ConvexHull convex_hull(const std::vector<Coordinates>& points) {
  ConvexHull hull;
  if (points.empty()) return hull;
  std::vector<std::size_t> corners;
  Quickhull quickhull(points);
  if (!quickhull.run(corners)) {
    hull.vertices = extreme_in_plane(points, corners);
    return hull;
  }
  hull.triangles = quickhull.triangles();
  const std::vector<std::size_t> faces = quickhull.faces();
  hull.vertices = extreme_corners(hull.triangles, faces);
  std::vector<std::size_t> distinct = faces;
  std::sort(distinct.begin(), distinct.end());
  const bool cut = std::adjacent_find(distinct.begin(), distinct.end()) != distinct.end();
  // How faces are cut depends on what was added before; of the vertices alone it does not.
  if (cut && hull.vertices.size() < points.size()) {
    std::vector<Coordinates> extreme;
    for (const std::size_t i : hull.vertices)
      extreme.push_back(points[i]);
    hull.triangles = convex_hull(extreme).triangles;
    return hull;
  }
  std::vector<std::int32_t> number(points.size());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i)
    number[hull.vertices[i]] = static_cast<std::int32_t>(i);
  for (Triangle& t : hull.triangles) {
    for (std::int32_t& corner : t)
      corner = number[static_cast<std::size_t>(corner)];
  }
  begin_with_smallest(hull.triangles);
  return hull;
}

}  // namespace pcl_bv
