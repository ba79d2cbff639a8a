// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to many point views in parallel (the paper, §5; see docs/references.md).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Calls fit(i, execution) once for each view i, in any order and on the threads of the execution's policy.
///
/// Large views, of 200 000 points or more, come first, one after another; each of their fits gets the whole
/// policy. The smaller views are then distributed over the threads, largest first; each of their fits gets
/// Serial. The fit of one view of middle size is timed: if the time of all smaller views together is not
/// worth a second thread, the calling thread fits them all. Execution::supports is not handed to `fit`.
///
/// If fits of smaller views throw, the others are still done and one exception is rethrown, as
/// for_each_chunk() describes. An exception of a large view or of the timed view ends the call at once.
void for_each_view(const std::vector<PointView>& views, const Execution& execution,
                   const std::function<void(std::size_t, const Execution&)>& fit);

}  // namespace pcl_bv
