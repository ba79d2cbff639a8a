// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// In batches, a step after the other for all points of one: so compilers make vectors of all steps but those
// that look something up.

#include "zone_points.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kBatch = 512;

// Doubles may be greater than any float.
float in_float(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -largest, largest));
}

template <typename T>
T load_coordinate(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

// Calls put(x, n), where a point's coordinates are, `view.step()` bytes apart, for each of some points. It
// puts what the zones see at n, and says whether that is a valid point, which stays. Returns how many do.
template <typename Put>
std::size_t load(const PointView& points, std::size_t begin, std::size_t end, std::int32_t* number,
                 const Put& put) {
  const PointView view = points;  // of this loop only: not read again after each store
  std::size_t n = 0;
  for (std::size_t i = begin; i < end; ++i) {
    number[n] = static_cast<std::int32_t>(view.index(i));
    n += put(view.address(i), n);
  }
  return n;
}

// Where some points go.
struct Place {
  float *u, *v, *height;
  std::int32_t* number;
};

// Coordinates that the zones take as they are, but for the sign of one.
std::size_t load_upright(const PointView& view, std::size_t begin, std::size_t end, const ZoneFrame& frame,
                         const Place& to) {
  const std::size_t step = view.step();
  const std::size_t u_at = (frame.nearest + 1) % 3 * step, v_at = (frame.nearest + 2) % 3 * step;
  const std::size_t height_at = static_cast<std::size_t>(frame.nearest) * step;
  const float sign = frame.up[frame.nearest] < 0 ? -1.F : 1.F;
  return load(view, begin, end, to.number, [=, out = to](const std::byte* x, std::size_t n) {
    const auto u = load_coordinate<float>(x + u_at), v = load_coordinate<float>(x + v_at);
    const float height = sign * load_coordinate<float>(x + height_at);
    out.u[n] = u;
    out.v[n] = v;
    out.height[n] = height;
    return 0 * u + 0 * v + 0 * height == 0;
  });
}

template <typename T>
std::size_t load_turned(const PointView& view, std::size_t begin, std::size_t end, const ZoneFrame& frame,
                        const Place& to) {
  const std::size_t step = view.step();
  return load(view, begin, end, to.number, [&](const std::byte* x, std::size_t n) {
    const Coordinates p{load_coordinate<T>(x), load_coordinate<T>(x + step),
                        load_coordinate<T>(x + 2 * step)};
    const GroundPoint seen = frame.point(p);
    to.u[n] = seen.u;
    to.v[n] = seen.v;
    to.height[n] = seen.height;
    return is_valid(p);
  });
}

struct Polar {
  std::array<std::int32_t, kBatch> half_metres;
  std::array<float, kBatch> turn;
};

void find_polar(const Place& points, std::size_t count, Polar& polar) {
  for (std::size_t i = 0; i < count; ++i) {
    polar.half_metres[i] = half_metres_of(points.u[i], points.v[i]);
    polar.turn[i] = turn_of(points.u[i], points.v[i]);
  }
}

}  // namespace

GroundPoint ZoneFrame::point(const Coordinates& p) const {
  const double relative[3] = {p.x - sensor.x(), p.y - sensor.y(), p.z - sensor.z()};
  if (along_axis) {  // The sums below would take 2 % of the time of a sweep to add zeros.
    return {in_float(relative[(nearest + 1) % 3]), in_float(relative[(nearest + 2) % 3]),
            in_float(up[nearest] * relative[nearest])};
  }
  return {in_float(dot3(relative, u)), in_float(dot3(relative, v)), in_float(dot3(relative, up))};
}

Slope ZoneFrame::slope(const Plane& plane) const {
  const double vertical = dot3(plane.normal, up);
  return {-height_above(plane, sensor) / vertical, -dot3(plane.normal, u) / vertical,
          -dot3(plane.normal, v) / vertical};
}

Plane ZoneFrame::level(double height) const {
  return {up, dot3(up, sensor) - height};
}

void ZoneColumns::resize(std::size_t count) {
  u.resize(count);
  v.resize(count);
  height.resize(count);
  number.resize(count);
}

void ZoneColumns::copy(const ZoneColumns& from, std::size_t begin, std::size_t count, std::size_t to) {
  std::copy_n(from.u.data() + begin, count, u.data() + to);
  std::copy_n(from.v.data() + begin, count, v.data() + to);
  std::copy_n(from.height.data() + begin, count, height.data() + to);
  std::copy_n(from.number.data() + begin, count, number.data() + to);
}

void ZonePoints::place_points(const PointView& view, const ZoneFrame& frame, ZonePart& part) {
  const FloatEnvironment environment;
  const bool is_float = view.scalar == ScalarType::float32;
  const bool upright = is_float && frame.along_axis && frame.sensor.isZero(0);
  const auto load_batch = upright ? load_upright : is_float ? load_turned<float> : load_turned<double>;
  part.runs.clear();
  Polar polar;
  std::size_t to = part.begin;
  std::size_t last = patch_count;  // that of no point
  for (std::size_t i = part.begin; i < part.end; i += kBatch) {
    const Place batch{points.u.data() + to, points.v.data() + to, points.height.data() + to,
                      points.number.data() + to};
    const std::size_t count = load_batch(view, i, std::min(i + kBatch, part.end), frame, batch);
    find_polar(batch, count, polar);
    for (std::size_t k = 0; k < count; ++k, ++to) {
      const ZonePlace at = place_of(polar.half_metres[k], polar.turn[k]);
      cell[to] = at.cell;
      if (at.patch == last) continue;
      last = at.patch;
      part.runs.push_back({at.patch, static_cast<std::uint32_t>(to)});
    }
  }
  part.runs.push_back({0, static_cast<std::uint32_t>(to)});
  part.kept = to - part.begin;
  part.next.fill(0);
  part.for_each_run(
      [&](std::uint16_t patch, std::uint32_t, std::uint32_t count) { part.next[patch] += count; });
}

void ZonePoints::sort(ZonePart& part) {
  part.for_each_run([&](std::uint16_t patch, std::uint32_t from, std::uint32_t count) {
    sorted.copy(points, from, count, part.next[patch]);
    part.next[patch] += count;
  });
}

void ZonePoints::read(const PointView& view, const ZoneFrame& frame, const ParallelPolicy& policy) {
  points.resize(view.count);
  cell.resize(view.count);
  parts.cut(view.count, policy);
  parts.for_each(policy, [&](ZonePart& part) { place_points(view, frame, part); });
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < patch_count; ++i) {
    begin[i] = end;
    for (ZonePart& part : parts)
      end += std::exchange(part.next[i], end);
  }
  begin[patch_count] = end;
  sorted.resize(end);
  parts.for_each(policy, [&](ZonePart& part) { sort(part); });
}

}  // namespace pcl_bv
