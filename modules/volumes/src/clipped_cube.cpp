// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "clipped_cube.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv::detail {

ClippedCube::ClippedCube() {
  Mesh cube = Aabb(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()).mesh();
  vertices_ = std::move(cube.vertices);
  loops_ = std::move(cube.faces);
}

void ClippedCube::cut(const Eigen::Vector3d& normal, double offset, double rounding) {
  const double scale = normal.cwiseAbs().maxCoeff();
  if (scale == 0) return;
  const Eigen::Vector3d unit = normal / scale;
  const double unit_offset = offset / scale;
  const double on_plane = 0x1p-42 + rounding / scale;
  heights_.resize(vertices_.size());
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const double h = unit.dot(vertices_[i]) - unit_offset;
    heights_[i] = std::abs(h) <= on_plane ? 0 : h;
  }
  bool above = false, below = false;
  for (const Loop& loop : loops_) {
    for (const std::int32_t v : loop) {
      above |= height(v) > 0;
      below |= height(v) < 0;
    }
  }
  if (!above) return;
  if (below) {
    clip();
  } else {
    collapse();
  }
}

// Handles the case that no vertex is below the plane. Only the face, edge or vertex on the plane remains.
void ClippedCube::collapse() {
  Loop remaining;
  for (const Loop& loop : loops_) {
    Loop on;
    std::copy_if(loop.begin(), loop.end(), std::back_inserter(on), [&](auto v) { return height(v) == 0; });
    if (on.size() > remaining.size()) remaining = on;
  }
  rank_ = std::min(static_cast<int>(remaining.size()) - 1, 2);
  loops_.clear();
  if (rank_ >= 0) loops_.push_back(remaining);
  if (rank_ == 2) loops_.emplace_back(remaining.rbegin(), remaining.rend());
}

void ClippedCube::clip() {
  crossings_.clear();
  std::vector<Loop> remaining;
  for (Loop& loop : loops_) {
    if (std::none_of(loop.begin(), loop.end(), [&](auto v) { return height(v) < 0; })) continue;
    const bool is_uncut = std::none_of(loop.begin(), loop.end(), [&](auto v) { return height(v) > 0; });
    remaining.push_back(is_uncut ? std::move(loop) : clip_loop(loop));
  }
  loops_ = std::move(remaining);
  close();
}

ClippedCube::Loop ClippedCube::clip_loop(const Loop& loop) {
  Loop part;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::int32_t a = loop[i], b = loop[(i + 1) % loop.size()];
    if (height(a) <= 0) part.push_back(a);
    if ((height(a) < 0 && height(b) > 0) || (height(a) > 0 && height(b) < 0)) part.push_back(crossing(a, b));
  }
  // A loop of two vertices passes its edge twice, so the new vertex was added twice.
  part.erase(std::unique(part.begin(), part.end()), part.end());
  return part;
}

// Returns the new vertex on an edge. Both faces of the edge get the same vertex.
std::int32_t ClippedCube::crossing(std::int32_t a, std::int32_t b) {
  if (a > b) std::swap(a, b);
  for (const Crossing& c : crossings_) {
    if (c.a == a && c.b == b) return c.vertex;
  }
  const auto vertex = static_cast<std::int32_t>(vertices_.size());
  const Eigen::Vector3d p = vertices_[a], q = vertices_[b];
  vertices_.push_back(p + (height(a) / (height(a) - height(b))) * (q - p));
  heights_.push_back(0);
  crossings_.push_back({a, b, vertex});
  return vertex;
}

// Adds the caps, i.e. the loops that close the surface. A cap consists of the edges on the plane that belong
// to only one loop, in reverse direction.
void ClippedCube::close() {
  std::vector<std::pair<std::int32_t, std::int32_t>> open;
  for (const Loop& loop : loops_) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::int32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      if (height(a) != 0 || height(b) != 0) continue;
      const auto opposite = std::find(open.begin(), open.end(), std::pair(b, a));
      if (opposite == open.end()) {
        open.emplace_back(a, b);
      } else {
        open.erase(opposite);
      }
    }
  }
  while (!open.empty()) {
    Loop cap;
    auto edge = open.begin();
    std::int32_t vertex = edge->second;
    while (edge != open.end()) {
      cap.push_back(vertex);
      vertex = edge->first;
      open.erase(edge);
      edge = std::find_if(open.begin(), open.end(), [&](const auto& e) { return e.second == vertex; });
    }
    loops_.push_back(std::move(cap));
  }
}

}  // namespace pcl_bv::detail
