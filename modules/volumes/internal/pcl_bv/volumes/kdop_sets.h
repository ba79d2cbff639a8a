// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>

#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns a built-in set: KdopSet::dop6(), dop14(), dop18() or dop26().
const std::shared_ptr<const KdopSet>& kdop_set_of(DirectionSet set);

}  // namespace detail
}  // namespace pcl_bv
