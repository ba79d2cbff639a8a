// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The complete pipeline from a point cloud to the bounding volumes of its objects. FramePipeline::process()
// does no I/O. The number of threads is PipelineConfig::threads, by default 1.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/volumes/aabb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
class SupportFinder;
}

/// Processes frames of any point type: filter, ground removal, clustering, volume fitting and tracking.
///
/// Each stage gives the next stage a list of indices into the frame's cloud, not a copy of the points. A
/// large cloud that is only filtered has no such list (FrameResult::filtered). The results do not depend on
/// the instruction set or the number of threads. FramePipeline reuses its memory. With the methods aabb,
/// dop*, sphere-*, obb-pca, obb-dito14 and obb-yaw, a second pass over the same sequence allocates nothing.
class FramePipeline {
 public:
  /// Throws std::invalid_argument if PipelineConfig::validate() returns any lines. The message of the
  /// exception has all of these lines. Throws IoError if a region file (filter.regions) cannot be read.
  explicit FramePipeline(PipelineConfig config = {});
  ~FramePipeline();
  FramePipeline(FramePipeline&&) noexcept;
  FramePipeline& operator=(FramePipeline&&) noexcept;

  /// Replaces the configuration from the next frame on. May be called from any thread. Throws as the
  /// constructor does; the old configuration then stays in use. Tracks are retained.
  void set_config(PipelineConfig config);
  /// Returns the configuration that the next frame will use.
  PipelineConfig config() const;

  /// Processes one frame and replaces `result`. If tracking is enabled, frames must come in the order of
  /// their stamps. FrameResult::warnings says if they do not. If the stamp goes back by more than one second,
  /// or Frame::pass changes, all tracks are deleted; their ids are not reused. A frame without a valid point
  /// gives no clusters, or one empty cluster if cluster.tolerance is 0 and cluster.min_size is 0 or not set.
  /// `result.counts` holds the number of dropped points by reason. Two threads must not call process() at the
  /// same time.
  ///
  /// Throws std::length_error if index lists are needed for more than 2^31 - 1 points. Throws
  /// std::invalid_argument if ground removal or clustering is enabled and the points come from a PointSource.
  /// Also throws std::invalid_argument if cluster.class_field is set and the frame has no classes.
  void process(const Frame& frame, FrameResult& result);

  /// Allocates the memory for frames of `points` points. Without this call, the first frame takes several
  /// times as long as the next ones, because first-time allocation is slow. reserve() processes a synthetic
  /// sweep twice and then deletes all tracks, so call it before the sensor's first frame. Only the capacity
  /// of `result` is meaningful afterwards.
  void reserve(std::size_t points, FrameResult& result);

  /// Replaces the object that fills FrameResult::warnings, for example to name settings by options of a
  /// program. Warnings that were given before are given again.
  void set_warnings(FrameWarnings warnings);

  /// Private. Lets a device find the supports of the clusters, which changes no bit. Null: the processor
  /// does.
  void set_support_finder(std::shared_ptr<detail::SupportFinder> finder);

  /// Private. Returns boxes around the volumes of the regions with RegionConfig::keep; nullopt if there are
  /// no such regions. The next frame's points outside all boxes are dropped.
  std::optional<std::vector<Aabb>> kept_extents() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
