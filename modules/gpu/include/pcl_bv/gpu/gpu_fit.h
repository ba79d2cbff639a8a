// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits to clouds on a graphics card. The device rejects points that certainly do not matter, and the
// processor decides about the others, so every volume has the bits of the same fit without a device
// (docs/gpu.md).
#pragma once

#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/gpu/gpu_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Fits several methods to the points of a cloud. Returns the fits in the order of `methods`. Volumes,
/// status, rank and counts have the same bits as those of fit_methods() for the points. Empty, flat and
/// invalid input gives what that function gives.
///
/// The device finds the support points of all methods that begin with them, in one pass: aabb, dop*,
/// sphere-*, and those that search the hull. Everything else is done by the processor, which reads the points
/// from GpuCloud::points(). The processor also searches supports itself, so that the fit only takes longer,
/// if more than a sixteenth of the blocks of 1024 points could have a support (equal coordinates, as on a
/// grid), or if coordinates span more than 2^126.
///
/// Throws std::invalid_argument for a null method. Throws GpuError if the device has too little memory or is
/// lost. Exceptions of the source of the uploaded points are passed on.
std::vector<Fitted<AnyVolume>> fit(const GpuCloud& cloud, const std::vector<const Method*>& methods,
                                   const MethodOptions& options = {}, const Execution& execution = {});

}  // namespace pcl_bv
