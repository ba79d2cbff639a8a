// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar references. They are plain loops that define the result of each kernel.
#pragma once

#include "nearest_set.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/convert_times.h"
#include "pcl_bv/kernels/deskew.h"
#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/kernels/half_spaces.h"
#include "pcl_bv/kernels/moments.h"
#include "pcl_bv/kernels/region_states.h"
#include "pcl_bv/kernels/run_boxes.h"
#include "pcl_bv/kernels/slab_extents.h"
#include "pcl_bv/kernels/support.h"
#include "pcl_bv/kernels/swept_ball.h"
#include "pcl_bv/kernels/transform_points.h"

namespace pcl_bv::detail {

AxisExtents axis_extents_reference(const PointView& points);
void chunk_supports_reference(const PointView& chunk, const SupportDirections& set,
                              const SupportBounds& bounds, ChunkSupports& out);
SlabExtents slab_extents_reference(const PointView& points, const Coordinates& origin,
                                   const std::array<Direction, 3>& axes);
SlabExtents slab_extents_of_offsets_reference(const BlockOffsets& offsets,
                                              const std::array<Direction, 3>& axes);
std::size_t list_outside_reference(const PointView& points, const HalfSpaces& inside,
                                   std::uint32_t* positions);
void region_states_reference(const PointView& points, const RegionTests::Prepared& regions,
                             std::uint8_t* states);
void chosen_states_reference(const PointView& points, const RegionTests::Prepared& regions,
                             const ChosenRegions& chosen, std::uint8_t* states);
void deskew_reference(const PointView& points, const float* seconds, const SensorMotion& motion,
                      std::byte* xyz);
ConvertedTimes convert_times_reference(const TimeRecords& records, const TimeConversion& to, float* seconds);
TimeLimits find_time_limits_reference(const float* seconds, std::size_t count);
void transform_points_reference(const PointView& points, const RigidTransform& transform, std::byte* xyz);
void run_boxes_reference(const PointView& points, RunBox* boxes);

/// Writes the points as groups. Point number `pad` fills the rest of an incomplete last group.
void fill_groups_reference(const PointView& points, std::size_t pad, std::byte* groups);

void scan_octants_reference(const PointView& block, OctantScan& scan);
std::size_t list_distant_by_bounds_reference(const PointView& block, const ScanBounds& scanned,
                                             const DistanceCenter& center, double limit,
                                             std::uint32_t* positions);
std::size_t list_distant_reference(const PointView& points, const DistanceCenter& center, double limit,
                                   FloatFilter filter, std::uint32_t* positions);

bool any_in_ball_reference(const PackedTree& tree, const Coordinates& center, double limit);
void list_in_ball_reference(const PackedTree& tree, const Coordinates& center, double limit,
                            std::vector<Neighbor>& found);
void list_nearest_reference(const PackedTree& tree, const Coordinates& center, NearestSet& kept);
void find_nearest_reference(const PackedTree& tree, const Coordinates& center, NearestOne& kept);

void visit_along_reference(const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor);

Moments block_moments_reference(const PointView& block, BlockOffsets* offsets);

/// Calls sum(moments) with the exponents 0, 500 and 1000 until the sum of squares is at least 2^-660. For
/// floats, calls sum() only once.
template <typename Sum>
void sum_without_underflow(ScalarType scalar, Moments& moments, const Sum& sum) {
  for (moments.exponent = 0;; moments.exponent += 500) {
    sum(moments);
    const double squares = (moments.product[0] + moments.product[3]) + moments.product[5];
    if (scalar == ScalarType::float32 || moments.exponent == 1000 || squares >= 0x1p-660) return;
  }
}

}  // namespace pcl_bv::detail
