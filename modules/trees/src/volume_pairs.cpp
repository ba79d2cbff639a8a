// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "volume_pairs.h"

namespace pcl_bv {
namespace {

struct Overlap {
  bool operator()(const Aabb& a, const Aabb& b) const { return a.overlaps(b); }
  bool operator()(const Sphere& a, const Sphere& b) const { return a.overlaps(b); }
  bool operator()(const Obb& a, const Obb& b) const { return a.overlaps(b); }
  bool operator()(const Kdop& a, const Kdop& b) const {
    return *a.set() == *b.set() ? a.overlaps(b) : a.aabb().overlaps(b.aabb());
  }
  template <typename A, typename B>
  bool operator()(const A& a, const B& b) const {
    return a.aabb().overlaps(b.aabb());
  }
};

}  // namespace

bool volumes_overlap(const AnyVolume& a, const AnyVolume& b) {
  return std::visit(Overlap(), a, b);
}

}  // namespace pcl_bv
