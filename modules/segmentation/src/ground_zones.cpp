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
#include "pcl_bv/numeric/float_environment.h"
#include "zone_points.h"

namespace pcl_bv {
namespace {

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

// The gap between neighbours, which the ground may climb.
double gate_of(std::size_t ring) {
  if (ring == 0) return inner_gate;
  const double inner = ring > 1 ? rings[ring - 2].outer : 0;
  return std::min(max_gate, inner_gate + gate_growth * 0.5 * (rings[ring].outer - inner));
}

// From patch to patch outwards there are trees, one for each patch of the innermost ring.
constexpr std::size_t tree_count = rings[0].sectors;

struct PatchLink {
  std::uint16_t ring, inner, tree;
};

constexpr std::array<PatchLink, patch_count> links = [] {
  std::array<PatchLink, patch_count> all{};
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    for (unsigned sector = 0; sector < rings[ring].sectors; ++sector) {
      const std::size_t i = first_patch[ring] + sector;
      const std::size_t inner =
          ring == 0 ? i : first_patch[ring - 1] + sector * rings[ring - 1].sectors / rings[ring].sectors;
      all[i] = {static_cast<std::uint16_t>(ring), static_cast<std::uint16_t>(inner),
                ring == 0 ? static_cast<std::uint16_t>(i) : all[inner].tree};
    }
  }
  return all;
}();

}  // namespace

struct GroundZones::Scratch : ZonePoints {
  std::vector<float> over;           // Of each point above its patch's plane, metres.
  std::vector<std::uint8_t> stands;  // Of each point, whether it is so high.
  std::array<Slope, patch_count> planes;
  std::array<std::vector<double>, tree_count> heights;  // Room for the fits of each tree.

  std::optional<Plane> central_plane(const PointView& view, const GroundZonesSettings& settings,
                                     GroundScratch& sample) const {
    GroundPlaneSettings search;
    search.up = settings.up;
    search.max_slope_degrees = settings.max_slope_degrees;
    search.sensor_height = settings.sensor_height;
    search.seed = settings.seed;
    search.iterations = plane_tries;
    PointView near = view;
    near.indices = sorted.number.data();
    if (view.order == PointOrder::records && !view.indices) near.data = view.data - view.stride * view.first;
    for (const std::size_t ring_count : central_rings) {
      near.count = begin[first_patch[ring_count]];
      if (auto plane = find_ground_plane(near, settings.sensor, search, sample)) return plane;
    }
    return {};
  }

  // What the inner neighbour's plane says, but less tilted against the central one: tilts go on, but their
  // errors must not grow with the distance.
  Slope expect(std::size_t inner, const Slope& central) const {
    const Slope& plane = planes[inner];
    const PatchCenter& center = patch_centers[inner];
    Slope expected{0, plane.slope_u + tilt_loss * (central.slope_u - plane.slope_u),
                   plane.slope_v + tilt_loss * (central.slope_v - plane.slope_v)};
    expected.offset = plane.height(center.u, center.v) - expected.height(center.u, center.v);
    return expected;
  }

  void fit(const Slope& central, double max_slope, const ParallelPolicy& policy) {
    for_each_chunk(policy, tree_count, [&](std::size_t tree) {
      const FloatEnvironment environment;
      std::vector<double>& above = heights[tree];
      for (std::size_t i = tree; i < patch_count; ++i) {
        const auto [ring, inner, of] = links[i];
        if (of != tree) continue;
        const Slope expected = ring == 0 ? central : expect(inner, central);
        planes[i] = fit_patch(patch(i), expected, gate_of(ring), max_slope, above).value_or(expected);
      }
    });
  }

  void find_heights(ZonePart& part) {
    const FloatEnvironment environment;
    part.for_each_run([&](std::uint16_t patch, std::uint32_t from, std::uint32_t count) {
      const Slope plane = planes[patch];
      const float *u = points.u.data() + from, *v = points.v.data() + from;
      const float* height = points.height.data() + from;
      float* out = over.data() + from;
      std::uint8_t* high = stands.data() + from;
      for (std::size_t i = 0; i < count; ++i) {
        const double clearance = height[i] - plane.height(u[i], v[i]);
        out[i] = static_cast<float>(clearance);
        high[i] = clearance > upright_from && clearance < upright_to;
      }
    });
    part.upright.assign(cell_rings * cell_sectors, 0);
    for (std::size_t i = part.begin; i < part.begin + part.kept; ++i)
      if (stands[i] != 0) part.upright[cell[i]] = 1;
  }

  // What stands in a cell is what any part says.
  void find_upright(const ParallelPolicy& policy) {
    over.resize(points.u.size());
    stands.resize(over.size());
    parts.for_each(policy, [&](ZonePart& part) { find_heights(part); });
    std::vector<std::uint8_t>& all = parts.front().upright;
    for (const ZonePart& part : parts) {
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] |= part.upright[i];
    }
  }

  void classify(const std::optional<Plane>& central, double distance, GroundSplit& split) const {
    const std::array<float, 2> limit{static_cast<float>(distance), static_cast<float>(foot_share * distance)};
    const std::vector<std::uint8_t>& upright = parts.front().upright;
    write_split(central, begin.back(), split, [&](const auto& put) {
      for (const ZonePart& part : parts) {
        for (std::size_t i = part.begin; i < part.begin + part.kept; ++i)
          put(points.number[i], central && over[i] <= limit[upright[cell[i]]]);
      }
    });
  }
};

GroundZones::GroundZones() = default;
GroundZones::~GroundZones() = default;
GroundZones::GroundZones(GroundZones&&) noexcept = default;
GroundZones& GroundZones::operator=(GroundZones&&) noexcept = default;

void GroundZones::split(const PointView& points, const GroundZonesSettings& settings, GroundSplit& split,
                        const ParallelPolicy& policy) {
  const FloatEnvironment environment;
  check(settings);
  check_numbers(points);
  if (!scratch_) scratch_ = std::make_unique<Scratch>();
  const ZoneFrame frame(settings.up, settings.sensor);
  scratch_->read(points, frame, policy);
  std::optional<Plane> central = scratch_->central_plane(points, settings, split.scratch);
  if (!central && settings.sensor_height) central = frame.level(*settings.sensor_height);
  if (central) {
    scratch_->fit(frame.slope(*central), std::tan(settings.max_slope_degrees * std::numbers::pi / 180),
                  policy);
    scratch_->find_upright(policy);
  }
  scratch_->classify(central, settings.distance, split);
}

}  // namespace pcl_bv
