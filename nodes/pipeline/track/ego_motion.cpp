// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ego_motion.h"

#include <algorithm>
#include <array>

namespace pcl_bv::detail {
namespace {

constexpr double kMaxShift = 4;      // metres per frame; 40 m/s at 10 Hz
constexpr double kAgreement = 0.35;  // metres; partial views move centres by decimetres
constexpr double kMaxSize = 6;       // metres; longer objects, such as walls, are only partly visible
constexpr std::size_t kMinPairs = 6;
constexpr double kBin = 0.5;
constexpr int kBins = 17;  // 2 kMaxShift / kBin + 1

bool small(const Aabb& box) {
  const Eigen::Vector3d size = box.max() - box.min();
  return std::max(size.x(), size.y()) < kMaxSize;
}

bool alike(const Aabb& a, const Aabb& b) {
  const Eigen::Vector3d sizes = (a.max() - a.min()), others = b.max() - b.min();
  return (sizes - others).cwiseAbs().maxCoeff() < 0.4 + 0.15 * sizes.maxCoeff();
}

Eigen::Vector2d centre_of(const Aabb& box) {
  return box.center().head<2>();
}

}  // namespace

void EgoMotion::match(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen,
                      const PlanarMotion& motion, double radius) {
  pairs_.clear();
  for (const Aabb& box : expected) {
    if (!small(box)) continue;
    const Eigen::Vector2d from = centre_of(box), at = motion * from;
    double nearest = radius * radius;
    Eigen::Vector2d to = at;
    bool found = false;
    grid_.visit_near({at.x(), at.y(), 0}, [&](std::size_t b) {
      const double distance = (centre_of(seen[b]) - at).squaredNorm();
      if (distance >= nearest || !alike(box, seen[b])) return;
      nearest = distance;
      to = centre_of(seen[b]);
      found = true;
    });
    if (found) pairs_.push_back({from, to});
  }
}

// Pairs nearest neighbours, then computes the rigid planar motion that maps the expected boxes to their
// neighbours, by least squares.
std::size_t EgoMotion::refine(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen,
                              PlanarMotion& motion, double radius) {
  match(expected, seen, motion, radius);
  if (pairs_.size() < kMinPairs) return pairs_.size();
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = from;
  for (const Pair& pair : pairs_) {
    from += pair.from;
    to += pair.to;
  }
  from /= static_cast<double>(pairs_.size());
  to /= static_cast<double>(pairs_.size());
  double dot = 0, cross = 0;
  for (const Pair& pair : pairs_) {
    const Eigen::Vector2d a = pair.from - from, b = pair.to - to;
    dot += a.dot(b);
    cross += a.x() * b.y() - a.y() * b.x();
  }
  motion.yaw = std::atan2(cross, dot);
  motion.shift.setZero();
  motion.shift = to - motion * from;
  return pairs_.size();
}

// Rotates the expected boxes by motion.yaw. Then sets motion.shift to the most frequent shift from an
// expected to a measured box.
void EgoMotion::vote(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen, PlanarMotion& motion) {
  const auto bin = [](int x, int y) {
    return std::size_t{kBins} * static_cast<std::size_t>(y) + static_cast<std::size_t>(x);
  };
  votes_.assign(bin(0, kBins), 0);
  for (const Aabb& box : expected) {
    if (!small(box)) continue;
    const Eigen::Vector2d at = PlanarMotion{motion.yaw} * centre_of(box);
    grid_.visit_near({at.x(), at.y(), 0}, [&](std::size_t b) {
      const Eigen::Vector2d shift = (centre_of(seen[b]) - at) / kBin;
      const auto x = static_cast<int>(std::lround(std::clamp(shift.x(), -99.0, 99.0))) + kBins / 2;
      const auto y = static_cast<int>(std::lround(std::clamp(shift.y(), -99.0, 99.0))) + kBins / 2;
      if (x < 0 || y < 0 || x >= kBins || y >= kBins || !alike(box, seen[b])) return;
      ++votes_[bin(x, y)];
    });
  }
  unsigned max_votes = 0;
  for (int y = 1; y < kBins - 1; ++y) {
    for (int x = 1; x < kBins - 1; ++x) {
      unsigned sum = 0;
      for (int i = 0; i < 9; ++i)
        sum += votes_[bin(x + i % 3 - 1, y + i / 3 - 1)];
      if (sum <= max_votes) continue;
      max_votes = sum;
      motion.shift = kBin * Eigen::Vector2d(x - kBins / 2, y - kBins / 2);
    }
  }
}

bool EgoMotion::estimate(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen,
                         const PlanarMotion& guess, PlanarMotion& motion) {
  const auto candidates = static_cast<std::size_t>(std::count_if(expected.begin(), expected.end(), small));
  if (candidates < kMinPairs || seen.size() < kMinPairs) return false;
  grid_.fill(seen, kMaxShift);
  if (pairs_.capacity() < expected.size()) pairs_.reserve(4 * expected.size());
  votes_.reserve(std::size_t{kBins} * kBins);
  const auto refine_from = [&](PlanarMotion& from) {
    for (const double radius : {2.0, 1.5, 1.0, 0.7, 0.5, kAgreement, kAgreement})
      refine(expected, seen, from, radius);
    match(expected, seen, from, kAgreement);
    return pairs_.size();
  };
  PlanarMotion best = guess;
  std::size_t agree = refine_from(best);
  if (5 * agree < 2 * candidates) {
    for (const double degrees : {0.0, -1.5, 1.5, -3.0, 3.0}) {
      PlanarMotion other{degrees * 3.14159265358979323846 / 180};
      vote(expected, seen, other);
      const std::size_t others = refine_from(other);
      if (others <= agree) continue;
      agree = others;
      best = other;
    }
  }
  if (agree < kMinPairs || 10 * agree < 3 * candidates) return false;
  motion = best;
  return true;
}

}  // namespace pcl_bv::detail
