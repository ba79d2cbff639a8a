// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scalar reference: plain projections in double, one point at a time, then an exact look at the points within
// their rounding error of the greatest. Compiled with -O3 -fno-tree-vectorize, so that it stays scalar.

#include "projections_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcl_bv/kernels/chunks.h"

namespace pcl_bv {
namespace {

double project(const Direction& d, const Coordinates& p) {
  return (d[0] * p.x + d[1] * p.y) + d[2] * p.z;
}

// Least and greatest projection of one block's valid points, and the greatest magnitudes of their
// coordinates.
struct Block {
  double low[kMaxProjections];
  double high[kMaxProjections];
  Coordinates magnitude{0, 0, 0};

  double reach(std::size_t end) const { return end % 2 == 0 ? -low[end / 2] : high[end / 2]; }
};

std::size_t project_block(const PointView& points, const ProjectionSet& set, Block& out) {
  std::fill_n(out.low, set.count, std::numeric_limits<double>::infinity());
  std::fill_n(out.high, set.count, -std::numeric_limits<double>::infinity());
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) {
      ++dropped;
      continue;
    }
    out.magnitude = {std::max(out.magnitude.x, std::abs(p.x)), std::max(out.magnitude.y, std::abs(p.y)),
                     std::max(out.magnitude.z, std::abs(p.z))};
    for (std::size_t k = 0; k < set.count; ++k) {
      const double projection = project(set.scaled[k], p);
      out.low[k] = projection < out.low[k] ? projection : out.low[k];
      out.high[k] = projection > out.high[k] ? projection : out.high[k];
    }
  }
  return dropped;
}

// Of two projections together: each 3.01 * 2^-53 of the magnitudes; then what underflow may take from
// products and from the direction's tiny components.
double doubt(const Direction& d, const Coordinates& m) {
  const double magnitude = (std::abs(d[0]) * m.x + std::abs(d[1]) * m.y) + std::abs(d[2]) * m.z;
  return 0x1p-50 * magnitude + (0x1p-1072 * (m.x + m.y + m.z) + std::numeric_limits<double>::min());
}

void search(const PointView& block, const ProjectionSet& set, std::size_t end, double threshold,
            FarthestPoint& best) {
  const Direction exact = set.end_direction(end);
  for (std::size_t i = 0; i < block.count; ++i) {
    const Coordinates p = load_point(block, i);
    if (!is_valid(p)) continue;
    const double projection = project(set.scaled[end / 2], p);
    if ((end % 2 == 0 ? -projection : projection) < threshold) continue;
    keep_farthest(exact, {true, p, block.index(i)}, best);
  }
}

}  // namespace

void chunk_farthest_reference(const PointView& chunk, const ProjectionSet& set,
                              const ReachedProjections& reached, ChunkFarthest& out) {
  Block blocks[kChunkPoints / kBlockPoints];
  Coordinates magnitude{0, 0, 0};
  out = ChunkFarthest();
  std::size_t count = 0;
  const auto block_at = [&](std::size_t b) {
    return chunk.slice(b * kBlockPoints, std::min(kBlockPoints, chunk.count - b * kBlockPoints));
  };
  for (; count * kBlockPoints < chunk.count; ++count) {
    out.dropped += project_block(block_at(count), set, blocks[count]);
    const Coordinates& m = blocks[count].magnitude;
    magnitude = {std::max(magnitude.x, m.x), std::max(magnitude.y, m.y), std::max(magnitude.z, m.z)};
  }
  if (out.dropped == chunk.count) return;
  for (std::size_t end = 0; end < 2 * set.count; ++end) {
    double top = blocks[0].reach(end);
    for (std::size_t b = 1; b < count; ++b)
      top = std::max(top, blocks[b].reach(end));
    const double band = doubt(set.scaled[end / 2], magnitude);
    if (top + band < reached[end]) continue;
    for (std::size_t b = 0; b < count; ++b) {
      if (blocks[b].reach(end) >= top - band) search(block_at(b), set, end, top - band, out.ends[end]);
    }
  }
}

}  // namespace pcl_bv
