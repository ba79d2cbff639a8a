// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts results to scenes for recordings and viewers.
#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/messages/results.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv::detail {

/// Fills a foxglove_msgs/SceneUpdate with an entity for each object. The entity has all volumes of the
/// object, its id as text and its properties as metadata. It replaces the last entity with the same id.
/// Entities of `shown` whose objects have ended are deleted.
void fill_scene(const Frame& frame, const FrameResult& result, const std::vector<VolumeShape>& volumes,
                std::int64_t lifetime_ns, ShownObjects& shown, msg::SceneUpdate& scene);

}  // namespace pcl_bv::detail
