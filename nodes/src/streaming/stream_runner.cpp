// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One mutex, two conditions, one worker.

#include "pcl_bv/nodes/stream_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace pcl_bv {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace

struct StreamRunner::State {
  struct Waiting {
    Frame frame;
    Clock::time_point since;
    std::optional<std::string> unreadable;  // then there is no frame but its header
  };

  bool full() const { return frames_waiting >= config.queue; }
  bool in_worker() const { return std::this_thread::get_id() == worker_id; }

  State(Callbacks c, const RunnerConfig& r) : callbacks(std::move(c)), config(r) {}

  void run();
  bool take(Waiting& taken);
  void work_on(const Waiting& waiting);
  void lost(const FrameHeader& header, const std::string& reason);
  void came();
  void watch(std::unique_lock<std::mutex>& lock);

  const Callbacks callbacks;
  const RunnerConfig config;

  mutable std::mutex mutex;
  std::condition_variable arrived, room;
  std::deque<Waiting> queue;
  std::size_t frames_waiting = 0;  // of the queue; the others could not be read
  bool ending = false, discarding = false, silence_told = false;
  Clock::time_point last_arrival = Clock::now();
  RunnerStats stats;

  FrameResult result;  // of the worker only
  std::thread worker;
  std::thread::id worker_id;
  std::mutex join_mutex;
};

// Waits for the next frame, and says so once if it takes too long.
void StreamRunner::State::watch(std::unique_lock<std::mutex>& lock) {
  const auto something = [this] { return ending || !queue.empty(); };
  if (config.watchdog_s <= 0) return arrived.wait(lock, something);
  const auto patience = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::min(config.watchdog_s, 1e6)));
  while (!something()) {
    if (silence_told) {
      arrived.wait(lock, something);
    } else if (!arrived.wait_until(lock, last_arrival + patience, something)) {
      silence_told = true;
      const double silent = milliseconds(Clock::now() - last_arrival) / 1000;
      lock.unlock();
      if (callbacks.on_silence) callbacks.on_silence(silent);
      lock.lock();
    }
  }
}

// The next frame that is not too old; false at the end.
bool StreamRunner::State::take(Waiting& taken) {
  std::unique_lock lock(mutex);
  for (;;) {
    watch(lock);
    if (discarding || queue.empty()) return false;
    taken = std::move(queue.front());
    queue.pop_front();
    room.notify_all();
    if (taken.unreadable) return true;
    --frames_waiting;
    const double age = milliseconds(Clock::now() - taken.since);
    if (config.max_age_ms > 0 && age > config.max_age_ms) {
      ++stats.frames.dropped_age;
      continue;
    }
    stats.ms.wait.add(age);
    return true;
  }
}

void StreamRunner::State::lost(const FrameHeader& header, const std::string& reason) {
  {
    const std::lock_guard lock(mutex);
    ++stats.frames.dropped_error;
  }
  if (callbacks.on_error) callbacks.on_error(header, reason);
}

void StreamRunner::State::work_on(const Waiting& waiting) {
  try {
    callbacks.process(waiting.frame, result);
    callbacks.on_result(result);
  } catch (const std::exception& error) {
    return lost(waiting.frame.header, error.what());
  } catch (...) {
    return lost(waiting.frame.header, "an exception that is no std::exception");
  }
  const std::lock_guard lock(mutex);
  const StageTimes& ms = result.ms;
  ++stats.frames.processed;
  stats.ms.decode.add(ms.decode);
  stats.ms.filter.add(ms.filter);
  stats.ms.ground.add(ms.ground);
  stats.ms.cluster.add(ms.cluster);
  stats.ms.fit.add(ms.fit);
  stats.ms.track.add(ms.track);
  stats.ms.total.add(ms.total);
}

void StreamRunner::State::run() {
  {
    const std::lock_guard lock(mutex);
    worker_id = std::this_thread::get_id();
  }
  Waiting waiting;
  while (take(waiting)) {
    if (waiting.unreadable) {
      lost(waiting.frame.header, *waiting.unreadable);
    } else {
      work_on(waiting);
    }
    waiting = Waiting();  // its cloud is not kept until the next one comes
  }
}

void StreamRunner::State::came() {
  ++stats.frames.in;
  last_arrival = Clock::now();
  silence_told = false;
}

StreamRunner::StreamRunner(Callbacks callbacks, const RunnerConfig& config) {
  require(config.queue > 0, "runner.queue: 0 is not at least 1");
  require(config.max_age_ms >= 0, "runner.max_age_ms: is not at least 0");
  require(config.watchdog_s >= 0, "runner.watchdog_s: is not at least 0");
  require(callbacks.process && callbacks.on_result, "a StreamRunner needs process and on_result");
  state_ = std::make_unique<State>(std::move(callbacks), config);
  state_->worker = std::thread([state = state_.get()] { state->run(); });
}

StreamRunner::~StreamRunner() {
  stop(End::discard);
}

bool StreamRunner::push(Frame frame) {
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  s.came();
  const bool block = s.config.policy == QueuePolicy::block;
  if (block && !s.in_worker()) s.room.wait(lock, [&s] { return s.ending || !s.full(); });
  if (s.ending || (s.full() && s.config.policy != QueuePolicy::drop_oldest)) {
    ++s.stats.frames.dropped_queue;
    return false;
  }
  Frame dropped;  // freed without the lock
  if (s.full()) {
    const auto oldest =
        std::find_if(s.queue.begin(), s.queue.end(), [](const auto& waiting) { return !waiting.unreadable; });
    dropped = std::move(oldest->frame);
    s.queue.erase(oldest);
    --s.frames_waiting;
    ++s.stats.frames.dropped_queue;
  }
  s.queue.push_back({std::move(frame), Clock::now(), std::nullopt});
  ++s.frames_waiting;
  s.arrived.notify_one();
  lock.unlock();
  return true;
}

void StreamRunner::report_unreadable(const FrameHeader& header, const std::string& reason) {
  constexpr std::size_t many = 1000;
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  s.came();
  if (!s.in_worker()) {
    s.room.wait(lock, [&s] { return s.ending || s.queue.size() < s.config.queue + many; });
  }
  if (s.ending) {
    lock.unlock();
    return s.lost(header, reason);
  }
  Frame frame;
  frame.header = header;
  s.queue.push_back({std::move(frame), Clock::now(), reason});
  s.arrived.notify_one();
}

void StreamRunner::stop(End end) {
  State& s = *state_;
  bool from_callback = false;
  {
    const std::lock_guard lock(s.mutex);
    from_callback = s.in_worker();
    s.ending = true;
    if (end == End::discard) {
      s.discarding = true;
      s.stats.frames.dropped_queue += s.frames_waiting;
      s.stats.frames.dropped_error += s.queue.size() - s.frames_waiting;
      s.frames_waiting = 0;
      s.queue.clear();
    }
  }
  s.arrived.notify_all();
  s.room.notify_all();
  if (from_callback) return;  // it ends after the callback
  const std::lock_guard joining(s.join_mutex);
  if (s.worker.joinable()) s.worker.join();
}

RunnerStats StreamRunner::stats() const {
  const std::lock_guard lock(state_->mutex);
  return state_->stats;
}

}  // namespace pcl_bv
