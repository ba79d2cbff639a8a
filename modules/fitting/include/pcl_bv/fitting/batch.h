// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Several volumes at a time over the cores (paper §5).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Calls fit(i, execution) once for each view, in any order and on the threads of the execution's policy.
///
/// Views large enough to be worth several threads come first, one after another, each with the whole policy;
/// the others are handed out by size, largest first, each with Serial, and all to the calling thread if
/// together they are not worth a second one, as the time of one of middle size tells. Exceptions come back as
/// for_each_chunk() says, but one of a large view or of that one ends the call.
void for_each_view(const std::vector<PointView>& views, const Execution& execution,
                   const std::function<void(std::size_t, const Execution&)>& fit);

}  // namespace pcl_bv
