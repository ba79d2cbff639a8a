// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/ground_zones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "ground_checks.h"
#include "patch_fit.h"
#include "pcl_bv/numeric/float_environment.h"
#include "plane_search.h"
#include "up_frame.h"
#include "zones.h"

namespace pcl_bv {
namespace {

using Eigen::Vector3d;

// The plane around the sensor is sought within 12.5 m, where the ground is seen best and bends least; if
// there is none, within 25 m, then everywhere.
constexpr std::array<std::size_t, 3> central_rings{4, 7, rings.size()};
constexpr unsigned plane_tries = 300;  // 100 and 1000 gave the same plane on synth:street
constexpr double inner_gate = 0.4;     // metres, of the innermost ring against the plane around the sensor
constexpr double gate_growth = 0.05;   // metres per metre from the inner neighbour
constexpr double max_gate = 0.7;       // metres; bonnets are higher

constexpr double tilt_loss = 0.15;  // from ring to ring

// In cells where something stands, points up to a fifth of the distance are ground: else the feet of walls,
// hedges and cars, two of a hundred points in a street, would be, too.
constexpr double upright_from = 0.3, upright_to = 2;  // metres above the plane
constexpr double foot_share = 0.2;

void check(const GroundZonesSettings& settings) {
  constexpr const char* who = "ground zones";
  check_ground(who, settings.distance, settings.max_slope_degrees, settings.sensor_height);
  for (int axis = 0; axis < 3; ++axis) {
    require(std::abs(settings.sensor[axis]) <= kMaxCoordinate, who, "sensor", settings.sensor[axis],
            "finite");
  }
}

// The cloud as seen by the zones.
struct Frame : UpFrame {
  Vector3d sensor;

  explicit Frame(const GroundZonesSettings& settings) : UpFrame(settings.up), sensor(settings.sensor) {}

  GroundPoint point(const Coordinates& p) const {
    const double relative[3] = {p.x - sensor.x(), p.y - sensor.y(), p.z - sensor.z()};
    if (along_axis) {  // The sums below would take 2 % of the time of a sweep to add zeros.
      return {in_float(relative[(nearest + 1) % 3]), in_float(relative[(nearest + 2) % 3]),
              in_float(up[nearest] * relative[nearest])};
    }
    return {in_float(dot3(relative, u)), in_float(dot3(relative, v)), in_float(dot3(relative, up))};
  }

  // Doubles may be greater than any float.
  static float in_float(double value) {
    constexpr double largest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -largest, largest));
  }

  Slope slope(const Plane& plane) const {
    const double vertical = dot3(plane.normal, up);
    return {-height_above(plane, sensor) / vertical, -dot3(plane.normal, u) / vertical,
            -dot3(plane.normal, v) / vertical};
  }

  Plane level(double height) const { return {up, dot3(up, sensor) - height}; }
};

// The gap between neighbours, which the ground may climb.
double gate_of(std::size_t ring) {
  if (ring == 0) return inner_gate;
  const double inner = ring > 1 ? rings[ring - 2].outer : 0;
  return std::min(max_gate, inner_gate + gate_growth * 0.5 * (rings[ring].outer - inner));
}

std::size_t inner_neighbour(std::size_t ring, unsigned sector) {
  return first_patch[ring - 1] + sector * rings[ring - 1].sectors / rings[ring].sectors;
}

}  // namespace

struct GroundZones::Scratch {
  std::vector<GroundPoint> points, sorted;  // Valid ones in the order of the view; patch by patch.
  std::vector<std::int32_t> numbers, sorted_numbers;
  std::vector<ZonePlace> place;       // Of each of `points`.
  std::vector<float> above;           // Their patch's plane, metres.
  std::vector<std::uint8_t> upright;  // By cell, whether something stands there.
  std::array<std::uint32_t, patch_count + 1> begin;
  std::array<Slope, patch_count> planes;

  void read(const PointView& view, const Frame& frame) {
    points.resize(view.count);
    numbers.resize(view.count);
    place.resize(view.count);
    begin.fill(0);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < view.count; ++i) {
      const Coordinates p = load_point(view, i);
      if (!is_valid(p)) continue;
      points[kept] = frame.point(p);
      numbers[kept] = static_cast<std::int32_t>(view.index(i));
      place[kept] = place_of(points[kept].u, points[kept].v);
      ++begin[place[kept].patch + 1];
      ++kept;
    }
    points.resize(kept);
    numbers.resize(kept);
    place.resize(kept);
  }

  void sort() {
    std::array<std::uint32_t, patch_count> next;
    for (std::size_t i = 0; i < patch_count; ++i) {
      begin[i + 1] += begin[i];
      next[i] = begin[i];
    }
    sorted.resize(points.size());
    sorted_numbers.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t to = next[place[i].patch]++;
      sorted[to] = points[i];
      sorted_numbers[to] = numbers[i];
    }
  }

  std::optional<Plane> central_plane(const PointView& view, const GroundZonesSettings& settings,
                                     GroundScratch& sample) const {
    GroundPlaneSettings search;
    search.up = settings.up;
    search.max_slope_degrees = settings.max_slope_degrees;
    search.sensor_height = settings.sensor_height;
    search.seed = settings.seed;
    search.iterations = plane_tries;
    PointView near = view;
    near.indices = sorted_numbers.data();
    if (view.order == PointOrder::records && !view.indices) near.data = view.data - view.stride * view.first;
    for (const std::size_t ring_count : central_rings) {
      near.count = begin[first_patch[ring_count]];
      if (auto plane = find_ground_plane(near, settings.sensor, search, sample)) return plane;
    }
    return {};
  }

  // What the inner neighbour's plane says, but less tilted against the central one: tilts go on, but their
  // errors must not grow with the distance.
  Slope expect(std::size_t ring, unsigned sector, const Slope& central) const {
    const std::size_t inner = inner_neighbour(ring, sector);
    const Slope& plane = planes[inner];
    const PatchCenter& center = patch_centers[inner];
    Slope expected{0, plane.slope_u + tilt_loss * (central.slope_u - plane.slope_u),
                   plane.slope_v + tilt_loss * (central.slope_v - plane.slope_v)};
    expected.offset = plane.height(center.u, center.v) - expected.height(center.u, center.v);
    return expected;
  }

  void fit(const Slope& central, double max_slope) {
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
      for (unsigned sector = 0; sector < rings[ring].sectors; ++sector) {
        const std::size_t i = first_patch[ring] + sector;
        const Patch seen{sorted.data() + begin[i], begin[i + 1] - begin[i], patch_centers[i].u,
                         patch_centers[i].v};
        const Slope expected = ring == 0 ? central : expect(ring, sector, central);
        planes[i] = fit_patch(seen, expected, gate_of(ring), max_slope).value_or(expected);
      }
    }
  }

  void find_upright() {
    above.resize(points.size());
    upright.assign(cell_rings * cell_sectors, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double height = points[i].height - planes[place[i].patch].height(points[i].u, points[i].v);
      above[i] = static_cast<float>(height);
      upright[place[i].cell] |= height > upright_from && height < upright_to;
    }
  }

  void classify(const std::optional<Plane>& central, double distance, GroundSplit& split) const {
    const std::array<float, 2> limit{static_cast<float>(distance), static_cast<float>(foot_share * distance)};
    write_split(central, points.size(), split, [&](const auto& put) {
      for (std::size_t i = 0; i < points.size(); ++i)
        put(numbers[i], central && above[i] <= limit[upright[place[i].cell]]);
    });
  }
};

GroundZones::GroundZones() = default;
GroundZones::~GroundZones() = default;
GroundZones::GroundZones(GroundZones&&) noexcept = default;
GroundZones& GroundZones::operator=(GroundZones&&) noexcept = default;

void GroundZones::split(const PointView& points, const GroundZonesSettings& settings, GroundSplit& split) {
  const FloatEnvironment environment;
  check(settings);
  check_numbers(points);
  if (!scratch_) scratch_ = std::make_unique<Scratch>();
  const Frame frame(settings);
  scratch_->read(points, frame);
  scratch_->sort();
  std::optional<Plane> central = scratch_->central_plane(points, settings, split.scratch);
  if (!central && settings.sensor_height) central = frame.level(*settings.sensor_height);
  if (central) {
    scratch_->fit(frame.slope(*central), std::tan(settings.max_slope_degrees * std::numbers::pi / 180));
    scratch_->find_upright();
  }
  scratch_->classify(central, settings.distance, split);
}

}  // namespace pcl_bv
