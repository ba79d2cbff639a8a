// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The definition of the rank needs several passes over all points. If a few points clearly span a solid,
// these passes are skipped.

#include "point_rank.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "local_frame.h"
#include "map_chunks.h"
#include "orthogonal_basis.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/points/point_source.h"
#include "schedule.h"

namespace pcl_bv::detail {
namespace {

// Returns a limit for V, six times the volume of a tetrahedron. If V is above the limit, the tetrahedron
// clearly spans a solid: every slab around it is thicker than V / (3 extent^2), because 3 extent^2 is the
// largest possible product of the lengths of two edges. This thickness is more than 2^-32 of the extent. A
// cloud of rank 2 is in a slab with a thickness of 2^-35 of the extent.
double clear_volume(double extent) {
  return 0x1p-30 * extent * extent * extent;
}

// Returns whether four points, evenly spaced in the view, clearly span a solid. This is true for nearly all
// clouds. The check takes 20 ns, a small part of the 220 ns for fitting the box of 300 points.
bool four_points_span_solid(const PointView& points, double extent) {
  const std::size_t step = points.count / 4;
  const Coordinates p = load_point(points, 0), a = load_point(points, step), b = load_point(points, 2 * step),
                    c = load_point(points, 3 * step);
  if (!is_valid(p) || !is_valid(a) || !is_valid(b) || !is_valid(c)) return false;
  const Eigen::Vector3d normal = cross3(vector(a) - vector(p), vector(b) - vector(p));
  return std::abs(dot3(normal, vector(c) - vector(p))) > clear_volume(extent);
}

// A simplex that grows point by point. A point is added, and increases the rank, if its distance from the
// point, line or plane of the earlier points is above a limit. The limits prove the rank. For example, no
// strip thinner than 2^-19 of the extent contains the triangle of the first three points, and a cloud of rank
// 1 is in a strip with a width of 2^-35 of the extent.
class Simplex {
 public:
  explicit Simplex(double extent)
      : limit_{0x1p-8 * extent, 0x1p-18 * extent * extent, clear_volume(extent)} {}

  int rank() const { return rank_; }

  void add(const Coordinates& p) {
    const Eigen::Vector3d q = vector(p) - origin_;
    if (rank_ < 0) {
      origin_ = vector(p);
      rank_ = 0;
    } else if (rank_ == 0 && q.cwiseAbs().maxCoeff() > limit_[0]) {
      edge_ = q;
      rank_ = 1;
    } else if (rank_ == 1 && cross3(edge_, q).cwiseAbs().maxCoeff() > limit_[1]) {
      normal_ = cross3(edge_, q);
      rank_ = 2;
    } else if (rank_ == 2 && std::abs(dot3(normal_, q)) > limit_[2]) {
      rank_ = 3;
    }
  }

 private:
  double limit_[3];
  int rank_ = -1;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), edge_ = origin_, normal_ = origin_;
};

// Returns whether a few points prove that the rank of the cloud is at least `dimensions`. Tries four evenly
// spaced points of each chunk and all points of the first chunk, and stops as soon as these points prove it.
bool clearly_spans(const PointView& points, double extent, int dimensions) {
  if (dimensions == 3 && points.source == nullptr && four_points_span_solid(points, extent)) return true;
  Simplex simplex(extent);
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    const PointView& view = loaded.view();
    const auto add_every = [&](std::size_t step) {
      for (std::size_t i = 0; i < view.count && simplex.rank() < dimensions; i += step) {
        const Coordinates p = load_point(view, i);
        if (is_valid(p)) simplex.add(p);
      }
    };
    add_every(std::max<std::size_t>(view.count / 4, 1));
    if (chunk == 0) add_every(1);
    if (simplex.rank() >= dimensions) return true;
  }
  return false;
}

struct Outermost {
  double squared_distance = -1;
  Coordinates point{};
};

void update_outermost(const Outermost& other, Outermost& best) {
  if (other.squared_distance < best.squared_distance) return;
  const auto key = [](const Coordinates& p) { return std::tie(p.x, p.y, p.z); };
  const bool first = key(other.point) < key(best.point);
  if (other.squared_distance > best.squared_distance || first) best = other;
}

template <typename Measure>
Outermost farthest(const PointView& points, const FitExecution& execution, const Measure& squared_distance) {
  Outermost best;
  map_chunks<Outermost>(
      points, worthwhile(execution, Work::rank, points.count),
      [&](const PointView& chunk) {
        Outermost found;
        for (std::size_t i = 0; i < chunk.count; ++i) {
          const Coordinates p = load_point(chunk, i);
          if (is_valid(p)) update_outermost({squared_distance(p), p}, found);
        }
        return found;
      },
      [&](const Outermost& found) { update_outermost(found, best); });
  return best;
}

// Sets the axes of the dimensions that the points do not span.
void complete_axes(Span& span) {
  const Eigen::Vector3d first = span.axes.col(0);
  if (span.rank == 1) span.axes.col(1) = PlaneBasis(first).u;
  span.axes.col(2) = unit3(cross3(first, span.axes.col(1)));
}

}  // namespace

Span span_of(const PointView& points, double scale, const FitExecution& execution) {
  Span span;
  // All distances are 0 here, so that the tie rule selects the first point in lexicographic order.
  const Coordinates start = farthest(points, execution, [](const Coordinates&) { return 0.0; }).point;
  const auto across = [&](const Coordinates& p) {
    Eigen::Vector3d q = (vector(p) - vector(start)) * scale;
    for (int k = 0; k < span.rank; ++k)
      q -= dot3(span.axes.col(k), q) * span.axes.col(k);
    return q;
  };
  for (; span.rank < 3; ++span.rank) {
    const Outermost found = farthest(points, execution, [&](const Coordinates& p) {
      const Eigen::Vector3d q = across(p);
      return dot3(q, q);
    });
    const double distance = std::sqrt(found.squared_distance);
    if (!(distance > kFlat)) break;
    Eigen::Vector3d q = across(found.point);
    // Orthogonalise once more, because a removed component may have been thousands of times longer than q and
    // its rounding error is still in q.
    for (int k = 0; k < span.rank; ++k)
      q -= dot3(span.axes.col(k), q) * span.axes.col(k);
    span.axes.col(span.rank) = unit3(q);
    span.distances[span.rank] = distance;
  }
  complete_axes(span);
  return span;
}

int point_rank(const PointView& points, const Supports& supports, const FitExecution& execution) {
  int sides = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sides += supports.used > 0 && supports.along[axis].low < supports.along[axis].high ? 1 : 0;
  if (sides == 0) return 0;
  const double extent = widest_side(supports);
  // For smaller extents, products of three lengths could underflow.
  if (extent > 0x1p-300 && clearly_spans(points, extent, sides)) return sides;
  return span_of(points, unit_scale(extent), execution).rank;
}

}  // namespace pcl_bv::detail
