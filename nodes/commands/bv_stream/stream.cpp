// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The main thread reads frames and waits until each is due. The thread of the runner processes frames and
// writes results.

#include "stream.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "commands/shared/messages.h"
#include "commands/shared/setting_options.h"
#include "commands/shared/values.h"
#include "pass_stamps.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/frame_sink.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv::detail {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::chrono::milliseconds kPollInterval{50};  // longest time until a signal is noticed

// Returns how messages name the source.
std::string name_of(const StreamOptions& options) {
  return options.config.rig.frame.empty() ? options.sources.front() : "rig";
}

std::unique_ptr<FrameSource> open(const StreamOptions& options) {
  return parse_with("--source", options.sources.front(), [&](const std::string& name) {
    return options.config.rig.frame.empty() ? open_source(name, options.replay)
                                            : open_rig(options.sources, options.config.rig, options.replay);
  });
}

// Returns the settings of the pipeline with the regions of the robot's own body.
PipelineConfig pipeline_config(const StreamConfig& config) {
  PipelineConfig pipeline = config.pipeline;
  std::vector<std::string> warnings;
  if (std::optional<RegionConfig> body = robot_body(config.rig, warnings))
    pipeline.filter.regions.push_back(*std::move(body));
  for (const std::string& warning : warnings)
    report_problem(config.rig.urdf + ": " + warning);
  return pipeline;
}

class Progress {
 public:
  void show(std::uint64_t frames, std::size_t objects, double milliseconds) {
    if (!terminal_) return;
    char line[100];
    std::snprintf(line, sizeof line, "frame %llu: %zu objects, %.1f ms",
                  static_cast<unsigned long long>(frames), objects, milliseconds);
    show_status_line(line);
  }

 private:
  // Progress is not shown if standard output is a terminal, too, because printed results would mix with the
  // progress.
  const bool terminal_ = errors_go_to_a_terminal() && isatty(STDOUT_FILENO) == 0;
};

// Prints counters and latencies as one line.
void report(const RunnerStats& stats) {
  const FrameTotals& f = stats.frames;
  const auto count = [](std::uint64_t n, const char* what) { return std::to_string(n) + what; };
  char latency[80];
  std::snprintf(latency, sizeof latency, "latency p50 %.1f ms, p99 %.1f ms", stats.ms.latency.percentile(0.5),
                stats.ms.latency.percentile(0.99));
  print_message(count(f.in, " frames, ") + count(f.processed, " done, dropped ") +
                count(f.dropped_queue, " queue, ") + count(f.dropped_age, " age, ") +
                count(f.dropped_error, " error; ") + latency);
}

// Reads frames until the source ends, a signal comes, or no sink takes results any more.
class Reader {
 public:
  Reader(const StreamOptions& options, StreamRunner& runner, const SinkGroup& sinks,
         const std::atomic<bool>& interrupted)
      : options_(options), runner_(runner), sinks_(sinks), interrupted_(interrupted) {}

  void read(FrameSource& source) {
    print_warnings(source);  // also if a signal has already come
    for (bool more = true; more && wanted();) {
      Frame frame;
      try {
        const Next next = source.next(frame, kPollInterval);
        more = next != Next::end;
        print_warnings(source);
        if (next != Next::frame) continue;
        stamps_.move(frame);
        hand_over(std::move(frame));
      } catch (FrameError& error) {
        stamps_.move_unreadable(error.frame);
        if (paced() && error.frame.header.stamp_ns >= 0) due(error.frame);  // advances the schedule
        runner_.report_unreadable(error.frame, error.reason);
      } catch (const std::exception& error) {
        runner_.report_unreadable({}, std::string("the source failed: ") + reason_of(error));
        more = false;
        failed = true;
      }
    }
  }

  std::uint64_t without_pose = 0;
  bool failed = false;

 private:
  void print_warnings(FrameSource& source) const {
    for (const std::string& warning : source.take_warnings())
      report_problem(name_of(options_) + ": " + warning);
  }

  // Returns whether to continue reading. Also prints the periodic reports, because wanted() is called
  // repeatedly.
  bool wanted() {
    if (options_.report_seconds > 0 && Seconds(Clock::now() - reported_).count() >= options_.report_seconds) {
      reported_ = Clock::now();
      report(runner_.stats());
    }
    return !interrupted_ && sinks_.alive();
  }

  void hand_over(Frame frame) {
    if (paced()) {
      frame.taken = due(frame);
      while (wanted() && Clock::now() < frame.taken)
        std::this_thread::sleep_until(std::min(frame.taken, Clock::now() + kPollInterval));
    }
    if (!wanted()) return;
    const bool wants_pose = !options_.replay.poses.empty() || !options_.config.rig.fixed_frame.empty();
    without_pose += wants_pose && !frame.pose;
    const Clock::time_point next = frame.taken + in_time(step_ - 2e-3 * frame.decode_ms);
    runner_.push(std::move(frame));
    if (paced()) leave_the_worker_alone(next);
  }

  bool paced() const { return options_.rate == Rate::fixed || options_.rate == Rate::recorded; }

  // Waits until the frame is processed, but at most until the time `until` at which the next frame must be
  // read. Reading the next file earlier would take a core and cache from the processing, which a live sensor
  // does not do.
  void leave_the_worker_alone(Clock::time_point until) {
    while (wanted() && Clock::now() < until &&
           !runner_.wait_idle(std::min(until, Clock::now() + kPollInterval)))
      ;
  }

  // Returns when a frame is due. Must be called once for each frame, because each call adds a step to the
  // schedule. Stamps that go back add no time. The sum of the steps is limited, because a clock cannot count
  // more than some centuries.
  Clock::time_point due(const Frame& frame) {
    step_ = 1 / options_.replay.rate_hz;
    if (options_.rate == Rate::recorded)
      step_ = std::max(1e-9 * static_cast<double>(frame.header.stamp_ns - last_stamp_ns_), 0.0);
    if (paced_++ > 0) seconds_ = std::min(seconds_ + step_, 1e9);
    last_stamp_ns_ = frame.header.stamp_ns;
    return begin_ + in_time(seconds_);
  }

  static Clock::duration in_time(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
  }

  const StreamOptions& options_;
  StreamRunner& runner_;
  const SinkGroup& sinks_;
  const std::atomic<bool>& interrupted_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point reported_ = begin_;
  PassStamps stamps_;
  std::uint64_t paced_ = 0;
  std::int64_t last_stamp_ns_ = 0;
  double seconds_ = 0, step_ = 0;
};

// Prints the numbers of dropped frames and of frames without a pose. Frames with an error are not included,
// because each of them has been reported before.
void report_dropped_frames(const FrameTotals& frames, std::uint64_t without_pose) {
  const std::uint64_t dropped = frames.dropped_queue + frames.dropped_age;
  const std::string all = " of " + std::to_string(frames.in) + " frames";
  if (dropped > 0) {
    print_message("dropped " + std::to_string(dropped) + all + ": " + std::to_string(frames.dropped_queue) +
                  " queue, " + std::to_string(frames.dropped_age) + " age");
  }
  if (without_pose > 0) print_message(std::to_string(without_pose) + all + " have no pose");
}

std::string named(const Frame& frame, const std::string& what) {
  const std::string file = frame.file.empty() ? "" : frame.file + ": ";
  return file + "frame " + std::to_string(frame.header.seq) + ": " + what;
}

// Reports each problem for at most ten frames, so that a long stream does not fill the disk. Problems that
// differ only in numbers are one problem.
class FrameProblems {
 public:
  void report(const Frame& frame, const std::string& problem) {
    if (counts_.size() > 1000) counts_.clear();
    std::string kind;
    std::copy_if(problem.begin(), problem.end(), std::back_inserter(kind),
                 [](char c) { return c < '0' || c > '9'; });
    const std::size_t count = counts_[kind]++;
    if (count < kMaxFrames) report_problem(named(frame, problem));
    if (count == kMaxFrames) report_problem("more frames have this problem: " + problem);
  }

 private:
  static constexpr std::size_t kMaxFrames = 10;
  std::map<std::string, std::size_t> counts_;
};

// Points of one sweep of a sensor with 64 beams.
constexpr std::size_t points_of_a_sweep = 131'072;

StreamRunner::Callbacks callbacks_of(FramePipeline& pipeline, SinkGroup& sinks, const std::string& range_from,
                                     Progress& progress) {
  StreamRunner::Callbacks callbacks;
  callbacks.process = [&](const Frame& frame, FrameResult& result) { pipeline.process(frame, result); };
  callbacks.on_result = [&, last_note = std::string(), out_of_range = false](
                            const Frame& frame, const FrameResult& result) mutable {
    sinks.write(frame, result);
    if (!frame.note.empty() && frame.note != last_note) report_problem(named(frame, frame.note));
    last_note = frame.note;
    for (const std::string& warning : result.warnings)
      report_problem(named(frame, warning));
    // Report the range warning only if the frame before had none. The texts are not compared, because the
    // numbers in them change from frame to frame.
    const std::string range = range_warning(result, range_from);
    if (!range.empty() && !out_of_range) report_problem(named(frame, range));
    out_of_range = !range.empty();
    progress.show(frame.header.seq, result.clusters.size(), result.ms.total);
  };
  callbacks.on_lost = [&sinks, problems = std::make_shared<FrameProblems>()](const Frame& frame, Loss loss,
                                                                             const std::string& reason) {
    if (loss == Loss::error) problems->report(frame, reason);
    sinks.write_lost(frame, reason);
  };
  callbacks.on_silence = [](double seconds) {
    char line[60];
    std::snprintf(line, sizeof line, "no frame for %.1f s", seconds);
    report_problem(line);
  };
  return callbacks;
}

}  // namespace

int stream(const StreamOptions& options, const std::atomic<bool>& interrupted) {
  const std::unique_ptr<FrameSource> source = open(options);
  FramePipeline pipeline(pipeline_config(options.config));  // reads region files before outputs are opened
  pipeline.set_warnings(FrameWarnings(option_names(true)));
  SinkGroup sinks(report_problem);
  for (const SinkOptions& sink : options.sinks)
    parse_with("--sink", sink.target.string(), [&](const auto&) { sinks.add(sink); });
  sinks.offer_settings(remote_settings(pipeline, options.config));
  Progress progress;
  RunnerConfig config = options.config.runner;
  config.policy = resolved_policy(config.policy, options.rate != Rate::max);
  FrameResult reserved;
  if (options.rate != Rate::max)
    pipeline.reserve(points_of_a_sweep, reserved);  // skipped at maximum rate: would delay the first frame
  StreamRunner runner(callbacks_of(pipeline, sinks, options.range_from, progress), config,
                      std::move(reserved));
  Reader reader(options, runner, sinks, interrupted);
  reader.read(*source);
  runner.stop(StreamRunner::End::drain);
  erase_status_line();
  sinks.close();
  RunnerStats stats = runner.stats();
  stats.sinks = sinks.times();
  report_dropped_frames(stats.frames, reader.without_pose);
  if (errors_go_to_a_terminal()) report(stats);  // scripts do not get the report
  const bool no_frame = stats.frames.in == 0 && options.rate != Rate::live && !interrupted && sinks.alive();
  if (no_frame) report_problem(name_of(options) + ": no cloud");
  const bool nothing_read =
      no_frame || (stats.frames.in > 0 && stats.frames.in == stats.frames.dropped_error);
  int status = sinks.failed() || reader.failed || nothing_read ? 1 : 0;
  try {
    if (options.stats) write_file_atomically(*options.stats, stats_json(stats) + '\n');
  } catch (const IoError& error) {
    report_problem(options.stats->string() + ": " + error.what());
    status = 1;
  }
  return status;
}

}  // namespace pcl_bv::detail
