// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "town_models.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "street_cast.h"
#include "street_parts.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kModels = 16;   // models of a set
constexpr double kMaxRefinement = 3;  // how much nearer than the spacing the points of thin models are

Model make_fence(SplitMix64& random) {
  const double half_length = random.uniform(5.8, 6.8), height = random.uniform(1.1, 1.6);
  std::vector<Part> parts;
  for (const double z : {0.3, 0.5 * height, height - 0.15})
    parts.push_back(box({{-half_length, -0.02, z - 0.06}, {half_length, 0.02, z + 0.06}}));
  constexpr int posts = 6;
  for (int i = 0; i <= posts; ++i) {
    const double x = half_length * (2.0 * i / posts - 1);
    parts.push_back(box({{x - 0.05, -0.05, 0}, {x + 0.05, 0.05, height}}));
  }
  return assemble(SynthObjectKind::wall, std::move(parts));
}

Model make_plant(SplitMix64& random) {
  return random.uniform() < 0.7 ? make_tree(random) : make_bush(random);
}

/// A plane of a jittered grid of parallel rays, one of the five sides of the model's bounds.
struct RayGrid {
  Vec3 corner, u, v;  // the corner, and the two edges
  Vec3 direction;     // into the model
};

std::array<RayGrid, 5> ray_grids(const Box3& bounds) {
  const Vec3 size = bounds.hi - bounds.lo, lo = bounds.lo;
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  return {{{lo, y, z, {1, 0, 0}},
           {lo + x, y, z, {-1, 0, 0}},
           {lo, x, z, {0, 1, 0}},
           {lo + y, x, z, {0, -1, 0}},
           {lo + z, x, y, {0, 0, -1}}}};
}

/// Keeps the points of the largest component, in which neighbours are at most `distance` apart: leaves
/// without connection to the rest of a tree would be clusters of their own.
void keep_largest_component(std::vector<Vec3>& points, double distance) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
  std::vector<std::size_t> parent(points.size()), size(points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::size_t i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = i + 1; k < points.size() && points[k].x - points[i].x <= distance; ++k) {
      const Vec3 step = points[k] - points[i];
      if (dot(step, step) <= distance * distance) parent[root(k)] = root(i);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    ++size[root(i)];
  const auto largest = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (root(i) == largest) points[kept++] = points[i];
  points.resize(kept);
}

class ModelSampler {
 public:
  ModelSampler(Model model, double spacing, std::uint64_t key) : random_(key) {
    const Vec3 size = model.bounds.hi - model.bounds.lo;
    const double thin = std::min(size.x, size.y) / 3;
    const double max_spacing = model.kind == SynthObjectKind::tree ? 0.6 * spacing : spacing;
    spacing_ = std::clamp(thin, spacing / kMaxRefinement, max_spacing);
    // Crowns of trees are dense, so that a tree is one cluster.
    for (Part& part : model.parts)
      part.free_path = std::min(part.free_path, 0.08);
    object_.id = 1;
    object_.model = std::move(model);
    object_.forward = {1, 0, 0};
    object_.left = {0, 1, 0};
    object_.up = {0, 0, 1};
  }

  TownModel sample() {
    for (const RayGrid& grid : ray_grids(object_.model.bounds))
      sample(grid);
    if (object_.model.kind == SynthObjectKind::tree) keep_largest_component(points_, 2 * spacing_);
    TownModel model;
    model.kind = object_.model.kind;
    model.upright = model.kind == SynthObjectKind::house || model.kind == SynthObjectKind::tree ||
                    model.kind == SynthObjectKind::pole;
    if (!points_.empty()) model.bounds = {points_.front(), points_.front()};
    for (const Vec3& p : points_) {
      Box3& b = model.bounds;
      b.lo = {std::min(b.lo.x, p.x), std::min(b.lo.y, p.y), std::min(b.lo.z, p.z)};
      b.hi = {std::max(b.hi.x, p.x), std::max(b.hi.y, p.y), std::max(b.hi.z, p.z)};
    }
    model.points = std::move(points_);
    return model;
  }

 private:
  void sample(const RayGrid& grid) {
    const auto steps = [&](Vec3 edge) {
      return std::max(1, static_cast<int>(std::round(std::sqrt(dot(edge, edge)) / spacing_)));
    };
    const int columns = steps(grid.u), rows = steps(grid.v);
    for (int i = 0; i < columns; ++i) {
      for (int k = 0; k < rows; ++k) {
        const double s = (i + random_.uniform(0.3, 0.7)) / columns;
        const double t = (k + random_.uniform(0.3, 0.7)) / rows;
        // The ray begins outside of the model. cast() has rays from the origin, so the model is moved.
        const Vec3 origin = grid.corner + s * grid.u + t * grid.v - grid.direction;
        object_.base = -1.0 * origin;
        Hit hit;
        cast({grid.direction, random_.next()}, object_, hit);
        if (hit.object != 0) points_.push_back(origin + hit.range * grid.direction);
      }
    }
  }

  SplitMix64 random_;
  PlacedObject object_;
  double spacing_ = 0;
  std::vector<Vec3> points_;
};

}  // namespace

TownModels sample_town_models(std::uint64_t seed, double spacing) {
  // In the order of TownModelSet.
  constexpr std::array<Model (*)(SplitMix64&), kTownModelSets> makers{
      make_house,       make_hedge_or_wall, make_fence,     make_low_wall, make_plant,
      make_avenue_tree, make_car,           make_lamp_post, make_sign_post};
  TownModels models;
  for (std::size_t set = 0; set < models.size(); ++set) {
    for (std::size_t i = 0; i < kModels; ++i) {
      SplitMix64 random({seed, 0x746f776e, set, i});
      Model model = makers[set](random);
      models[set].push_back(ModelSampler(std::move(model), spacing, random.next()).sample());
    }
  }
  return models;
}

}  // namespace pcl_bv::detail
