// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The complete pipeline from a point cloud to the bounding volumes of its objects. Processing does no I/O and
// runs in one thread unless PipelineConfig::threads says otherwise.
#pragma once

#include <memory>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Processes frames of any point type: filter, ground removal, clustering, volume fitting and tracking.
///
/// All stages work on lists of indices into the frame's cloud. The same configuration and frames give the
/// same bits on every instruction set and with any number of threads. Memory is reused: a second pass over
/// the same sequence allocates nothing with the methods aabb, dop*, sphere-*, obb-pca, obb-dito14 and
/// obb-yaw.
class FramePipeline {
 public:
  /// Throws std::invalid_argument with all lines of PipelineConfig::validate() if there are any, and IoError
  /// if a region file (filter.regions) cannot be read.
  explicit FramePipeline(PipelineConfig config = {});
  ~FramePipeline();
  FramePipeline(FramePipeline&&) noexcept;
  FramePipeline& operator=(FramePipeline&&) noexcept;

  /// Replaces the configuration from the next frame on. May be called from any thread. Throws as the
  /// constructor does and then changes nothing. Tracks are retained.
  void set_config(PipelineConfig config);
  /// Returns the configuration that the next frame will use.
  PipelineConfig config() const;

  /// Processes one frame and replaces `result`. Tracked frames must come in the order of their stamps. A
  /// frame without a valid point gives no clusters, or one empty cluster if cluster.tolerance is 0;
  /// `result.counts` tells why points were dropped. Must not be called by several threads at the same time.
  ///
  /// Throws std::length_error if index lists are needed for more than 2^31 - 1 points. Throws
  /// std::invalid_argument if ground removal or clustering is enabled and the points come from a PointSource,
  /// or if cluster.class_field is set and the frame has no classes.
  void process(const Frame& frame, FrameResult& result);

  /// Allocates the memory for frames of `points` points, so that the first frame takes about as long as the
  /// next ones; first-time allocation costs several times as much as the processing itself. Processes a
  /// synthetic sweep twice; call it before the sensor's first frame. Deletes all tracks. Only the capacity of
  /// `result` is meaningful afterwards.
  void reserve(std::size_t points, FrameResult& result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
