// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A pipeline behind a bounded queue, in a thread of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/latency.h"
#include "pcl_bv/nodes/stream_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What became of the frames. in = processed + dropped_* + those still waiting or being processed.
struct FrameTotals {
  std::uint64_t in = 0;             ///< Pushed.
  std::uint64_t processed = 0;      ///< Handed to the callback.
  std::uint64_t dropped_queue = 0;  ///< For want of room, and those discarded at the end.
  std::uint64_t dropped_age = 0;    ///< For having waited longer than max_age_ms.
  std::uint64_t dropped_error = 0;  ///< Because an exception was thrown, or the source could not read them.
};

/// Milliseconds by stage, over all processed frames. `wait` is the time in the queue, also of frames whose
/// work threw.
struct StageLatencies {
  LatencyHistogram decode, wait, filter, ground, cluster, fit, track, total;
};

struct RunnerStats {
  FrameTotals frames;
  StageLatencies ms;
};

/// `{"frames":{"in":..,"processed":..,"dropped":{"queue":..,"age":..,"error":..}},"ms":{"total":{"p50":..,"p95":..,
/// "p99":..,"max":..},..}}`
std::string stats_json(const RunnerStats& stats);

/// Frames in from any thread, results out in the runner's thread, in order.
///
/// Memory is bounded by the queue. The runner must not be destroyed from a callback, nor while another thread
/// may still push(). An exception of the process or the result callback drops that frame,
/// counts it and goes to on_error; the stream goes on.
class StreamRunner {
 public:
  struct Callbacks {
    /// The work; FramePipeline::process() of a pipeline that outlives the runner.
    std::function<void(const Frame&, FrameResult&)> process;
    /// Each result, in the order of the frames. May stop() the runner.
    std::function<void(const FrameResult&)> on_result;
    /// A frame that was lost to an exception, and why. Optional; must not throw.
    std::function<void(const FrameHeader&, const std::string&)> on_error;
    /// No frame has come for config.watchdog_s; seconds since the last one. Called once per silence.
    /// Optional; must not throw.
    std::function<void(double)> on_silence;
  };

  /// Starts the thread. Throws std::invalid_argument for a queue of 0, a negative or NaN duration, or without
  /// a `process` and an `on_result`.
  StreamRunner(Callbacks callbacks, const RunnerConfig& config);

  /// stop(End::discard).
  ~StreamRunner();
  StreamRunner(const StreamRunner&) = delete;
  StreamRunner& operator=(const StreamRunner&) = delete;

  /// Hands over a frame; false if it is dropped at once, which a stopped runner always does. Waits only with
  /// QueuePolicy::block, until there is room or the runner is stopped; from a callback, which would wait for
  /// itself, it does not wait either and drops the frame.
  bool push(Frame frame);

  /// Counts a frame that its source could not read. Goes to on_error, after the results of the frames before
  /// it; takes no room in the queue, but waits where a thousand such frames do.
  void report_unreadable(const FrameHeader& header, const std::string& reason);

  enum class End {
    drain,   ///< What waits is processed first.
    discard  ///< What waits is dropped and counted as dropped_queue; the frame in work is finished.
  };

  /// Ends the thread and waits for it; from a callback, it ends after the callback. Again: does nothing,
  /// except that discard cuts a drain short.
  void stop(End end);

  RunnerStats stats() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
