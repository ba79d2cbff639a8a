// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "region_runs.h"

#include <array>
#include <utility>

#include "pcl_bv/kernels/run_boxes.h"
#include "pcl_bv/points/point_source.h"
#include "spatial_order.h"

namespace pcl_bv::detail {
namespace {

using Chosen = std::vector<std::uint32_t>;

// Costs per point. The unit is the test of a point against one region of the complete list (0.16 ns with
// AVX-512, 0.5 ns with SSE4).
// - kChooseCost is for finding the regions whose boxes overlap the run of the point.
// - kTestChosenCost is for testing the point against one of these regions.
// - kSortCost is for sorting the points (25 ns) and for the steps after the sort.
constexpr double kChooseCost = 6, kTestChosenCost = 1.6, kSortCost = 150;
constexpr std::size_t kRunsOfSample = 16;

void choose(const VolumeBoxes& boxes, const RunBox& run, Chosen& chosen) {
  chosen.clear();
  if (!(run.low[0] <= run.high[0] && run.low[1] <= run.high[1] && run.low[2] <= run.high[2])) return;
  const BoxQuery query =
      boxes.query({run.low[0], run.low[1], run.low[2]}, {run.high[0], run.high[1], run.high[2]});
  boxes.visit(query, [&](std::uint32_t index) {
    chosen.push_back(index);
    return false;
  });
}

struct Runs {
  std::array<RunBox, kChunkPoints / kRunPoints> boxes;
  std::size_t count;
  Chosen chosen, next;  // lists of regions

  void measure(UsableIsa isa, const PointView& points) {
    run_boxes(isa, points, boxes.data());
    count = (points.count + kRunPoints - 1) / kRunPoints;
  }
};

// The valid points of a chunk, sorted.
template <typename T>
struct SortedPoints {
  SpatialOrder<T> order;
  std::vector<std::uint8_t> states;

  // Loads and sorts the points. Returns the number of valid points.
  std::size_t load(const PointView& points) {
    PositionedItem<T>* const items = order.reset(points.count);
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
      PositionedItem<T>& item = items[count];
      load_point(points, i, item.position);
      item.index = static_cast<std::int32_t>(i);
      count += is_valid({item.position[0], item.position[1], item.position[2]});
    }
    order.sort(count, Serial{});
    return count;
  }
};

// Buffers that each thread retains, because allocating a megabyte takes longer than the work on it.
struct Scratch {
  Runs runs;
  SortedPoints<float> floats;
  SortedPoints<double> doubles;
};

Scratch& scratch() {
  thread_local Scratch reused;
  return reused;
}

// Estimates the mean number of regions whose boxes overlap a run, from a sample of the runs.
double mean_overlapping_regions(const VolumeBoxes& boxes, Runs& runs) {
  const std::size_t step = std::max<std::size_t>(1, runs.count / kRunsOfSample);
  std::size_t overlaps = 0, sampled = 0;
  for (std::size_t run = 0; run < runs.count; run += step, ++sampled) {
    choose(boxes, runs.boxes[run], runs.next);
    overlaps += runs.next.size();
  }
  return static_cast<double>(overlaps) / static_cast<double>(std::max<std::size_t>(sampled, 1));
}

enum class TestStrategy { all, in_order, sorted };

TestStrategy cheapest(const VolumeBoxes& boxes, Runs& runs) {
  const double by_runs = kChooseCost + kTestChosenCost * mean_overlapping_regions(boxes, runs);
  const auto by_all = static_cast<double>(boxes.size());
  if (by_all <= std::min(by_runs, kSortCost)) return TestStrategy::all;
  return by_runs <= kSortCost ? TestStrategy::in_order : TestStrategy::sorted;
}

void states_in_order(UsableIsa isa, const PointView& points, const RegionTests& regions,
                     const VolumeBoxes& boxes, Runs& runs, std::uint8_t* states) {
  runs.chosen.clear();
  std::size_t begin = 0;  // first point to test against runs.chosen
  const auto flush = [&](std::size_t end) {
    if (runs.chosen.empty()) {
      std::fill(states + begin, states + end, static_cast<std::uint8_t>(RegionState::outside));
    } else {
      const ChosenRegions chosen = {runs.chosen.data(), runs.chosen.size()};
      region_states(isa, points.slice(begin, end - begin), regions, chosen, states + begin);
    }
    begin = end;
  };
  for (std::size_t run = 0; run < runs.count; ++run) {
    choose(boxes, runs.boxes[run], runs.next);
    if (runs.next == runs.chosen) continue;
    if (run > 0) flush(run * kRunPoints);
    std::swap(runs.chosen, runs.next);
  }
  flush(points.count);
}

template <typename T>
void states_sorted(UsableIsa isa, const PointView& points, const RegionTests& regions,
                   const VolumeBoxes& boxes, Runs& runs, SortedPoints<T>& sorted, std::uint8_t* states) {
  const std::size_t count = sorted.load(points);
  std::fill(states, states + points.count, static_cast<std::uint8_t>(RegionState::outside));
  sorted.states.resize(count);
  const PointView view = PointView::of(sorted.order[0].position, sizeof(PositionedItem<T>), count);
  runs.measure(isa, view);
  states_in_order(isa, view, regions, boxes, runs, sorted.states.data());
  for (std::size_t i = 0; i < count; ++i)
    states[sorted.order[i].index] = sorted.states[i];
}

}  // namespace

void region_states_by_runs(UsableIsa isa, const PointView& points, const RegionTests& regions,
                           const VolumeBoxes& boxes, std::uint8_t* states) {
  auto& [runs, floats, doubles] = scratch();
  runs.measure(isa, points);
  const TestStrategy strategy = cheapest(boxes, runs);
  if (strategy == TestStrategy::all) {
    region_states(isa, points, regions, states);
  } else if (strategy == TestStrategy::in_order) {
    states_in_order(isa, points, regions, boxes, runs, states);
  } else if (points.scalar == ScalarType::float32) {
    states_sorted(isa, points, regions, boxes, runs, floats, states);
  } else {
    states_sorted(isa, points, regions, boxes, runs, doubles, states);
  }
}

}  // namespace pcl_bv::detail
