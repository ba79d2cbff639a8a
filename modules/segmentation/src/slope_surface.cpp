// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/slope_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "ground_checks.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "slope_cells.h"
#include "up_frame.h"

namespace pcl_bv::detail {
namespace {

void check(const GroundSlopeOptions& options) {
  constexpr const char* who = "ground by slope";
  check_ground(who, options.distance, options.max_slope_degrees, {});
  require(options.cell_size >= 0.01 && options.cell_size <= 1000, who, "cell_size", options.cell_size,
          "0.01 to 1000");
}

// Returns the rise of the maximum slope over a cell. The last bit of a tangent depends on the processor, so
// it is rounded to float.
double rise_of(const GroundSlopeOptions& options) {
  const auto slope = static_cast<float>(std::tan(options.max_slope_degrees * std::numbers::pi / 180));
  return double{slope} * options.cell_size;
}

// A point in the grid. The position in its cell is from -0.5 to 0.5.
struct GridPoint {
  CellPosition cell;
  double in_cell_x, in_cell_y, height;
};

// Returns the cell of a coordinate in units of the cells' side. Cells at the border of the grid hold all
// points beyond.
std::int32_t cell_of(double coordinate) {
  constexpr double min = std::numeric_limits<std::int32_t>::min(),
                   max = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::floor(coordinate), min, max));
}

// The lowest points of a chunk. Consecutive points in the same cell are one entry.
struct Lows {
  std::vector<std::pair<CellPosition, double>> runs;
  std::size_t valid = 0;

  void add(const GridPoint& p) {
    ++valid;
    const bool same = !runs.empty() && runs.back().first.x == p.cell.x && runs.back().first.y == p.cell.y;
    if (!same) {
      runs.emplace_back(p.cell, p.height);
    } else {
      runs.back().second = std::min(runs.back().second, p.height);
    }
  }
};

}  // namespace

bool CellRange::intersects(const CellRange& other) const {
  return !empty() && !other.empty() && min_x <= other.max_x && max_x >= other.min_x && min_y <= other.max_y &&
         max_y >= other.min_y;
}

void CellRange::merge(const CellRange& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  min_x = std::min(min_x, other.min_x);
  min_y = std::min(min_y, other.min_y);
  max_x = std::max(max_x, other.max_x);
  max_y = std::max(max_y, other.max_y);
}

CellRange CellRange::inflated(double cells) const {
  if (empty()) return {};
  return {cell_of(min_x - cells), cell_of(min_y - cells), cell_of(max_x + cells), cell_of(max_y + cells)};
}

// The surface in a cell is the lowest of the cones on the cells that are no outliers. In the range and next
// to it, it is at most `highest` plus the rise over kFarFromOutlier cells: a cell is the source of a cone
// itself, or there is a source at most so far away. A cone that is farther away than `max_distance` is not
// lower. Whether a cell is an outlier depends on cells within kFarFromOutlier, and on the sizes of their
// patches up to kPatchCells cells, each at most kLinkedCells from the one before.
CellRange cells_that_matter(const CellRange& range, double lowest, double highest,
                            const GroundSlopeOptions& options) {
  const FloatEnvironment environment;
  static_assert(kBoundMargin >= kFarFromOutlier + 1);
  const double rise = rise_of(options), difference = std::max(highest - lowest, 0.0);
  const double max_distance = difference > 0 ? kFarFromOutlier + difference / rise : kFarFromOutlier;
  constexpr int for_outliers = kFarFromOutlier + kPatchCells * kLinkedCells;
  return range.inflated(max_distance + for_outliers + 2);  // the neighbours of cells, and roundings
}

struct LowestPoints::State {
  explicit State(const GroundSlopeOptions& options)
      : frame(options.up), cell_size(options.cell_size), distance(options.distance), rise(rise_of(options)) {}

  GridPoint point(const Coordinates& p) const {
    const Eigen::Vector3d at{p.x, p.y, p.z};
    const double x = dot3(frame.u, at) / cell_size, y = dot3(frame.v, at) / cell_size;
    const CellPosition cell{cell_of(x), cell_of(y)};
    return {cell, std::clamp(x - cell.x - 0.5, -0.5, 0.5), std::clamp(y - cell.y - 0.5, -0.5, 0.5),
            dot3(frame.up, at)};
  }

  void read(const PointView& points, const ParallelPolicy& policy) {
    std::mutex mutex;
    for_each_chunk(policy, chunk_count(points.count), [&](std::size_t chunk) {
      const LoadedPoints part = load_chunk(points, chunk);
      Lows lows;
      for (std::size_t i = 0; i < part.view().count; ++i) {
        const Coordinates p = load_point(part.view(), i);
        if (is_valid(p)) lows.add(point(p));
      }
      const std::lock_guard lock(mutex);
      valid += lows.valid;
      for (const auto& [cell, height] : lows.runs)
        cells.add(cell, height);
    });
  }

  UpFrame frame;
  double cell_size, distance, rise;
  SlopeCells cells;
  std::size_t valid = 0;
};

LowestPoints::LowestPoints(const GroundSlopeOptions& options) {
  const FloatEnvironment environment;
  check(options);
  state_ = std::make_unique<State>(options);
}

LowestPoints::~LowestPoints() = default;
LowestPoints::LowestPoints(LowestPoints&&) noexcept = default;
LowestPoints& LowestPoints::operator=(LowestPoints&&) noexcept = default;

void LowestPoints::add(const PointView& points, const ParallelPolicy& policy) {
  const FloatEnvironment environment;
  state_->read(points, policy);
}

void LowestPoints::add(const LowestPoint& point) {
  state_->cells.add({point.x, point.y}, point.height);
}

std::size_t LowestPoints::valid_points() const {
  return state_->valid;
}

std::size_t LowestPoints::size() const {
  return state_->cells.size();
}

LowestPoint LowestPoints::operator[](std::size_t cell) const {
  const SlopeCell& found = state_->cells[cell];
  return {found.at.x, found.at.y, found.height};
}

SlopeSurface::SlopeSurface(const PointView& points, const GroundSlopeOptions& options,
                           const Execution& execution) {
  LowestPoints lowest(options);
  lowest.add(points, execution.parallel);
  *this = SlopeSurface(std::move(lowest), execution);
}

SlopeSurface::SlopeSurface(LowestPoints lowest, const Execution& execution)
    : state_(std::move(lowest.state_)) {
  const FloatEnvironment environment;
  find_envelope(low_outliers(state_->cells, state_->rise, state_->distance, execution.parallel), state_->rise,
                execution.parallel, state_->cells);
  find_rises(execution.parallel, state_->cells);
}

SlopeSurface::~SlopeSurface() = default;
SlopeSurface::SlopeSurface(SlopeSurface&&) noexcept = default;
SlopeSurface& SlopeSurface::operator=(SlopeSurface&&) noexcept = default;

std::size_t SlopeSurface::valid_points() const {
  return state_->valid;
}

std::size_t SlopeSurface::cell_count() const {
  return state_->cells.size();
}

// The lowest point of a cell on a slope is half a rise below the centre, along each axis. So the plane
// through the height of the cell is raised by half its rises.
std::size_t SlopeSurface::classify(const PointView& points, std::uint8_t* ground) const {
  const FloatEnvironment environment;
  const SlopeCell* cell = nullptr;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates coordinates = load_point(points, i);
    ground[i] = 0;
    if (!is_valid(coordinates)) continue;
    const GridPoint p = state_->point(coordinates);
    if (cell == nullptr || cell->at.x != p.cell.x || cell->at.y != p.cell.y) {
      const std::optional<std::uint32_t> number = state_->cells.find(p.cell);
      if (!number) {
        ++outside;
        continue;
      }
      cell = &state_->cells[*number];
    }
    const double x = cell->rise_x, y = cell->rise_y;
    const double surface =
        (cell->height + 0.5 * (std::abs(x) + std::abs(y))) + (x * p.in_cell_x + y * p.in_cell_y);
    ground[i] = p.height - surface <= state_->distance ? 1 : 0;
  }
  return outside;
}

}  // namespace pcl_bv::detail
