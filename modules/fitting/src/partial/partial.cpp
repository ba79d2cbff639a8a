// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/partial.h"

#include <algorithm>
#include <stdexcept>

#include "hull/convex_hull.h"
#include "hull/local_hull.h"
#include "map_chunks.h"
#include "partial/partial_state.h"
#include "pcl_bv/fitting/smallest_sphere.h"
#include "pcl_bv/numeric/float_environment.h"
#include "point_rank.h"
#include "schedule.h"
#include "support/support_search.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Sets counts, support points and extreme points of a state for more than kMaxStored points. Does not set the
// moments. number(i) must return the number in the whole cloud of the point with the index i.
template <typename Number>
void add_extremes(const PointView& points, const Execution& execution, const Number& number,
                  PartialState& state) {
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  state.used = supports.used;
  state.dropped = supports.dropped;
  if (supports.used == 0) return;
  for (std::size_t k = 0; k < kMaxDirections; ++k) {
    state.support_points[2 * k] = supports.along[k].low_point;
    state.support_points[2 * k + 1] = supports.along[k].high_point;
  }
  for (SupportPoint& p : state.support_points)
    p.index = number(p.index);
  for (const HullPoint& p : local_hull(points, supports, LocalFrame(supports), execution).candidates)
    state.extreme.push_back({number(p.index), p.point});
}

void add_loose(const PointView& points, std::size_t first, NumberedPoints& loose) {
  const LoadedPoints loaded(points, 0, points.count);
  for (std::size_t i = 0; i < points.count; ++i)
    loose.push_back({first + points.index(i), load_point(loaded.view(), i)});
}

MomentTree block_moments_of(const PointView& points, std::size_t first_block, const Execution& execution) {
  MomentTree blocks;
  const auto policy = worthwhile(execution, Work::cube_support, kMaxDirections * points.count);
  map_chunks<MomentTree>(
      points, policy,
      [&](const PointView& chunk) {
        const std::size_t before = chunk.index(0) - points.index(0);
        return moments_of(execution.isa, chunk, first_block + block_of_number(before));
      },
      [&](const MomentTree& part) { blocks.append(0, part); });
  return blocks;
}

// Returns the state of more than kMaxStored points.
PartialState state_of(const PointView& points, std::size_t first, const Execution& execution) {
  PartialState state;
  state.scalar = points.scalar;
  add_extremes(
      points, execution, [&](std::size_t index) { return first + index; }, state);
  const std::size_t number = first + points.index(0);
  const std::size_t head = (kBlockPoints - number % kBlockPoints) % kBlockPoints;
  const std::size_t whole = (points.count - head) / kBlockPoints * kBlockPoints;
  add_loose(points.slice(0, head), first, state.loose);
  state.blocks = block_moments_of(points.slice(head, whole), block_of_number(number + head), execution);
  add_loose(points.slice(head + whole, points.count - head - whole), first, state.loose);
  return state;
}

// Calls visit(block, points) for the loose points of each block.
template <typename Visit>
void for_each_block(const NumberedPoints& loose, const Visit& visit) {
  for (auto first = loose.begin(); first != loose.end();) {
    const std::size_t block = block_of_number(first->number);
    const auto last = std::find_if(
        first, loose.end(), [&](const NumberedPoint& p) { return block_of_number(p.number) != block; });
    visit(block, NumberedPoints(first, last));
    first = last;
  }
}

Moments moments_of_block(const NumberedPoints& points, ScalarType scalar) {
  return block_moments(Isa::automatic, PackedPoints(points, scalar).view());
}

using MomentNodes = std::vector<MomentNode>;

MomentTree tree_of(MomentNodes nodes) {
  std::sort(nodes.begin(), nodes.end(),
            [](const MomentNode& a, const MomentNode& b) { return a.first < b.first; });
  MomentTree tree;
  for (const MomentNode& node : nodes)
    tree.append(node);
  return tree;
}

// Removes complete blocks from the loose points. Sets state.blocks to the tree of these blocks and `nodes`.
void sum_whole_blocks(PartialState& state, MomentNodes nodes) {
  NumberedPoints loose;
  for_each_block(state.loose, [&](std::size_t block, const NumberedPoints& points) {
    if (points.size() == kBlockPoints) {
      nodes.push_back({block, 1, moments_of_block(points, state.scalar)});
    } else {
      loose.insert(loose.end(), points.begin(), points.end());
    }
  });
  state.loose = std::move(loose);
  state.blocks = tree_of(std::move(nodes));
}

PartialState merged(const PartialState& one, const PartialState& other) {
  const SupportDirections& directions = SupportDirections::of(DirectionSet::dop26);
  PartialState both;
  both.scalar = one.scalar;
  both.loose = merged(one.loose, other.loose);
  if (one.size() + other.size() > Partial::kMaxStored) {
    const PartialState a = reduced(one), b = reduced(other);
    both.used = a.used + b.used;
    both.dropped = a.dropped + b.dropped;
    for (std::size_t i = 0; i < both.support_points.size(); ++i) {
      both.support_points[i] = a.support_points[i];
      keep_larger_projection(directions.support_direction(i), b.support_points[i], both.support_points[i]);
    }
    both.extreme = merged(a.extreme, b.extreme);
    keep_extreme(both.extreme);
    MomentNodes nodes(a.blocks.begin(), a.blocks.end());
    nodes.insert(nodes.end(), b.blocks.begin(), b.blocks.end());
    sum_whole_blocks(both, std::move(nodes));
    require_apart(both);
  }
  return both;
}

// Returns the points that represent the cloud: the extreme points and the support points. A support point is
// not always an extreme point, because it may be any point of a flat side.
NumberedPoints representative_points(const PartialState& state) {
  NumberedPoints points = state.extreme;
  for (const SupportPoint& p : state.support_points) {
    if (p.found) points.push_back({p.index, p.point});
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end(), same_number), points.end());
  return points;
}

// Returns the supports of the whole cloud. The indices are positions in `points`, which represent the cloud.
Supports supports_of(const PartialState& state, const NumberedPoints& points, const PointView& view,
                     const Execution& execution) {
  Supports supports;
  supports.set = DirectionSet::dop26;
  supports.along = SupportList(direction_count(supports.set));
  supports.detail = SupportDetail::points;
  supports.used = state.used;
  supports.dropped = state.dropped;
  supports.points = view;
  supports.moments = std::make_shared<Moments>(moments_of_all(state));
  const auto position = [&](const SupportPoint& p) {
    const auto found = std::lower_bound(points.begin(), points.end(), NumberedPoint{p.index, {}});
    return static_cast<std::size_t>(found - points.begin());
  };
  for (std::size_t k = 0; k < kMaxDirections && state.used > 0; ++k) {
    supports.along[k] = support_between(SupportDirections::of(supports.set), k, state.support_points[2 * k],
                                        state.support_points[2 * k + 1]);
    supports.along[k].low_point.index = position(state.support_points[2 * k]);
    supports.along[k].high_point.index = position(state.support_points[2 * k + 1]);
  }
  supports.rank = point_rank(view, supports, execution);
  return supports;
}

}  // namespace

PartialState detail::reduced(PartialState state) {
  if (!state.stores_all() || state.loose.empty()) return state;
  const PackedPoints packed(state.loose, state.scalar);
  add_extremes(
      packed.view(), {}, [&](std::size_t index) { return state.loose[index].number; }, state);
  return state;
}

Moments detail::moments_of_all(const PartialState& state) {
  MomentNodes nodes(state.blocks.begin(), state.blocks.end());
  for_each_block(state.loose, [&](std::size_t block, const NumberedPoints& points) {
    nodes.push_back({block, 1, moments_of_block(points, state.scalar)});
  });
  return tree_of(std::move(nodes)).total();
}

Partial::Partial(const PointView& points, std::size_t first, const Execution& execution) {
  const FloatEnvironment environment;
  if (points.indices != nullptr) throw std::invalid_argument("Partial: the view has an index list");
  PartialState state;
  state.scalar = points.scalar;
  if (points.count > kMaxStored) {
    state = state_of(points, first, execution);
  } else {
    add_loose(points, first, state.loose);
  }
  state_ = std::make_shared<PartialState>(std::move(state));
}

void Partial::merge(const Partial& other) {
  const FloatEnvironment environment;
  if (other.size() == 0) return;
  if (size() > 0 && state_->scalar != other.state_->scalar)
    throw std::invalid_argument("Partial::merge: cannot merge float and double points");
  state_ = size() == 0 ? other.state_ : std::make_shared<PartialState>(merged(*state_, *other.state_));
}

bool Partial::can_fit(const Method& method, const MethodOptions& options) {
  return !needs_all_points(method, options);
}

Fitted<AnyVolume> Partial::fit(const Method& method, const MethodOptions& options,
                               const Execution& execution) const {
  const FloatEnvironment environment;
  if (!can_fit(method, options)) refuse_partial(method.needs_all_points ? method.name : kConcavePrism);
  if (state_->stores_all()) {
    const PackedPoints all(state_->loose, state_->scalar);
    return method.fit(all.view(), options, execution);
  }
  const NumberedPoints points = representative_points(*state_);
  const PackedPoints packed(points, state_->scalar);
  const Supports supports = supports_of(*state_, points, packed.view(), execution);
  return make_fitted<Fitted<AnyVolume>>([&](auto& made) {
    return fit_method(method, packed.view(), options, made.volume, {execution, &supports});
  });
}

namespace detail {

Certified<Sphere, SphereCertificate> fit_smallest_sphere(const Partial& partial,
                                                         const FarthestQuery& farthest,
                                                         const Execution& execution) {
  const FloatEnvironment environment;
  const PartialState& state = PartialAccess::state(partial);
  if (state.stores_all()) {
    const PackedPoints all(state.loose, state.scalar);
    return pcl_bv::fit_smallest_sphere(all.view(), execution);
  }
  const NumberedPoints points = representative_points(state);
  const PackedPoints packed(points, state.scalar);
  Supports supports = supports_of(state, points, packed.view(), execution);
  // `farthest` returns indices into the whole cloud. The supports have indices into `points`, so these are
  // replaced by indices into the whole cloud.
  for (std::size_t k = 0; k < kMaxDirections && state.used > 0; ++k) {
    supports.along[k].low_point.index = state.support_points[2 * k].index;
    supports.along[k].high_point.index = state.support_points[2 * k + 1].index;
  }
  return make_fitted<Certified<Sphere, SphereCertificate>>([&](auto& made) {
    made.volume = smallest_sphere(supports, farthest, made.certificate);
    return result_of(supports);
  });
}

}  // namespace detail

}  // namespace pcl_bv
