// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A host that flushes denormals must not change a bit of what any verb gives.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "exact.h"
#include "flush_to_zero.h"
#include "numbers.h"
#include "pcl_bv/volumes/any_volume.h"
#include "round_volumes.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

constexpr unsigned kSeed = 1;

// What verbs gave: only copied, so that the recorder computes nothing in the flushing host.
class Record {
 public:
  void begin(std::string_view shape) { shape_ = shape; }
  void add(const char* verb, bool value) { put(verb, value ? 1 : 0); }
  void add(const char* verb, double value) { put(verb, std::bit_cast<std::uint64_t>(value)); }
  void add(const char* verb, float value) { put(verb, std::bit_cast<std::uint32_t>(value)); }
  template <typename Derived>
  void add(const char* verb, const Eigen::MatrixBase<Derived>& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i)
      add(verb, values.derived().data()[i]);
  }
  template <typename Volume>
  requires std::is_constructible_v<AnyVolume, Volume>
  void add(const char* verb, const Volume& volume) {
    for (const double number : test::numbers(volume))
      add(verb, number);
  }
  void add(const char* verb, const std::vector<Vector3d>& points) {
    for (const Vector3d& p : points)
      add(verb, p);
  }
  void add(const char* verb, const Mesh& mesh) {
    add(verb, mesh.vertices);
    for (const auto& face : mesh.faces) {
      for (const std::int32_t corner : face)
        put(verb, static_cast<std::uint64_t>(corner));
    }
  }
  void add(const char* verb, const std::optional<RayInterval>& interval) {
    add(verb, interval.has_value());
    if (interval) add(verb, Eigen::Vector2d(interval->enter, interval->exit));
  }

  const std::vector<std::pair<std::string, std::uint64_t>>& bits() const { return bits_; }

 private:
  void put(const char* verb, std::uint64_t bits) { bits_.emplace_back(shape_ + ' ' + verb, bits); }

  std::string shape_;
  std::vector<std::pair<std::string, std::uint64_t>> bits_;
};

// Numbers that volumes are made of, and are asked about.
struct Numbers {
  Numbers(testing::Random& random, const Vector3d& size) : motion(random.isometry(1)) {
    const auto vector = [&] { return Vector3d(random.vector(1).cwiseProduct(size)); };
    for (Vector3d& p : points)
      p = vector();
    motion.translation() = vector();
    axes = random.isometry(1).linear();
    half = vector().cwiseAbs();
    // Nearly the coordinate axes where sizes are small: components that are denormal numbers.
    sheared << 1, points[1].x(), 0, points[0].x(), 1, 0, 0, points[2].x(), 1;
    tilted = orthonormal_axes(sheared);
    cube_side = size.x();
  }

  std::array<Vector3d, 6> points;
  Eigen::Isometry3d motion;
  Eigen::Matrix3d axes, sheared, tilted;
  Vector3d half;
  double cube_side;
};

template <typename Volume>
void record_common(const Volume& volume, const Volume& other, const Numbers& n, Record& record) {
  record.begin(shape_name(volume));
  record.add("construct", volume);
  for (const Vector3d& p : n.points) {
    record.add("contains", volume.contains(p));
    record.add("distance", volume.distance(p));
    record.add("support", volume.support(p));
    record.add("intersect", volume.intersect(p, n.points[0]));
    record.add("intersect from afar", volume.intersect(p, n.axes.col(0)));
  }
  record.add("volume", volume.volume());
  record.add("surface_area", volume.surface_area());
  record.add("center", Vector3d(volume.center()));
  record.add("aabb", volume.aabb());
  record.add("mesh", volume.mesh());
  record.add("transformed", volume.transformed(n.motion));
  record.add("==", volume == other);
}

void record_aabb(const Numbers& n, Record& record) {
  Aabb box(n.points[0], n.points[0]), other(-n.half, n.half);
  for (const Vector3d& p : n.points)
    box.extend(p);
  record_common(box, Aabb(box).merge(Aabb(n.points[5], n.points[5])), n, record);
  record_common(other, box, n, record);
  record.add("empty of crossing corners", Aabb(n.half, -n.half).empty());
  record.add("overlaps", box.overlaps(Aabb(n.half, n.half)));
  record.add("merge", Aabb(box).merge(other));
  record.add("cast_float", box.cast_float().min);
  record.add("cast_float", box.cast_float().max);
}

void record_kdop(const std::shared_ptr<const KdopSet>& set, const Numbers& n, Record& record) {
  Kdop kdop(set), other(set);
  for (const Vector3d& p : n.points)
    kdop.extend(p);
  other.extend(n.half).extend(n.points[0]);
  record_common(kdop, other, n, record);
  record.add("merge", Kdop(kdop).merge(other));
  record.add("overlaps", kdop.overlaps(other));
  record.add("overlaps", kdop.overlaps(Kdop(set).extend(n.half)));
  for (std::size_t i = 0; i < kdop.size(); ++i)
    record.add("width", kdop.width(i));
  record.add("corners", kdop.corners());
  record.add("tightened", Kdop(kdop).merge(other).tightened());
  record.add("from slabs", Kdop(set, kdop.min(), kdop.max()));
  const auto floats = kdop.cast_float();
  record.add("cast_float", floats.min);
  record.add("cast_float", floats.max);
}

void record_sphere(const Numbers& n, Record& record) {
  const Sphere sphere(n.points[0], n.half[0]), other(n.points[0], n.half[1]);
  record_common(sphere, other, n, record);
  Sphere grown = sphere;
  for (const Vector3d& p : n.points)
    record.add("extend", grown.extend(p));
  record.add("merge", Sphere(sphere).merge(Sphere(n.points[1], n.half[2])));
  record.add("overlaps", sphere.overlaps(Sphere(n.points[1], n.half[2])));
  record.add("cast_float", grown.cast_float().center);
  record.add("cast_float", grown.cast_float().radius);
  record.add("empty of a negative radius", Sphere(n.points[0], -n.half[0]).empty());
}

void record_obb(const Numbers& n, Record& record) {
  const Obb box(n.points[0], n.axes, n.half), turned(n.points[1], n.motion.linear(), n.half);
  record_common(box, Obb(n.points[1], n.axes, n.half), n, record);
  record.add("from_slabs", Obb::from_slabs(n.axes, n.points[0], -n.half, n.half));
  record.add("of an Aabb", Obb(Aabb(-n.half, n.half)));
  for (const Vector3d& corner : box.corners())
    record.add("corners", corner);
  record.add("merged", box.merged(turned));
  record.add("overlaps", box.overlaps(turned));
  record.add("canonical", turned.canonical());
  record.add("oriented_as", turned.oriented_as(box));
  const Obb tilted(n.points[1], n.tilted, n.half), upright(n.points[1], Eigen::Matrix3d::Identity(), n.half);
  record.add("oriented_as", tilted.oriented_as(upright));
  record.add("oriented_as", upright.oriented_as(tilted));
  record.add("quaternion", tilted.quaternion().coeffs());
  record.add("orthonormal_axes", orthonormal_axes(n.sheared));
  record.add("cast_float", box.cast_float().center);
  record.add("cast_float", box.cast_float().half_extents);
  record.add("empty of a negative size", Obb(n.points[0], n.axes, -n.half).empty());
}

void record_round(const Numbers& n, Record& record) {
  const Vector3d &a = n.points[0], &b = n.points[1], up = n.axes.col(0);
  record_common(Cylinder(a, up, n.half[0], n.half[1]), Cylinder(b, up, n.half[0], n.half[1]), n, record);
  record_common(Capsule(a, b, n.half[0]), Capsule(a, b, n.half[1]), n, record);
  record_common(Ellipsoid(a, n.axes, n.half), Ellipsoid(b, n.axes, n.half), n, record);
  record.add("empty of a negative radius", Cylinder(a, up, -n.half[0], n.half[1]).empty());
  record.add("empty of a negative radius", Capsule(a, b, -n.half[0]).empty());
  record.add("empty of a negative radius", Ellipsoid(a, n.axes, -n.half).empty());
}

// Corners rounded in the host would be others.
void record_hull(const Hull& cube, const Numbers& n, Record& record) {
  const Hull hull(cube.vertices(), cube.triangles(), cube.planes(), cube.rank());
  std::vector<Vector3d> others = cube.vertices();
  others[0] = n.points[1];
  record_common(hull, Hull(others, cube.triangles(), cube.planes(), cube.rank()), n, record);
}

// Sets whose directions differ by a denormal number only.
void record_kdop_sets(const Numbers& n, Record& record) {
  std::vector<Vector3d> directions{n.axes.col(0), n.axes.col(1), n.axes.col(2), {1, n.points[0].x(), 0}};
  const auto set = std::make_shared<const KdopSet>(directions);
  directions[3].y() = n.points[1].x();
  record.add("==", *set == KdopSet(directions));
  record_kdop(set, n, record);
}

Record record_all(const Numbers& n, const Hull& cube) {
  Record record;
  record_aabb(n, record);
  for (const auto& set : {KdopSet::dop6(), KdopSet::dop26()})
    record_kdop(set, n, record);
  record_kdop_sets(n, record);
  record_sphere(n, record);
  record_obb(n, record);
  record_round(n, record);
  record_hull(cube, n, record);
  return record;
}

// 1e-310 is a denormal number itself, some below 2e-308 are, 1e-41 is one of float; squares of 1e-157 and
// cubes of 1e-104 are denormal numbers, some squares of 1.5e-154; sizes may differ, too.
std::vector<Vector3d> sizes() {
  std::vector<Vector3d> all{{1e-310, 1, 1}, {1, 1e-310, 1e-310}, {1e-310, 1e60, 1e60}};
  for (const double size : {1e-310, 2e-308, 1e-157, 1.5e-154, 1e-104, 1e-41})
    all.push_back(Vector3d::Constant(size));
  return all;
}

TEST(FlushingHost, ChangesNoBitOfAnyVerb) {
  testing::Random random(kSeed);
  for (int round = 0; round < 20; ++round) {
    for (const Vector3d& size : sizes()) {
      const Numbers numbers(random, size);
      const Hull cube = testing::cube(numbers.points[0], numbers.cube_side);
      const Record expected = record_all(numbers, cube);
      const auto flushed = [&] {
        const test::FlushToZero host;
        return record_all(numbers, cube);
      }();
      ASSERT_EQ(flushed.bits().size(), expected.bits().size());
      for (std::size_t i = 0; i < expected.bits().size(); ++i) {
        ASSERT_EQ(flushed.bits()[i], expected.bits()[i])
            << "seed " << kSeed << ", round " << round << ", size " << size.transpose() << ", value " << i;
      }
    }
  }
}

TEST(FlushingHost, LosesNoPointThatAVolumeIsExtendedBy) {
  const Vector3d point(1e-310, -2e-310, 3e-310);
  const testing::ExactPoint exact = testing::exact(point);
  Aabb box;
  Kdop kdop;
  Sphere sphere;
  {
    const test::FlushToZero host;
    box.extend(Vector3d::Zero()).extend(point);
    kdop.extend(Vector3d::Zero()).extend(point);
    sphere.extend(Vector3d::Zero()).extend(point);
  }
  EXPECT_TRUE(testing::inside(box, exact));
  EXPECT_TRUE(testing::inside(kdop, exact));
  EXPECT_TRUE(testing::inside(kdop.tightened(), exact));
  EXPECT_TRUE(testing::inside(kdop.aabb(), exact));
  EXPECT_TRUE(testing::inside(sphere, exact));
}

}  // namespace
}  // namespace pcl_bv::detail
