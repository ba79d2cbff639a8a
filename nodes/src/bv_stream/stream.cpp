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

// All sinks; one that cannot be written to any more is given up, and the rest goes on.
class Sinks {
 public:
  explicit Sinks(const std::vector<SinkDescription>& descriptions) {
    for (const SinkDescription& description : descriptions)
      sinks_.push_back(make_sink(description));
  }

  template <typename Do>
  void each(Do&& what) {
    for (std::unique_ptr<FrameSink>& sink : sinks_) {
      if (sink != nullptr && !attempt([&] { what(*sink); })) {
        attempt([&] { sink->close(); });  // what is written so far is made whole
        sink = nullptr;
      }
    }
    alive_ = std::any_of(sinks_.begin(), sinks_.end(), [](const auto& sink) { return sink != nullptr; });
  }

  // False if nothing more can be written. A reader who goes away is no failure, and needs no word.
  template <typename Do>
  bool attempt(Do&& what) {
    try {
      what();
    } catch (const ClosedPipe&) {
      return false;
    } catch (const IoError& error) {
      complain_once(error.what());
      return false;
    } catch (const std::exception& error) {
      complain_once(error.what());  // this frame cannot be written: others may be
    }
    return true;
  }

  bool failed() const { return failed_; }
  bool alive() const { return alive_; }

 private:
  void complain_once(const char* problem) {
    if (problem != last_problem_) complain(problem);
    last_problem_ = problem;
    failed_ = true;
  }

  std::vector<std::unique_ptr<FrameSink>> sinks_;
  std::string last_problem_;  // said once: closing fails as writing did
  std::atomic<bool> failed_{false}, alive_{true};
};

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

// Sleeps in short pieces, so that a signal is heeded.
void wait_until(Clock::time_point time, const std::atomic<bool>& interrupted) {
  while (!interrupted && Clock::now() < time)
    std::this_thread::sleep_until(std::min(time, Clock::now() + std::chrono::milliseconds(50)));
}

// As long as a clock can count, at most.
Clock::duration due_after(std::uint64_t frames, double rate_hz) {
  const double seconds = std::min(static_cast<double>(frames) / rate_hz, 1e9);
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void read_frames(const StreamOptions& options, FrameSource& source, StreamRunner& runner, const Sinks& sinks,
                 const std::atomic<bool>& interrupted) {
  const auto begin = Clock::now();
  std::uint64_t n = 0;
  for (bool more = true; more && !interrupted && sinks.alive(); ++n) {
    Frame frame;
    try {
      more = source.next(frame);
    } catch (const FrameError& error) {
      runner.report_unreadable(error.header, error.what());
      continue;
    }
    if (!more) break;
    if (options.paced) wait_until(begin + due_after(n, options.stamps.rate_hz), interrupted);
    if (!interrupted) runner.push(std::move(frame));
  }
}

void write_stats(const std::filesystem::path& file, const RunnerStats& stats) {
  try {
    make_folder_of(file);
    write_file_atomically(file, stats_json(stats) + '\n');
  } catch (const IoError& error) {
    throw IoError(file.string() + ": " + error.what());
  }
}

}  // namespace

int stream(const StreamOptions& options, const std::atomic<bool>& interrupted) {
  const std::unique_ptr<FrameSource> source = parse_with("--source", options.source, [&](const auto& name) {
    return open_source(name, options.stamps, options.loops);
  });
  Sinks sinks(options.sinks);
  FramePipeline pipeline(options.config.pipeline);
  Progress progress;
  StreamRunner::Callbacks callbacks;
  callbacks.process = [&](const Frame& frame, FrameResult& result) { pipeline.process(frame, result); };
  callbacks.on_result = [&](const FrameResult& result) {
    sinks.each([&](FrameSink& sink) { sink.write(result); });
    progress.show(result.header.seq, result.clusters.size(), result.ms.total);
  };
  callbacks.on_error = [&](const FrameHeader& header, const std::string& reason) {
    complain("frame " + std::to_string(header.seq) + ": " + reason);
    sinks.each([&](FrameSink& sink) { sink.write_error(header, reason); });
  };
  callbacks.on_silence = [](double seconds) {
    char line[60];
    std::snprintf(line, sizeof line, "no frame for %.1f s", seconds);
    complain(line);
  };
  StreamRunner runner(callbacks, options.config.runner);
  read_frames(options, *source, runner, sinks, interrupted);
  runner.stop(StreamRunner::End::drain);
  erase_status_line();
  sinks.each([](FrameSink& sink) { sink.close(); });
  const RunnerStats stats = runner.stats();
  if (options.stats) sinks.attempt([&] { write_stats(*options.stats, stats); });
  const bool nothing_read = stats.frames.in > 0 && stats.frames.in == stats.frames.dropped_error;
  return sinks.failed() || nothing_read ? 1 : 0;
}

}  // namespace pcl_bv
