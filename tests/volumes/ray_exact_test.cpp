// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the ray test against the interval in rational numbers; its contract is in ray_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "exact.h"
#include "kdop_sets.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Ray {
  Vector3d origin, direction;

  ExactPoint at(double t) const {
    ExactPoint p = exact(origin);
    for (int k = 0; k < 3; ++k)
      p[static_cast<std::size_t>(k)] += Rational(t) * Rational(direction[k]);
    return p;
  }
};

// Rays that hit, miss, start inside, run along a face or away; some of odd lengths.
std::vector<Ray> rays_for(const std::vector<Vector3d>& cloud, const Scale& scale, const KdopSet& set,
                          Random& random) {
  const Vector3d inside = cloud[0], outside = inside + random.vector(4 * scale.extent);
  const auto any = [&] {
    return set.direction(static_cast<std::size_t>(random.uniform(0, static_cast<double>(set.size()))));
  };
  std::vector<Ray> rays = {{outside, cloud[1] - outside},
                           {outside, 1e3 * (cloud[2] - outside)},
                           {outside, inside - outside},
                           {inside, cloud[3] - inside},
                           {outside, random.vector(1)},
                           {outside, outside - inside},
                           {inside, any().cross(any()) * scale.extent},
                           {outside, any() * 1e-3 * scale.extent}};
  rays.push_back({cloud[1] - 2 * rays[6].direction, rays[6].direction});
  std::erase_if(rays, [](const Ray& r) { return r.direction.isZero(0); });
  return rays;
}

struct HalfSpace {
  Vector3d normal;
  double offset;  // normal . p <= offset
};

std::vector<HalfSpace> half_spaces(const Kdop& kdop) {
  std::vector<HalfSpace> result;
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    result.push_back({kdop.set()->direction(i), kdop.max(i)});
    result.push_back({-kdop.set()->direction(i), -kdop.min(i)});
  }
  return result;
}

std::vector<HalfSpace> half_spaces(const Aabb& box) {
  return half_spaces(Kdop(KdopSet::dop6(), box.min(), box.max()));
}

struct ExactInterval {
  Rational enter, exit;
};

// Brute force over the half-spaces of a bounded polytope.
std::optional<ExactInterval> exact_interval(const std::vector<HalfSpace>& polytope, const Ray& ray) {
  Rational enter = 0;
  std::optional<Rational> exit;
  for (const auto& [normal, offset] : polytope) {
    const Rational slope = dot(normal, exact(ray.direction));
    const Rational bound = Rational(offset) - dot(normal, exact(ray.origin));
    if (slope == 0 && bound < 0) return std::nullopt;
    if (slope < 0) enter = std::max(enter, Rational(bound / slope));
    if (slope > 0) exit = exit ? std::min(*exit, Rational(bound / slope)) : Rational(bound / slope);
  }
  if (enter > *exit) return std::nullopt;
  return ExactInterval{enter, *exit};
}

// The exact interval is inside the reported one, whose ends are beyond no half-space by more than rounding.
template <typename Volume>
void expect_tight_enclosure(const Volume& volume, const Ray& ray) {
  const auto polytope = half_spaces(volume);
  const auto truth = exact_interval(polytope, ray);
  const auto reported = volume.intersect(ray.origin, ray.direction);
  if (truth) {
    ASSERT_TRUE(reported);
    ASSERT_TRUE(Rational(reported->enter) <= truth->enter);
    ASSERT_TRUE(Rational(reported->exit) >= truth->exit);
  }
  if (!reported) return;
  ASSERT_LE(0, reported->enter);
  ASSERT_LE(reported->enter, reported->exit);
  ASSERT_LT(reported->exit, infinity);
  for (const double t : {reported->enter, reported->exit}) {
    for (const auto& [normal, offset] : polytope) {
      const Vector3d magnitude = ray.origin.cwiseAbs() + t * ray.direction.cwiseAbs();
      const double slack = 0x1p-48 * normal.cwiseAbs().dot(magnitude) + 1e-300;
      ASSERT_TRUE(dot(normal, ray.at(t)) <= Rational(offset) + Rational(slack));
    }
  }
}

TEST(RayExact, OfAKdopEnclosesTheExactIntervalTightly) {
  Random random(51);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      for (const Span span : spans()) {
        SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
        const auto cloud = random.cloud(scale, span, 8);
        const Kdop kdop = around(Kdop(set), cloud);
        for (const Ray& ray : rays_for(cloud, scale, *set, random))
          expect_tight_enclosure(kdop, ray);
      }
    }
  }
}

TEST(RayExact, OfABoxEnclosesTheExactIntervalTightly) {
  Random random(52);
  for (const Scale& scale : scales()) {
    for (const Span span : spans()) {
      SCOPED_TRACE(scale.name);
      for (int i = 0; i < 10; ++i) {
        const auto cloud = random.cloud(scale, span, 8);
        const Aabb box = around(Aabb(), cloud);
        for (const Ray& ray : rays_for(cloud, scale, *KdopSet::dop26(), random))
          expect_tight_enclosure(box, ray);
      }
    }
  }
}

TEST(RayExact, ThatTouchesACornerEdgeOrFaceExactlyIsAHit) {
  Random random(53);
  const auto lattice = [&](int reach) { return Vector3d((random.vector(reach + 0.49)).array().round()); };
  int touches = 0, misses = 0;
  for (const auto& set : {KdopSet::dop6(), KdopSet::dop14(), KdopSet::dop26()}) {
    for (int i = 0; i < 600; ++i) {
      std::vector<Vector3d> points;
      for (int k = 0; k < 1 + i % 5; ++k)
        points.push_back(lattice(2));
      const Kdop kdop = around(Kdop(set), points);
      // A third of it: neither origin nor direction is a short binary number, nor the parameter of the touch.
      const Vector3d origin = points[0] + 3 * lattice(2), direction = (points[0] - origin + lattice(1)) / 3;
      if (direction.isZero(0)) continue;
      for (const Ray& ray : {Ray{origin, direction}, Ray{origin, 3 * direction}}) {
        const auto truth = exact_interval(half_spaces(kdop), ray);
        touches += truth && truth->enter == truth->exit;
        misses += !kdop.intersect(ray.origin, ray.direction);
        expect_tight_enclosure(kdop, ray);
        expect_tight_enclosure(around(Aabb(), points), ray);
      }
    }
  }
  EXPECT_GT(touches, 300) << "the cases are too easy";
  EXPECT_GT(misses, 300) << "the cases are too easy";
}

TEST(RayExact, HitsAPointOfAFlatKdopThatPlainArithmeticWouldMiss) {
  Random random(54);
  for (int i = 0; i < 2000; ++i) {
    // The sums are exact, so the ray runs through p; the projections of all three are rounded.
    const Vector3d p = (random.vector(5e6) * 0x1p20).array().round() * 0x1p-20;
    const Vector3d step = (random.vector(1) * 0x1p20).array().round() * 0x1p-20;
    const Kdop kdop = Kdop().extend(p);
    const auto hit = kdop.intersect(p - step, step);
    ASSERT_TRUE(hit) << i;
    ASSERT_LE(hit->enter, 1);
    ASSERT_GE(hit->exit, 1);
  }
}

// f(t) = |q + t d|^2 - r^2
Rational beyond(const Sphere& sphere, const Ray& ray, double t, const Rational& radius) {
  return squared_distance(exact(sphere.center()), ray.at(t)) - radius * radius;
}

// The exact interval by signs only: where f is a parabola a t^2 + 2 b t + c, an end outside of the roots has
// f >= 0 and is on its side of the vertex, -b / a.
void expect_tight_enclosure(const Sphere& sphere, const Ray& ray) {
  const Rational radius(sphere.radius());
  Rational a = 0, b = 0;
  for (int k = 0; k < 3; ++k) {
    const Rational d(ray.direction[k]);
    a += d * d;
    b += d * (Rational(ray.origin[k]) - Rational(sphere.center()[k]));
  }
  const Rational c = beyond(sphere, ray, 0, radius);
  const auto reported = sphere.intersect(ray.origin, ray.direction);
  if (c <= 0 || (b < 0 && b * b >= a * c)) {
    ASSERT_TRUE(reported);
    if (c <= 0) {
      ASSERT_EQ(reported->enter, 0);
    } else {
      ASSERT_TRUE(reported->enter == 0 || beyond(sphere, ray, reported->enter, radius) >= 0);
      ASSERT_TRUE(Rational(reported->enter) * a <= -b);
    }
    ASSERT_TRUE(beyond(sphere, ray, reported->exit, radius) >= 0);
    ASSERT_TRUE(Rational(reported->exit) * a >= -b);
  }
  if (!reported) return;
  ASSERT_LE(0, reported->enter);
  ASSERT_LE(reported->enter, reported->exit);
  const double slack = 0x1p-46 * ((ray.origin - sphere.center()).lpNorm<1>() + sphere.radius()) + 0x1p-510;
  for (const double t : {reported->enter, reported->exit})
    ASSERT_TRUE(beyond(sphere, ray, t, radius + Rational(slack)) <= 0);
}

TEST(RayExact, OfASphereEnclosesTheExactIntervalTightly) {
  Random random(55);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 60; ++i) {
      const auto cloud = random.cloud(scale, Span::solid, 8);
      const Sphere sphere(cloud[0], std::array{0.0, 1e-6, 0.5, 1.0}[i % 4] * scale.extent);
      for (const Ray& ray : rays_for(cloud, scale, *KdopSet::dop26(), random))
        expect_tight_enclosure(sphere, ray);
    }
  }
}

TEST(RayExact, TangentToASphereIsAHit) {
  // (1, 2, 2) and (2, 1, -2) are perpendicular and 3 long: the ray touches at p.
  Random random(56);
  for (int i = 0; i < 500; ++i) {
    const double k = std::round(random.uniform(1, 1e6));
    const Vector3d center = random.vector(1e6).array().round(), p = center + k * Vector3d(1, 2, 2);
    const Vector3d along(2, 1, -2);
    const Ray ray{p - std::round(random.uniform(1, 1e6)) * along, along / 3};
    expect_tight_enclosure(Sphere(center, 3 * k), {ray.origin, along});
    expect_tight_enclosure(Sphere(center, 3 * k), ray);
    EXPECT_TRUE(Sphere(center, 3 * k).intersect(ray.origin, along));
    EXPECT_FALSE(Sphere(center, 3 * k * (1 - 1e-6)).intersect(p - 10 * k * along, along));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
