// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs a pipeline in its own thread, behind a bounded queue of frames.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What happens when a frame arrives and the queue is full.
enum class QueuePolicy : std::uint8_t {
  automatic,    ///< "auto" in files; resolved_policy() tells what it means.
  drop_oldest,  ///< The frame that has waited longest is dropped, so that results are recent.
  drop_newest,  ///< The new frame is dropped.
  block         ///< The sender waits, so that no frame is lost. Suits files.
};

/// Resolves `automatic`. If `paced`, a sensor or a schedule determines when frames come, and the result is
/// drop_oldest. Otherwise each frame is read as soon as the queue has capacity, and the result is block. Any
/// other policy is returned unchanged.
QueuePolicy resolved_policy(QueuePolicy policy, bool paced);

/// Settings of a StreamRunner.
struct RunnerConfig {
  std::size_t queue = 1;  ///< Maximum number of waiting frames, 1 to 100000.
  QueuePolicy policy = QueuePolicy::automatic;
  double max_age_ms = 0;  ///< Frames that have waited longer are dropped. 0: no limit. Must be finite.
  /// Seconds without a frame after which `on_silence` is called. 0: never. Must be finite.
  double watchdog_s = 0;
};

/// The complete configuration of a stream.
struct StreamConfig {
  PipelineConfig pipeline;
  RunnerConfig runner;
  RigConfig rig{};

  /// Same as PipelineConfig::validate(), for all settings.
  std::vector<std::string> validate() const;
};

/// Thrown for an unusable configuration. what() is one line with the file, line number, key, problem and
/// allowed values.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a YAML file. The keys are the field names of PipelineConfig, nested by stage, such as `filter:
/// {range_min: 0.5}`. The keys under `runner` and `rig` are the field names of RunnerConfig and RigConfig.
/// Missing keys keep the values of `defaults`. For optional values, null means "not given". Throws
/// ConfigError if the file cannot be read, is not YAML, or has an unknown key or a value that is not allowed.
StreamConfig read_stream_config(const std::filesystem::path& file, const StreamConfig& defaults = {});

/// Same as read_stream_config(), but parses `text`. Errors use `name` as the file name. If `name` is empty,
/// errors have neither a name nor the line of a key. Only errors of the YAML syntax have their line.
StreamConfig parse_stream_config(const std::string& text, const std::string& name,
                                 const StreamConfig& defaults = {});

/// Returns the whole configuration as YAML, with units in comments. parse_stream_config() of this text gives
/// the same values, with one exception. A region that has volumes but no file is written with an empty file
/// name, which parse_stream_config() rejects.
std::string to_yaml(const StreamConfig& config);

/// Why a frame has no result.
enum class Loss : std::uint8_t {
  queue,  ///< The queue was full, or stop() discarded the frame.
  age,    ///< The frame waited longer than RunnerConfig::max_age_ms.
  error   ///< `process` or `on_result` threw, or the source could not read the frame.
};

/// Number of frames by outcome. `in` is the sum of `processed`, dropped_* and the frames that are waiting or
/// being processed.
struct FrameTotals {
  std::uint64_t in = 0;                                                 ///< Pushed or reported unreadable.
  std::uint64_t processed = 0;                                          ///< Processed without an exception.
  std::uint64_t dropped_queue = 0, dropped_age = 0, dropped_error = 0;  ///< Lost, by reason (Loss).
};

/// Latencies by stage in milliseconds, over all processed frames. `wait` is the time in the queue. The
/// histogram of `wait` also has the frames whose processing threw. `latency` is the time from Frame::taken
/// (by default the call of StreamRunner::push()) to the return of `on_result`.
struct StageLatencies {
  LatencyHistogram decode, wait, filter, ground, cluster, fit, track, total, latency;
};

/// Statistics of a runner since its start.
struct RunnerStats {
  FrameTotals frames;
  StageLatencies ms;
  std::uint64_t callback_errors = 0;  ///< Exceptions from on_lost and on_silence.
  /// Write times in ms by sink; set by the caller from SinkGroup::times().
  std::vector<std::pair<std::string, LatencyHistogram>> sinks;
};

/// Returns the statistics as one line of JSON. Milliseconds are rounded to 0.001. The line has the form
/// `{"frames":{"in":..,"processed":..,"dropped":{"queue":..,"age":..,"error":..}},"ms":{"total":{"p50":..,
/// "p95":..,"p99":..,"max":..},..,"sinks":{"vtp:FOLDER":{..}}}}`
std::string stats_json(const RunnerStats& stats);

/// Takes frames from any thread and processes them in order, in its own thread.
///
/// The queue bounds the memory. Do not destroy the runner from a callback or while another thread may still
/// call push(). If `process` or `on_result` throws, the runner drops that frame, reports it to `on_lost` and
/// continues with the next one.
class StreamRunner {
 public:
  /// Functions that the runner calls in its own thread, in the order of FrameHeader::number. The runner also
  /// calls them after stop() has been called, until the thread ends.
  struct Callbacks {
    /// Processes a frame, usually by FramePipeline::process() of a pipeline that outlives the runner.
    std::function<void(const Frame&, FrameResult&)> process;
    /// Receives each result with its frame. May call stop().
    std::function<void(const Frame&, const FrameResult&)> on_result;
    /// Receives each lost frame, perhaps without its points, and the reason as text. Optional. At most 1000
    /// lost frames wait for `on_lost`. At most 1000 frames that are lost after the call of stop() are
    /// reported. Further lost frames are only counted.
    std::function<void(const Frame&, Loss, const std::string&)> on_lost;
    /// Called once when no frame has come for RunnerConfig::watchdog_s, and again only after another frame
    /// has come. Receives the seconds since the last frame. Optional.
    std::function<void(double)> on_silence;
  };

  /// Starts the thread. StreamRunner treats QueuePolicy::automatic as drop_oldest. Throws
  /// std::invalid_argument if a value of `config` is not allowed, or if `process` or `on_result` is empty.
  StreamRunner(Callbacks callbacks, const RunnerConfig& config);

  /// As the constructor above, but results reuse the memory of `reserved`, which FramePipeline::reserve() has
  /// allocated.
  StreamRunner(Callbacks callbacks, const RunnerConfig& config, FrameResult reserved);

  /// Calls stop(End::discard).
  ~StreamRunner();
  StreamRunner(const StreamRunner&) = delete;
  StreamRunner& operator=(const StreamRunner&) = delete;

  /// Adds a frame to the queue and returns true. If `frame` itself must be dropped, returns false. A stopped
  /// runner drops every frame.
  ///
  /// With QueuePolicy::block, push() waits until the queue has capacity or the runner is stopped. With any
  /// other policy, push() never waits. A call from a callback never waits either, because the runner's thread
  /// would wait for itself. If the policy is block and the queue is full, such a call drops `frame`. Throws
  /// std::invalid_argument if the frame has points but no owner, because the points might be freed before
  /// they are processed.
  bool push(Frame frame);

  /// Reports a frame that its source could not read. The frame gets the next FrameHeader::number and is
  /// counted as lost (Loss::error). The frame needs no capacity in the queue. While 1000 lost frames wait for
  /// `on_lost`, report_unreadable() waits. A call from a callback or after stop() never waits.
  void report_unreadable(Frame frame, std::string reason);

  /// Waits until no frame is queued or being processed, and returns true. If the time `until` comes first,
  /// returns false.
  bool wait_idle(std::chrono::steady_clock::time_point until) const;

  enum class End {
    drain,   ///< Queued frames are processed first.
    discard  ///< Queued frames are dropped (Loss::queue); the frame being processed is finished.
  };

  /// Ends the thread and waits for its end. From a callback, stop() does not wait: the thread ends after the
  /// callback or, with `drain`, after the queued frames. A second call only waits for the end. A second call
  /// with `discard` also drops the frames that a previous `drain` has not processed yet.
  void stop(End end);

  /// Returns the statistics so far. RunnerStats::sinks is empty. May be called from any thread.
  RunnerStats stats() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
