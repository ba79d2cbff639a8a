// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results as the messages that recordings and viewers get beside objects and markers.
#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/messages/results.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv {

/// foxglove_msgs/SceneUpdate: an entity for each object, of all its volumes, with its number as a text and
/// what is known of it as metadata. Each takes the place of the last of its id; those of `shown` that have
/// ended are deleted.
void fill_scene(const Frame& frame, const FrameResult& result, const std::vector<DrawnVolume>& volumes,
                std::int64_t lifetime_ns, ShownObjects& shown, msg::SceneUpdate& scene);

}  // namespace pcl_bv
