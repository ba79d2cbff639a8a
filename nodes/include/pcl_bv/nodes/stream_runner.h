// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A pipeline behind a bounded queue, in a thread of its own.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/latency.h"
#include "pcl_bv/nodes/stream_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Why a frame has no result.
enum class Loss : std::uint8_t {
  queue,  ///< For want of room, and what stop() discards.
  age,    ///< It waited longer than max_age_ms.
  error   ///< An exception was thrown, or the source could not read it.
};

/// What became of the frames. in = processed + dropped_* + those still waiting or being processed.
struct FrameTotals {
  std::uint64_t in = 0;                                                 ///< Pushed.
  std::uint64_t processed = 0;                                          ///< Handed to the callback.
  std::uint64_t dropped_queue = 0, dropped_age = 0, dropped_error = 0;  ///< By Loss.
};

/// Milliseconds by stage, over all processed frames. `wait` is the time in the queue, also of frames whose
/// work threw; `latency` that from Frame::taken, by default the call of push(), to the return of on_result.
struct StageLatencies {
  LatencyHistogram decode, wait, filter, ground, cluster, fit, track, total, latency;
};

struct RunnerStats {
  FrameTotals frames;
  StageLatencies ms;
  std::uint64_t callback_errors = 0;  ///< Exceptions of on_lost and on_silence, which cost no frame.
  std::vector<std::pair<std::string, LatencyHistogram>> sinks;  ///< Milliseconds of each, from SinkGroup.
};

/// `{"frames":{"in":..,"processed":..,"dropped":{"queue":..,"age":..,"error":..}},"ms":{"total":{"p50":..,"p95":..,
/// "p99":..,"max":..},..,"sinks":{"vtp:FOLDER":{..}}}}`
std::string stats_json(const RunnerStats& stats);

/// Frames in from any thread, results out in the runner's thread, in order.
///
/// Memory is bounded by the queue. The runner must not be destroyed from a callback, nor while another thread
/// may still push(). An exception of the process or the result callback drops that frame and is told to
/// on_lost; the stream goes on.
class StreamRunner {
 public:
  /// All are called in the runner's thread, in the order of FrameHeader::number, also while it stops.
  struct Callbacks {
    /// The work; FramePipeline::process() of a pipeline that outlives the runner.
    std::function<void(const Frame&, FrameResult&)> process;
    /// Each result with its frame. May stop() the runner.
    std::function<void(const Frame&, const FrameResult&)> on_result;
    /// A frame that was lost, whose points may be gone, and why in words. Optional. Where a thousand wait to
    /// be told, and after a thousand that came when the runner was stopped, further ones are only counted.
    std::function<void(const Frame&, Loss, const std::string&)> on_lost;
    /// No frame has come for config.watchdog_s; seconds since the last one. Called once per silence.
    /// Optional.
    std::function<void(double)> on_silence;
  };

  /// Starts the thread. QueuePolicy::automatic is drop_oldest here. Throws std::invalid_argument for a queue
  /// of 0, a negative or NaN duration, or without a `process` and an `on_result`.
  StreamRunner(Callbacks callbacks, const RunnerConfig& config);

  /// The same; results use the memory of `reserved`, which FramePipeline::reserve() has filled.
  StreamRunner(Callbacks callbacks, const RunnerConfig& config, FrameResult reserved);

  /// stop(End::discard).
  ~StreamRunner();
  StreamRunner(const StreamRunner&) = delete;
  StreamRunner& operator=(const StreamRunner&) = delete;

  /// Hands over a frame; false if it is dropped at once, which a stopped runner always does. Waits only with
  /// QueuePolicy::block, until there is room or the runner is stopped; from a callback, which would wait for
  /// itself, it does not wait either and drops the frame. Throws std::invalid_argument for points without an
  /// owner, which might be gone when it is their turn.
  bool push(Frame frame);

  /// Counts a frame that its source could not read, in its place among the others. Takes no room in the
  /// queue, but waits where a thousand lost frames do.
  void report_unreadable(Frame frame, std::string reason);

  /// Waits until no frame waits or is in work, but not beyond `until`; says whether that is so.
  bool wait_idle(std::chrono::steady_clock::time_point until) const;

  enum class End {
    drain,   ///< What waits is processed first.
    discard  ///< What waits is dropped (Loss::queue); the frame in work is finished.
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
