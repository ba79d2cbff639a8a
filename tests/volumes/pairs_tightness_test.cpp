// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How near the certified distance of two volumes is to the true one: against closed forms, against all pairs
// of faces and edges, and against directions that another search finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "few_cases.h"
#include "pair_volumes.h"
#include "pcl_bv/volumes/hull.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::Form;
using testing::Random;

constexpr unsigned kSeed = 11;

double gap_along(const AnyVolume& a, const AnyVolume& b, const Vector3d& d) {
  return d.dot(support(b, -d) - support(a, d)) / d.norm();
}

// A volume of the form that is apart from `a` by `gap` along a direction.
AnyVolume apart_along(const AnyVolume& a, const Form& form, const Vector3d& at, const Vector3d& d, double t,
                      double gap) {
  const double missing = gap - gap_along(a, form.volume(at, t), d);
  return form.volume(at + missing / d.squaredNorm() * d.norm() * d, t);
}

template <typename Check>
void for_all_pairs(const Check& check) {
  for (int i = 0; i < testing::kKinds; ++i) {
    for (int j = 0; j < testing::kKinds; ++j) {
      SCOPED_TRACE(::testing::Message() << shape_name(testing::empty_volume(i)) << " and "
                                        << shape_name(testing::empty_volume(j)));
      check(i, j);
    }
  }
}

// 10^5 pairs (fewer under sanitizers) that a plane separates by a small part of their size.
TEST(PairsTightness, AGapOfOnePartIn10ToThe12IsSeen) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    for (int round = 0; round < (test::kFewCases ? 100 : 1600); ++round) {
      const Form form(random, i), other(random, j);
      const AnyVolume a = form.volume(random.vector(1), 0.5);
      const Vector3d d = random.uniform(0, 1) < 0.2 ? Vector3d(Vector3d::Unit(round % 3)) : random.vector(1);
      const AnyVolume b = apart_along(a, other, random.vector(1), d, 0.5, 1e-12);
      EXPECT_FALSE(overlaps(a, b)) << "seed " << kSeed << ", round " << round;
    }
  });
}

TEST(PairsTightness, SizesThatDifferByAMillionHideNoGap) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    for (int round = 0; round < 30; ++round) {
      const Form form(random, i), other(random, j);
      const AnyVolume a = form.volume(random.vector(1e3), 1e3);
      const AnyVolume b = apart_along(a, other, random.vector(1e3), random.vector(1), 1e-3, 1e-9);
      EXPECT_FALSE(overlaps(a, b));
    }
  });
}

// Tangent directions, each step shorter where none is better.
double best_gap(const AnyVolume& a, const AnyVolume& b, Random& random) {
  Vector3d best = center(b) - center(a);
  best.normalize();
  double gap = gap_along(a, b, best);
  const auto offer = [&](const Vector3d& d) {
    const double found = gap_along(a, b, d);
    if (!(found > gap)) return false;
    gap = found;
    best = d.normalized();
    return true;
  };
  for (int i = 0; i < 100; ++i)
    offer(random.vector(1));
  for (double step = 0.3; step > 1e-9;) {
    const Vector3d across = best.unitOrthogonal(), other = best.cross(across);
    bool better = false;
    for (int k = 0; k < 16; ++k) {
      const double angle = 0.4 * k;
      better = offer(best + step * (std::cos(angle) * across + std::sin(angle) * other)) || better;
    }
    if (!better) step /= 2;
  }
  return gap;
}

TEST(PairsTightness, NoDirectionFoundOtherwiseTellsMore) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    for (int round = 0; round < 12; ++round) {
      const Form form(random, i), other(random, j);
      const AnyVolume a = form.volume(random.vector(1), 0.5);
      const double gap = std::pow(10, -2 * (round % 6));
      const AnyVolume b = apart_along(a, other, random.vector(1), random.vector(1), 0.5, gap);
      const double d = distance(a, b), found = best_gap(a, b, random);
      EXPECT_GE(d, found - 5e-14 - 1e-12 * found) << "round " << round;
      EXPECT_LE(d, found + 0.02);  // the search itself may stop at a kink
    }
  });
}

// Of two segments.
double between(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const auto of_point = [](const Vector3d& p, const Vector3d& from, const Vector3d& to) {
    const Vector3d e = to - from;
    const double t = e.isZero(0) ? 0 : std::clamp((p - from).dot(e) / e.squaredNorm(), 0.0, 1.0);
    return (p - from - t * e).norm();
  };
  double nearest = std::min({of_point(a, c, d), of_point(b, c, d), of_point(c, a, b), of_point(d, a, b)});
  const Vector3d u = b - a, v = d - c, n = u.cross(v);
  if (n.squaredNorm() < 1e-20 * u.squaredNorm() * v.squaredNorm()) return nearest;
  const double s = (c - a).cross(v).dot(n), t = (c - a).cross(u).dot(n);
  if (std::min(s, t) < 0 || std::max(s, t) > n.squaredNorm()) return nearest;
  return std::min(nearest, std::abs((c - a).dot(n)) / n.norm());
}

double over_faces(const Mesh& points, const Mesh& faces) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& face : faces.faces) {
    const auto at = [&](std::size_t i) {
      return faces.vertices[static_cast<std::size_t>(face[i % face.size()])];
    };
    Vector3d normal = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      normal += (at(i) - at(0)).cross(at(i + 1) - at(0));
    normal.normalize();
    for (const Vector3d& p : points.vertices) {
      bool over = true;
      for (std::size_t i = 0; i < face.size(); ++i)
        over = over && normal.dot((at(i + 1) - at(i)).cross(p - at(i))) >= 0;
      if (over) nearest = std::min(nearest, std::abs(normal.dot(p - at(0))));
    }
  }
  return nearest;
}

// All corners over all faces, all edges with all edges.
double mesh_distance(const Mesh& a, const Mesh& b) {
  double nearest = std::min(over_faces(a, b), over_faces(b, a));
  for (const auto& f : a.faces) {
    for (std::size_t i = 0; i < f.size(); ++i) {
      const auto &p = a.vertices[static_cast<std::size_t>(f[i])],
                 &q = a.vertices[static_cast<std::size_t>(f[(i + 1) % f.size()])];
      for (const auto& g : b.faces) {
        for (std::size_t k = 0; k < g.size(); ++k) {
          nearest = std::min(nearest, between(p, q, b.vertices[static_cast<std::size_t>(g[k])],
                                              b.vertices[static_cast<std::size_t>(g[(k + 1) % g.size()])]));
        }
      }
    }
  }
  return nearest;
}

TEST(PairsTightness, OfPolytopesIsThatOfTheirFacesAndEdges) {
  Random random(kSeed);
  for (const int i : {0, 1, 3, 7}) {
    for (const int j : {0, 1, 3, 7}) {
      for (int round = 0; round < 24; ++round) {
        const Form form(random, i), other(random, j);
        const AnyVolume a = form.volume(random.vector(1), 0.5);
        const double gap = std::pow(10, -2 * (round % 6));
        const AnyVolume b = apart_along(a, other, random.vector(1), random.vector(1), 0.5, gap);
        const double expected = mesh_distance(mesh(a), mesh(b));
        EXPECT_NEAR(distance(a, b), expected, 4e-14) << "kinds " << i << ' ' << j << ", round " << round;
      }
    }
  }
}

TEST(PairsTightness, OfParallelBoxesIsThatOfTheirSides) {
  Random random(kSeed);
  for (int round = 0; round < 500; ++round) {
    const Eigen::Matrix3d axes = random.isometry(1).linear();
    const Vector3d half = random.vector(1).cwiseAbs(), other = random.vector(1).cwiseAbs();
    Vector3d away = (half + other).cwiseProduct(Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0));
    const double gap = std::pow(10, random.uniform(-11, 0));
    away[2] = half[2] + other[2] + gap;  // two faces look at one another
    const Vector3d at = random.vector(1);
    const double d = distance(Obb(at, axes, half), Obb(at + axes * away, axes, other));
    EXPECT_NEAR(d, gap, 3e-14) << "round " << round;
  }
}

TEST(PairsTightness, OfAabbsIsExactWhereOneAxisTells) {
  EXPECT_EQ(distance(Aabb({0, 0, 0}, {1, 1, 1}), Aabb({4, 0.5, 0.5}, {5, 1, 1})), 3);
  EXPECT_EQ(distance(Aabb({0, 0, 0}, {1, 1, 1}), Aabb({4, 5, 0.5}, {5, 6, 1})), 5 * (1 - 0x1p-50));
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_EQ(distance(Aabb({0, 0, 0}, {1, 1, 1}), Aabb({next, 0, 0}, {2, 1, 1})), next - 1);
}

TEST(PairsTightness, KdopsOfOneSetAreApartWhereASlabSaysSo) {
  Random random(kSeed);
  for (int round = 0; round < 200; ++round) {
    const auto set = testing::kdop_sets()[static_cast<std::size_t>(round) % 6];
    Kdop a(set), b(set);
    for (int i = 0; i < 12; ++i) {
      a.extend(random.vector(1));
      b.extend(random.vector(1) + Vector3d(1.5, 0.3, 0));
    }
    if (!a.overlaps(b)) {
      EXPECT_FALSE(overlaps(AnyVolume(a), AnyVolume(b)));
    }
  }
}

TEST(PairsTightness, ClosedForms) {
  const Vector3d x(1, 0, 0), z(0, 0, 1);
  const Eigen::Matrix3d id = Eigen::Matrix3d::Identity();
  const Sphere ball({0, 0, 0}, 1);
  EXPECT_NEAR(distance(ball, Sphere({3, 4, 0}, 2)), 2, 1e-14);
  EXPECT_NEAR(distance(ball, Capsule({-5, 3, 0}, {5, 3, 0}, 0.5)), 1.5, 1e-14);
  EXPECT_NEAR(distance(Cylinder({0, 0, 0}, z, 1, 2), Cylinder({5, 0, 1}, z, 1.5, 2)), 2.5, 1e-13);
  EXPECT_NEAR(distance(Cylinder({0, 0, 0}, z, 1, 2), Cylinder({0, 0, 6}, x, 1, 3)), 3, 1e-13);
  EXPECT_NEAR(distance(Cylinder({0, 0, 0}, z, 1, 1), Cylinder({0.3, 0, 3}, z, 1, 1)), 1, 1e-13);
  EXPECT_NEAR(distance(Ellipsoid({0, 0, 0}, id, {1, 2, 3}), Ellipsoid({0, 0, 10}, id, {3, 2, 1})), 6, 1e-13);
  EXPECT_NEAR(distance(Ellipsoid({0, 0, 0}, id, {1, 2, 3}), Aabb({-9, -9, 4}, {9, 9, 5})), 1, 1e-13);
  EXPECT_NEAR(distance(Capsule({0, 0, 0}, x, 0.1), Capsule({0.5, -1, 1}, {0.5, 1, 1}, 0.2)), 0.7, 1e-14);
}

}  // namespace
}  // namespace pcl_bv::detail
