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
/// Large views, of 200 000 points or more, are fitted first, one after another. Each of their fits gets the
/// whole policy. The smaller views are then distributed over the threads, the largest first. Each of their
/// fits gets Serial. The fit of one view of middle size is timed. If all smaller views together would take
/// too little time to be worth a second thread, the calling thread fits them all. Execution::supports is not
/// passed to `fit`.
///
/// If fits of smaller views throw, all other smaller views are still fitted, and one exception is rethrown,
/// as for_each_chunk() describes. If the fit of a large view or of the timed view throws, no further view is
/// fitted.
void for_each_view(const std::vector<PointView>& views, const Execution& execution,
                   const std::function<void(std::size_t, const Execution&)>& fit);

}  // namespace pcl_bv
