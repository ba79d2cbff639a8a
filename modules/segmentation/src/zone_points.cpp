// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points are processed in batches. Each step runs for the whole batch before the next step, so that compilers
// vectorise all steps except look-ups.

#include "zone_points.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "vector_clones.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kBatch = 512;

// If the lowest point of a cell is this far below the lowest points of all cells around, the point is a
// reflection. Metres.
constexpr float pit_depth = 0.2F;

// An object stands in a cell if the cell has points this far above its lowest point, metres. Curbs are lower,
// and things that hang over a road are higher.
constexpr float object_from = 0.3F, object_to = 2;

// Clamps a value to the range of float.
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

// Calls put(x, n) for each point from `begin` to `end`. x is the address of the point's first coordinate; the
// coordinates are view.step() bytes apart. put() stores the point at position n and returns whether the point
// is valid. The next point overwrites an invalid one. Returns the number of valid points.
template <typename Put>
std::size_t load(const PointView& points, std::size_t begin, std::size_t end, std::int32_t* number,
                 const Put& put) {
  const PointView view = points;  // a local copy; the compiler need not reload its fields after each store
  std::size_t n = 0;
  for (std::size_t i = begin; i < end; ++i) {
    number[n] = static_cast<std::int32_t>(view.index(i));
    n += put(view.address(i), n);
  }
  return n;
}

// The arrays in which load() stores points.
struct LoadTarget {
  float *u, *v, *height;
  std::int32_t* number;
};

// Loads floats for an up direction along an axis and a sensor at the origin. In this case u, v and height are
// coordinates of the point, except for the sign of the height.
std::size_t load_upright(const PointView& view, std::size_t begin, std::size_t end, const ZoneFrame& frame,
                         const LoadTarget& to) {
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
std::size_t load_rotated(const PointView& view, std::size_t begin, std::size_t end, const ZoneFrame& frame,
                         const LoadTarget& to) {
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

PCL_BV_VECTOR_CLONES void find_cells(const float* u, const float* v, std::size_t count, float* range,
                                     std::uint16_t* cell) {
  for (std::size_t k = 0; k < count; ++k) {
    range[k] = range_of(u[k], v[k]);
    cell[k] = static_cast<std::uint16_t>(cell_of(range[k], angle_in_turns(u[k], v[k])));
  }
}

PCL_BV_VECTOR_CLONES void subtract_plane(const float* u, const float* v, std::size_t count,
                                         const Slope& plane, float* height) {
  const auto offset = static_cast<float>(plane.offset), slope_u = static_cast<float>(plane.slope_u),
             slope_v = static_cast<float>(plane.slope_v);
  for (std::size_t i = 0; i < count; ++i)
    height[i] -= offset + (u[i] * slope_u + v[i] * slope_v);
}

PCL_BV_VECTOR_CLONES void keep_lowest(const float* others, float* lowest) {
  for (std::size_t i = 0; i < cell_count; ++i)
    lowest[i] = std::min(lowest[i], others[i]);
}

PCL_BV_VECTOR_CLONES void add_objects(const std::uint8_t* others, std::uint8_t* has_object) {
  for (std::size_t i = 0; i < cell_count; ++i)
    has_object[i] |= others[i];
}

}  // namespace

GroundPoint ZoneFrame::point(const Coordinates& p) const {
  const double relative[3] = {p.x - sensor.x(), p.y - sensor.y(), p.z - sensor.z()};
  if (along_axis) {  // saves sums with zeros, 2 % of the time of a sweep
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

void ZonePoints::read_part(const PointView& view, const ZoneFrame& frame, ZonePart& part) {
  const bool is_float = view.scalar == ScalarType::float32;
  const bool upright = is_float && frame.along_axis && frame.sensor.isZero(0);
  const auto load_batch = upright ? load_upright : is_float ? load_rotated<float> : load_rotated<double>;
  std::size_t to = part.begin;
  for (std::size_t i = part.begin; i < part.end; i += kBatch) {
    const LoadTarget batch{u_.data() + to, v_.data() + to, height.data() + to, number.data() + to};
    const std::size_t count = load_batch(view, i, std::min(i + kBatch, part.end), frame, batch);
    float* const ranges = range.data() + to;
    std::uint16_t* const cells = cell.data() + to;
    find_cells(batch.u, batch.v, count, ranges, cells);
    to += count;
  }
  part.valid = to - part.begin;
}

void ZonePoints::read(const PointView& view, const ZoneFrame& frame, const ParallelPolicy& policy) {
  u_.resize(view.count);
  v_.resize(view.count);
  height.resize(view.count);
  range.resize(view.count);
  cell.resize(view.count);
  number.resize(view.count);
  parts.cut(view.count, policy);
  parts.for_each(policy, [&](ZonePart& part) { read_part(view, frame, part); });
}

void ZonePoints::list_near(std::size_t rings, const ParallelPolicy& policy,
                           std::vector<std::int32_t>& numbers) {
  numbers.resize(number.size());
  parts.for_each(policy, [&](ZonePart& part) {
    std::size_t to = part.begin;
    for (std::size_t i = part.begin; i < part.begin + part.valid; ++i) {
      numbers[to] = number[i];
      to += cell[i] < rings * sector_count;
    }
    part.listed = to - part.begin;
  });
  numbers.resize(join_lists(parts, numbers, [](const ZonePart& part) { return part.listed; }));
}

void ZonePoints::find_lowest(const Slope& plane, ZonePart& part) {
  std::vector<float>& lowest = part.cells.lowest;
  lowest.assign(cell_count, no_lowest);
  subtract_plane(u_.data() + part.begin, v_.data() + part.begin, part.valid, plane,
                 height.data() + part.begin);
  for (std::size_t i = part.begin; i < part.begin + part.valid; ++i)
    lowest[cell[i]] = std::min(lowest[cell[i]], height[i]);
}

PCL_BV_VECTOR_CLONES void ZonePoints::fill_pits() {
  float* const lowest = parts.front().cells.lowest.data();
  RingRow before, here, after;
  before.fill(no_lowest);
  here.copy(lowest);
  for (std::size_t ring = 0; ring + 1 < ring_count; ++ring) {
    after.copy(lowest + (ring + 1) * sector_count);
    float* const own = lowest + ring * sector_count;
    for (std::size_t s = 0; s < sector_count; ++s) {
      const float left = std::min(before[s], std::min(here[s], after[s]));
      const float right = std::min(before[s + 2], std::min(here[s + 2], after[s + 2]));
      const float around = std::min(std::min(left, right), std::min(before[s + 1], after[s + 1]));
      own[s] = here[s + 1] < around - pit_depth && around < no_lowest ? around : here[s + 1];
    }
    before = here;
    here = after;
  }
}

void ZonePoints::find_objects(const std::vector<float>& lowest, ZonePart& part) const {
  std::vector<std::uint8_t>& has_object = part.cells.has_object;
  has_object.assign(cell_count, 0);
  for (std::size_t i = part.begin; i < part.begin + part.valid; ++i) {
    const float over = height[i] - lowest[cell[i]];
    has_object[cell[i]] |= static_cast<std::uint8_t>((over > object_from) & (over < object_to));
  }
}

void ZonePoints::measure_from(const Slope& plane, const ParallelPolicy& policy) {
  parts.for_each(policy, [&](ZonePart& part) { find_lowest(plane, part); });
  CellSummary& all = parts.front().cells;
  for (const ZonePart& part : parts)
    keep_lowest(part.cells.lowest.data(), all.lowest.data());
  fill_pits();
  parts.for_each(policy, [&](ZonePart& part) { find_objects(all.lowest, part); });
  for (const ZonePart& part : parts)
    add_objects(part.cells.has_object.data(), all.has_object.data());
}

}  // namespace pcl_bv::detail
