// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud in, the objects in it as volumes out: the whole way, without I/O and, unless `threads` asks for
// more, in one thread.
#pragma once

#include <memory>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Filter, ground, clusters, volumes, tracks, for frames of any point type.
///
/// All stages work on lists of indices into the frame's cloud. Same configuration and frames, same bits, on
/// every instruction set and number of threads. Memory is kept: a second pass over the same sequence
/// allocates nothing (for aabb, dop*, sphere-*, obb-pca, obb-dito14 and obb-yaw).
class FramePipeline {
 public:
  /// Throws std::invalid_argument with the lines of PipelineConfig::validate(), if there are any, and IoError
  /// for a file of regions that cannot be read.
  explicit FramePipeline(PipelineConfig config = {});
  ~FramePipeline();
  FramePipeline(FramePipeline&&) noexcept;
  FramePipeline& operator=(FramePipeline&&) noexcept;

  /// Takes effect with the next frame; callable from any thread. Throws as the constructor and changes
  /// nothing then. Tracks live on.
  void set_config(PipelineConfig config);
  PipelineConfig config() const;

  /// Replaces `result`. Frames must come in the order of their stamps where they are tracked. No valid point:
  /// no clusters (without clustering one of no points), the frame's header, and the counts say why. Throws
  /// std::length_error beyond 2^31 - 1 points; std::invalid_argument for points of a source, if ground or
  /// clusters are asked for. Not for several threads at once.
  void process(const Frame& frame, FrameResult& result);

  /// Makes room for frames of `points` points, so that the first one takes about as long as the next ones:
  /// fresh memory costs several times what the work does. Passes a made sweep twice through all stages; call
  /// it before the sensor's first frame. Tracks are forgotten, and `result` means nothing afterwards but
  /// room.
  void reserve(std::size_t points, FrameResult& result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
