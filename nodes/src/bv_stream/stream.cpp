// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One thread reads and waits for each frame's time, the runner's one works and writes.

#include "stream.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "command/messages.h"
#include "command/values.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_sink.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::chrono::milliseconds kPatience{50};  // until a signal is heeded

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
  // Where results go to the terminal, too, they would be mixed.
  const bool terminal_ = errors_go_to_a_terminal() && isatty(STDOUT_FILENO) == 0;
};

// When frames are due. A clock cannot count beyond some centuries.
class Pace {
 public:
  explicit Pace(const StreamOptions& options) : options_(options) {}

  Clock::time_point due(const Frame& frame) {
    double step = 1 / options_.replay.rate_hz;
    if (options_.rate == Rate::recorded)
      step = std::max(1e-9 * static_cast<double>(frame.header.stamp_ns - last_stamp_ns_), 0.0);
    if (frames_++ > 0) seconds_ = std::min(seconds_ + step, 1e9);
    last_stamp_ns_ = frame.header.stamp_ns;
    return begin_ + std::chrono::duration_cast<Clock::duration>(Seconds(seconds_));
  }

 private:
  const StreamOptions& options_;
  const Clock::time_point begin_ = Clock::now();
  std::uint64_t frames_ = 0;
  std::int64_t last_stamp_ns_ = 0;
  double seconds_ = 0;
};

// The line of --report.
class Report {
 public:
  Report(double seconds, const StreamRunner& runner) : seconds_(seconds), runner_(runner) {}

  void tick() {
    if (seconds_ <= 0 || Seconds(Clock::now() - last_).count() < seconds_) return;
    last_ = Clock::now();
    const RunnerStats stats = runner_.stats();
    const FrameTotals& f = stats.frames;
    char line[200];
    std::snprintf(
        line, sizeof line,
        "%llu frames, %llu done, dropped %llu queue, %llu age, %llu error; latency p50 %.1f ms, p99 %.1f ms",
        as_printed(f.in), as_printed(f.processed), as_printed(f.dropped_queue), as_printed(f.dropped_age),
        as_printed(f.dropped_error), stats.ms.latency.percentile(0.5), stats.ms.latency.percentile(0.99));
    say(line);
  }

 private:
  static unsigned long long as_printed(std::uint64_t n) { return n; }

  const double seconds_;
  const StreamRunner& runner_;
  Clock::time_point last_ = Clock::now();
};

// What the reading thread does until the source ends, a signal comes, or nobody takes results any more.
class Reader {
 public:
  Reader(const StreamOptions& options, StreamRunner& runner, const SinkGroup& sinks,
         const std::atomic<bool>& interrupted)
      : options_(options),
        runner_(runner),
        sinks_(sinks),
        interrupted_(interrupted),
        report_(options.report_seconds, runner) {}

  void read(FrameSource& source) {
    Pace pace(options_);
    for (bool more = true; more && wanted(); report_.tick()) {
      Frame frame;
      try {
        const Next next = source.next(frame, kPatience);
        more = next != Next::end;
        if (next == Next::frame) hand_over(std::move(frame), pace);
      } catch (const FrameError& error) {
        runner_.report_unreadable(error.frame, error.reason);
      } catch (const std::exception& error) {
        runner_.report_unreadable({}, std::string("the source ends: ") + error.what());
        failed_ = true;
        return;
      }
    }
  }

  std::uint64_t without_pose() const { return without_pose_; }
  bool failed() const { return failed_; }

 private:
  bool wanted() const { return !interrupted_ && sinks_.alive(); }

  void hand_over(Frame frame, Pace& pace) {
    if (options_.rate != Rate::max) {
      frame.taken = pace.due(frame);
      for (; wanted() && Clock::now() < frame.taken; report_.tick())
        std::this_thread::sleep_until(std::min(frame.taken, Clock::now() + kPatience));
    }
    if (!wanted()) return;
    without_pose_ += !options_.replay.poses.empty() && !frame.pose;
    runner_.push(std::move(frame));
  }

  const StreamOptions& options_;
  StreamRunner& runner_;
  const SinkGroup& sinks_;
  const std::atomic<bool>& interrupted_;
  Report report_;
  std::uint64_t without_pose_ = 0;
  bool failed_ = false;
};

bool write_stats(const std::filesystem::path& file, const RunnerStats& stats) {
  try {
    write_file_atomically(file, stats_json(stats) + '\n');
    return true;
  } catch (const std::exception& error) {
    complain(file.string() + ": " + error.what());
    return false;
  }
}

// Errors have had their lines.
void say_what_is_missing(const FrameTotals& frames, const Reader& reader) {
  const auto of = [](std::uint64_t n, std::uint64_t all) {
    return std::to_string(n) + " of " + std::to_string(all) + " frames";
  };
  if (const std::uint64_t dropped = frames.dropped_queue + frames.dropped_age; dropped > 0) {
    say("dropped " + of(dropped, frames.in) + ": " + std::to_string(frames.dropped_queue) + " queue, " +
        std::to_string(frames.dropped_age) + " age");
  }
  if (reader.without_pose() > 0) say(of(reader.without_pose(), frames.in) + " have no pose");
}

StreamRunner::Callbacks callbacks_of(FramePipeline& pipeline, SinkGroup& sinks, Progress& progress) {
  StreamRunner::Callbacks callbacks;
  callbacks.process = [&](const Frame& frame, FrameResult& result) { pipeline.process(frame, result); };
  callbacks.on_result = [&](const Frame& frame, const FrameResult& result) {
    sinks.write(frame, result);
    progress.show(frame.header.seq, result.clusters.size(), result.ms.total);
  };
  callbacks.on_lost = [&](const Frame& frame, Loss loss, const std::string& reason) {
    const std::string file = frame.file.empty() ? "" : frame.file + ": ";
    if (loss == Loss::error) complain(file + "frame " + std::to_string(frame.header.seq) + ": " + reason);
    sinks.write_lost(frame, reason);
  };
  callbacks.on_silence = [](double seconds) {
    char line[60];
    std::snprintf(line, sizeof line, "no frame for %.1f s", seconds);
    complain(line);
  };
  return callbacks;
}

}  // namespace

int stream(const StreamOptions& options, const std::atomic<bool>& interrupted) {
  const std::unique_ptr<FrameSource> source = parse_with(
      "--source", options.source, [&](const auto& name) { return open_source(name, options.replay); });
  SinkGroup sinks(complain);
  for (const SinkDescription& sink : options.sinks)
    sinks.add(sink);
  FramePipeline pipeline(options.config.pipeline);
  Progress progress;
  RunnerConfig config = options.config.runner;
  config.policy = resolved(config.policy, options.rate != Rate::max);
  StreamRunner runner(callbacks_of(pipeline, sinks, progress), config);
  Reader reader(options, runner, sinks, interrupted);
  reader.read(*source);
  runner.stop(StreamRunner::End::drain);
  erase_status_line();
  sinks.close();
  RunnerStats stats = runner.stats();
  stats.sinks = sinks.times();
  say_what_is_missing(stats.frames, reader);
  const bool written = !options.stats || write_stats(*options.stats, stats);
  const bool nothing_read = stats.frames.in > 0 && stats.frames.in == stats.frames.dropped_error;
  return sinks.failed() || !written || reader.failed() || nothing_read ? 1 : 0;
}

}  // namespace pcl_bv
