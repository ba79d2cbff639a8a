// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A rig whose clouds and transforms come from one middleware.
#pragma once

#include <memory>

#include "pcl_bv/nodes/frame_source.h"
#include "stream/middleware.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Same as open_rig(), for live topics of a middleware: the topics of `rig.sensors` with clouds, /tf,
/// /tf_static and `rig.odometry`. `middleware` is used only during the call; its receivers are used as long
/// as the source lives. Of `options`, class_field, point_times and poses are used.
///
/// Throws std::invalid_argument if `rig` has a value that is not allowed or no frame or no sensor, IoError if
/// the URDF or the poses cannot be read, and as Middleware::receiver().
std::unique_ptr<FrameSource> open_live_rig(Middleware& middleware, const RigConfig& rig,
                                           const ReplayOptions& options);

}  // namespace detail
}  // namespace pcl_bv
