// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A smallest box has two adjacent sides that each contain an edge of the hull (O'Rourke 1985). Take a pair of
// edges. The normal n1 of one side moves along the arc of its edge, as n1 = (1 - t) a + t b. The normal n2 of
// the other side is perpendicular to n1 and to the other edge. Therefore n2 is linear in t, too, and
// n3 = n1 x n2 is quadratic.
//
// Take any six vertices, two for each normal, and let d1, d2, d3 be the vectors from the vertex on the low
// side to the vertex on the high side. The volume over these six vertices is (d1.n1)(d2.n2)(d3.n3) /
// (|n1|^2 |n2|^2). The volume of the box around the hull is the maximum of this expression over all choices
// of vertices. If for one choice the quartic (d1.n1)(d2.n2)(d3.n3) - v |n1|^2 |n2|^2 is not negative on a
// range of t, then no box in this range is smaller than v. A range without such a proof is divided where the
// support vertices change.

#include "box/flush_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "box/bernstein.h"
#include "box/gauss_arcs.h"
#include "box/support_graph.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/obb.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

// The normals of two adjacent sides at both ends of a range of t, and the arc of each normal.
struct NormalRange {
  std::array<Vector3d, 2> first, second;
  const GaussArcs::Arc *one, *other;

  Vector3d first_at(double t) const { return first[0] + t * (first[1] - first[0]); }
  Vector3d second_at(double t) const { return second[0] + t * (second[1] - second[0]); }
  NormalRange part(double from, double to) const {
    return {{first_at(from), first_at(to)}, {second_at(from), second_at(to)}, one, other};
  }
};

// The vectors from the vertex on the low side to the vertex on the high side, for each direction of a box.
struct Widths {
  Vector3d first, second, third;
};

// Indices of the vertices on the low and the high side of each direction.
using SupportVertices = std::array<std::int32_t, 6>;

// A box over six vertices. If these are the support vertices, the box encloses the whole hull.
struct Measured {
  Widths widths;
  SupportVertices supports;
  double volume;
};

Linear along(const Vector3d& d, const std::array<Vector3d, 2>& n) {
  return {dot3(d, n[0]), dot3(d, n[1])};
}

Quadratic square(const std::array<Vector3d, 2>& n) {
  return {dot3(n[0], n[0]), dot3(n[0], n[1]), dot3(n[1], n[1])};
}

std::array<Vector3d, 3> third(const NormalRange& s) {
  return {cross3(s.first[0], s.second[0]),
          0.5 * (cross3(s.first[0], s.second[1]) + cross3(s.first[1], s.second[0])),
          cross3(s.first[1], s.second[1])};
}

class FlushSearch {
 public:
  FlushSearch(const BoxFrame& known, const Silhouette& shape)
      : shape_(shape), vertices_(shape.vertices()), graph_(shape), gauss_(shape, graph_), best_(known) {
    set_limit();
  }

  const BoxFrame& run();

 private:
  void set_limit();
  void search_pair(const GaussArcs::Arc& one, const GaussArcs::Arc& other, const double* from_row,
                   const double* to_row);
  bool may_carry_side(const GaussArcs::Arc& arc) const;
  void search(const NormalRange& range);
  void refine(const NormalRange& range, const Measured& begin, const Measured& end, int depth);
  bool is_proven(const NormalRange& range, const Widths& widths) const;
  Vector3d across(const GaussArcs::Arc& arc) const { return vertices_[arc.vertex] - vertices_[arc.opposite]; }
  Quartic numerator(const NormalRange& range, const Widths& widths) const;
  double change(const NormalRange& range, const Measured& begin, const Measured& end) const;
  Measured over(const Eigen::Matrix3d& axes, const SupportVertices& supports) const;
  Measured measure(const NormalRange& range, double t);
  void accept(const Eigen::Matrix3d& axes);

  const Silhouette& shape_;
  const std::vector<Vector3d>& vertices_;
  SupportGraph graph_;
  GaussArcs gauss_;
  Silhouette::Projection projection_;
  BoxFrame best_;
  double limit_ = 0;
  int divided_ = 0;  // number of ranges divided so far
};

// Sets the volume below which a box is treated as smaller than the best box. The margin is larger than the
// effect of rounding, which changes each width by a few 2^-53 of the hull's size.
void FlushSearch::set_limit() {
  constexpr double kClose = 1e-10, kOfRounding = 1e-14;
  limit_ =
      best_.volume() * (1 - std::max(kClose, kOfRounding * best_.size.maxCoeff() / best_.size.minCoeff()));
}

const BoxFrame& FlushSearch::run() {
  std::vector<GaussArcs::Arc> arcs;
  for (const GaussArcs::Arc& arc : gauss_.arcs)
    if (may_carry_side(arc)) arcs.push_back(arc);
  const std::size_t count = gauss_.nodes.size();
  std::vector<double> dots(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < count; ++k)
      dots[i * count + k] = dot3(gauss_.nodes[i], gauss_.nodes[k]);
  }
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const double* const from = dots.data() + static_cast<std::size_t>(arcs[i].from) * count;
    const double* const to = dots.data() + static_cast<std::size_t>(arcs[i].to) * count;
    for (std::size_t k = i + 1; k < arcs.size(); ++k) {
      if (arcs[i].width * arcs[k].width * gauss_.width >= limit_) continue;
      search_pair(arcs[i], arcs[k], from, to);
    }
  }
  return best_;
}

// Searches the ranges of t in which n2 is on the arc of the other edge. Let f and g be the dot products of n1
// with the two ends of this arc. In these ranges f and g have different signs.
void FlushSearch::search_pair(const GaussArcs::Arc& one, const GaussArcs::Arc& other, const double* from_row,
                              const double* to_row) {
  const Linear f = {from_row[other.from], to_row[other.from]}, g = {from_row[other.to], to_row[other.to]};
  if (std::min({f[0], f[1], g[0], g[1]}) > 0 || std::max({f[0], f[1], g[0], g[1]}) < 0) return;
  std::array<double, 4> at = {0, 1, 1, 1};
  std::size_t cuts = 1;
  for (const Linear& row : {f, g}) {
    if ((row[0] < 0) != (row[1] < 0)) at[cuts++] = std::clamp(row[0] / (row[0] - row[1]), 0.0, 1.0);
  }
  if (cuts == 3 && at[1] > at[2]) std::swap(at[1], at[2]);
  const std::array<Vector3d, 2> arc = {gauss_.nodes[one.from], gauss_.nodes[one.to]};
  for (std::size_t i = 0; i < cuts; ++i) {
    const double begin = at[i], end = at[i + 1], middle = 0.5 * (begin + end);
    const auto on = [](const Linear& row, double t) { return row[0] + t * (row[1] - row[0]); };
    if (!(begin < end) || on(f, middle) * on(g, middle) > 0) continue;
    const double sign = on(g, middle) - on(f, middle) < 0 ? -1 : 1;
    const auto second = [&](double t) -> Vector3d {
      return sign * (on(g, t) * gauss_.nodes[other.from] - on(f, t) * gauss_.nodes[other.to]);
    };
    const auto first = [&](double t) -> Vector3d { return arc[0] + t * (arc[1] - arc[0]); };
    NormalRange range{{first(begin), first(end)}, {second(begin), second(end)}, &one, &other};
    // If n1 is parallel to the other edge, n2 can be anywhere on the arc. The boxes with n2 inside the arc
    // need no search: these boxes are rotations about n1, and the smallest of them has n2 at an end of the
    // arc.
    const double lengths[2] = {range.second[0].squaredNorm(), range.second[1].squaredNorm()};
    if (std::max(lengths[0], lengths[1]) < 1e-24) continue;
    for (std::size_t k = 0; k < 2; ++k)
      if (lengths[k] < 1e-18 * lengths[1 - k]) range.second[k] = range.second[1 - k];
    search(range);
  }
}

// Returns false only if no box smaller than the limit has a side with a normal on this arc. The volume of a
// box is at least the hull's width along the normal times the area of the hull's shadow along the normal.
// This area is at least half the sum of the facets' projected areas with any fixed signs. Such a sum is a
// linear function of the normal.
bool FlushSearch::may_carry_side(const GaussArcs::Arc& arc) const {
  const std::array<Vector3d, 2> n = {gauss_.nodes[arc.from], gauss_.nodes[arc.to]};
  const Vector3d middle = n[0] + n[1];
  Vector3d shadow = Vector3d::Zero();
  for (std::size_t i = 0; i < shape_.facets(); ++i) {
    const Vector3d normal = shape_.normal(i);
    shadow += dot3(normal, middle) > 0 ? normal : -normal;
  }
  const Linear width = along(across(arc), n), area = along(Vector3d(0.25 * shadow), n);
  if (any_negative(width) || any_negative(area)) return true;
  const Quadratic volume = product(width, area), lengths = square(n);
  for (std::size_t i = 0; i < volume.size(); ++i)
    if (!(volume[i] >= limit_ * lengths[i])) return true;
  return false;
}

// First tries vertices for which SupportGraph::climb() is not needed, because these are faster to find.
void FlushSearch::search(const NormalRange& range) {
  const Vector3d n1 = range.first[0] + range.first[1], n2 = range.second[0] + range.second[1],
                 n3 = cross3(n1, n2);
  const SupportGraph::LowHigh supports = graph_.approximate_supports(n3);
  if (is_proven(range, {across(*range.one), across(*range.other),
                        vertices_[supports.high] - vertices_[supports.low]}))
    return;
  if (is_proven(range, measure(range, 0.5).widths)) return;
  const Measured begin = measure(range, 0), end = measure(range, 1);
  refine(range, begin, end, 0);
}

Quartic FlushSearch::numerator(const NormalRange& range, const Widths& widths) const {
  const auto n3 = third(range);
  return product(product(along(widths.first, range.first), along(widths.second, range.second)),
                 Quadratic{dot3(widths.third, n3[0]), dot3(widths.third, n3[1]), dot3(widths.third, n3[2])});
}

bool FlushSearch::is_proven(const NormalRange& range, const Widths& widths) const {
  const Linear w1 = along(widths.first, range.first), w2 = along(widths.second, range.second);
  const auto n3 = third(range);
  const Quadratic w3 = {dot3(widths.third, n3[0]), dot3(widths.third, n3[1]), dot3(widths.third, n3[2])};
  if (any_negative(w1) || any_negative(w2) || any_negative(w3)) return false;
  const Quartic volume = product(product(w1, w2), w3);
  const Quartic lengths = product(square(range.first), square(range.second));
  for (std::size_t i = 0; i < volume.size(); ++i)
    if (!(volume[i] >= limit_ * lengths[i])) return false;
  return true;
}

// Returns the t at which the volumes over the vertices of `begin` and of `end` are equal, provided that the
// volume over `begin` is the larger one at t = 0 and the smaller one at t = 1. Otherwise, for example if the
// vertices are the same, returns 0.5.
double FlushSearch::change(const NormalRange& range, const Measured& begin, const Measured& end) const {
  if (begin.supports == end.supports) return 0.5;
  Quartic lead = numerator(range, begin.widths);
  const Quartic other = numerator(range, end.widths);
  for (std::size_t i = 0; i < lead.size(); ++i)
    lead[i] -= other[i];
  double low = 0, high = 1, below = lead.front(), above = lead.back();
  if (!(below > 0 && above < 0)) return 0.5;
  for (int step = 0; step < 12; ++step) {
    const double t = std::clamp(low + (high - low) * (below / (below - above)), low, high);
    const double value = value_at(lead, t);
    if (value == 0) return t;
    (value > 0 ? low : high) = t;
    (value > 0 ? below : above) = value;
    (value > 0 ? above : below) *= 0.5;  // Illinois variant of regula falsi
  }
  return 0.5 * (low + high);
}

void FlushSearch::refine(const NormalRange& range, const Measured& begin, const Measured& end, int depth) {
  // Objects of streets need at most 238 divisions. The limit bounds the time if rounding prevents the proofs:
  // the slowest of 6000 random clouds of any magnitudes takes 43 ms.
  constexpr int kDeepest = 40, kMostDivided = 100'000;
  constexpr double kLeast = 1e-3;
  if (is_proven(range, begin.widths) || is_proven(range, end.widths) || depth == kDeepest) return;
  if (++divided_ > kMostDivided) return;
  const double t = std::clamp(change(range, begin, end), kLeast, 1 - kLeast);
  const Measured middle = measure(range, t);
  refine(range.part(0, t), begin, middle, depth + 1);
  refine(range.part(t, 1), middle, end, depth + 1);
}

Measured FlushSearch::over(const Eigen::Matrix3d& axes, const SupportVertices& supports) const {
  Measured found{{}, supports, 1};
  const auto measure = [&](int i, Vector3d& width) {
    const auto vertex = [&](int k) {
      return vertices_[static_cast<std::size_t>(supports[static_cast<std::size_t>(k)])];
    };
    width = vertex(2 * i + 1) - vertex(2 * i);
    found.volume *= dot3(axes.col(i), width);
  };
  measure(0, found.widths.first);
  measure(1, found.widths.second);
  measure(2, found.widths.third);
  return found;
}

// Measures the box at t. SupportGraph::climb() may end early among vertices that are collinear or coplanar up
// to rounding. Therefore a volume below the limit is measured again over all vertices.
Measured FlushSearch::measure(const NormalRange& range, double t) {
  const Vector3d second = range.second_at(t);
  Eigen::Matrix3d axes;
  axes.col(0) = unit3(range.first_at(t));
  axes.col(1) = unit3(Vector3d(second - dot3(second, axes.col(0)) * axes.col(0)));
  axes.col(2) = cross3(Vector3d(axes.col(0)), Vector3d(axes.col(1)));
  const auto [low, high] = graph_.support_vertices(axes.col(2));
  Measured found =
      over(axes, {graph_.climb(range.one->opposite, -axes.col(0)), range.one->vertex,
                  graph_.climb(range.other->opposite, -axes.col(1)), range.other->vertex, low, high});
  if (!(found.volume < limit_)) return found;
  Measured whole = over(axes, graph_.exact_supports(axes));
  if (whole.volume < limit_) accept(axes);
  return whole;
}

// Rotates a better box to a local minimum before it becomes the best box. This lowers the limit further, so
// that more pairs are discarded.
void FlushSearch::accept(const Eigen::Matrix3d& axes) {
  constexpr int kRotations = 90;
  BoxFrame better{orthonormal_axes(axes), {}};
  better.size = extents(vertices_, better.axes);
  BoxFrame shrunk = better;
  shrink_frame(shrunk, kRotations, 1e-13, shape_, projection_);
  shrunk.axes = orthonormal_axes(shrunk.axes);
  shrunk.size = extents(vertices_, shrunk.axes);
  if (shrunk.volume() < better.volume()) better = shrunk;
  if (!(better.volume() < best_.volume())) return;
  best_ = better;
  set_limit();
}

}  // namespace

BoxFrame smallest_box(const BoxFrame& known, const Silhouette& shape) {
  return FlushSearch(known, shape).run();
}

}  // namespace pcl_bv::detail
