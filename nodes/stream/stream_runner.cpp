// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The runner has one worker thread, one mutex for all state, and two condition variables.

#include "pcl_bv/nodes/stream_runner.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>

#include "pcl_bv/io/untrusted_text.h"
#include "pipeline/config/check.h"

namespace pcl_bv {
using namespace detail;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxUnreported = 1000;

double milliseconds(Clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

// Returns the message of the exception that `what` throws. If `what` throws nothing, returns nullopt.
template <typename Do>
std::optional<std::string> exception_message(Do&& what) {
  try {
    what();
  } catch (const std::exception& error) {
    return reason_of(error);
  } catch (...) {
    return "an exception that is no std::exception";
  }
  return std::nullopt;
}

}  // namespace

struct StreamRunner::State {
  struct QueuedFrame {
    Frame frame;
    Clock::time_point since;
  };
  struct Lost {
    Frame frame;  // without its points
    Loss loss;
    std::string reason;
  };
  using Task = std::variant<std::monostate, QueuedFrame, Lost>;

  bool full() const { return frames.size() >= config.queue; }
  bool in_worker() const { return std::this_thread::get_id() == worker_id; }

  State(Callbacks c, const RunnerConfig& r, FrameResult reserved)
      : callbacks(std::move(c)), config(r), result(std::move(reserved)) {}

  void run();
  Task take();
  void work_on(const QueuedFrame& queued);
  void report_loss(const Frame& frame, Loss loss, const std::string& reason);
  template <typename Do>
  void call_guarded(Do&& callback);
  void count_arrival();
  void count(Loss loss);
  void record_loss(const Frame& frame, Loss loss, std::string reason);
  void wait_for_work(std::unique_lock<std::mutex>& lock);

  const Callbacks callbacks;
  const RunnerConfig config;

  mutable std::mutex mutex;
  mutable std::condition_variable arrived;
  mutable std::condition_variable not_full;  // also signalled when the worker is idle
  std::deque<QueuedFrame> frames;            // `frames` and `losses` are both sorted by frame number
  std::deque<Lost> losses;
  std::uint64_t next_number = 0;
  std::size_t lost_while_ending = 0;
  bool ending = false, ended = false, working = false, silence_reported = false;
  Clock::time_point last_arrival = Clock::now();
  RunnerStats stats;

  FrameResult result;  // used by the worker thread only
  std::thread worker;
  std::thread::id worker_id;
  std::mutex join_mutex;
};

// Runs a callback. If the callback throws, counts the exception in callback_errors and drops no frame.
template <typename Do>
void StreamRunner::State::call_guarded(Do&& callback) {
  if (!exception_message(callback)) return;
  const std::lock_guard lock(mutex);
  ++stats.callback_errors;
}

// Waits for a frame, a lost frame or the end. Calls on_silence once if no frame comes for watchdog_s.
void StreamRunner::State::wait_for_work(std::unique_lock<std::mutex>& lock) {
  const auto something = [this] { return ending || !frames.empty() || !losses.empty(); };
  if (config.watchdog_s <= 0) return arrived.wait(lock, something);
  const auto timeout = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::min(config.watchdog_s, 1e6)));
  while (!something()) {
    if (silence_reported) {
      arrived.wait(lock, something);
    } else if (!arrived.wait_until(lock, last_arrival + timeout, something)) {
      silence_reported = true;
      const double silent = milliseconds(Clock::now() - last_arrival) / 1000;
      lock.unlock();
      if (callbacks.on_silence) call_guarded([&] { callbacks.on_silence(silent); });
      lock.lock();
    }
  }
}

// Waits as wait_for_work() does. Then returns the frame or lost frame with the smallest number, or monostate
// at the end.
StreamRunner::State::Task StreamRunner::State::take() {
  std::unique_lock lock(mutex);
  working = false;
  not_full.notify_all();
  wait_for_work(lock);
  Task task;
  if (!losses.empty() &&
      (frames.empty() || losses.front().frame.header.number < frames.front().frame.header.number)) {
    task = std::move(losses.front());
    losses.pop_front();
  } else if (!frames.empty()) {
    QueuedFrame queued = std::move(frames.front());
    frames.pop_front();
    const double age = milliseconds(Clock::now() - queued.since);
    if (config.max_age_ms > 0 && age > config.max_age_ms) {
      count(Loss::age);
      task = Lost{std::move(queued.frame), Loss::age, "dropped: age"};
    } else {
      stats.ms.wait.add(age);
      task = std::move(queued);
    }
  } else {
    ended = true;
  }
  working = !ended;
  not_full.notify_all();
  return task;
}

void StreamRunner::State::report_loss(const Frame& frame, Loss loss, const std::string& reason) {
  if (callbacks.on_lost) call_guarded([&] { callbacks.on_lost(frame, loss, reason); });
}

void StreamRunner::State::work_on(const QueuedFrame& queued) {
  const auto problem = exception_message([&] {
    callbacks.process(queued.frame, result);
    callbacks.on_result(queued.frame, result);
  });
  if (problem) {
    {
      const std::lock_guard lock(mutex);
      count(Loss::error);
    }
    return report_loss(queued.frame, Loss::error, *problem);
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
  stats.ms.latency.add(milliseconds(Clock::now() - queued.frame.taken));
}

void StreamRunner::State::run() {
  {
    const std::lock_guard lock(mutex);
    worker_id = std::this_thread::get_id();
  }
  for (;;) {
    const Task task = take();  // declared in the loop: its points are freed before the next wait
    if (const auto* queued = std::get_if<QueuedFrame>(&task)) {
      work_on(*queued);
    } else if (const auto* lost = std::get_if<Lost>(&task)) {
      report_loss(lost->frame, lost->loss, lost->reason);
    } else {
      return;
    }
  }
}

// State::count_arrival(), count() and record_loss() must be called with `mutex` locked.
void StreamRunner::State::count_arrival() {
  ++stats.frames.in;
  last_arrival = Clock::now();
  silence_reported = false;
}

void StreamRunner::State::count(Loss loss) {
  FrameTotals& totals = stats.frames;
  ++(loss == Loss::queue ? totals.dropped_queue
     : loss == Loss::age ? totals.dropped_age
                         : totals.dropped_error);
}

// Copies only the header and the file name of the frame. The caller frees the points after unlocking the
// mutex.
void StreamRunner::State::record_loss(const Frame& frame, Loss loss, std::string reason) {
  count(loss);
  if (ended || losses.size() >= kMaxUnreported || (ending && ++lost_while_ending > kMaxUnreported)) return;
  Lost lost{{}, loss, std::move(reason)};
  lost.frame.header = frame.header;
  lost.frame.file = frame.file;
  const auto later = [](std::uint64_t number, const Lost& other) {
    return number < other.frame.header.number;
  };
  losses.insert(std::upper_bound(losses.begin(), losses.end(), frame.header.number, later), std::move(lost));
  arrived.notify_one();
}

StreamRunner::StreamRunner(Callbacks callbacks, const RunnerConfig& config)
    : StreamRunner(std::move(callbacks), config, FrameResult()) {}

StreamRunner::StreamRunner(Callbacks callbacks, const RunnerConfig& config, FrameResult reserved) {
  throw_if_any(problems_of(config));
  require(callbacks.process && callbacks.on_result, "a StreamRunner needs process and on_result");
  state_ = std::make_unique<State>(std::move(callbacks), config, std::move(reserved));
  state_->worker = std::thread([state = state_.get()] { state->run(); });
}

StreamRunner::~StreamRunner() {
  stop(End::discard);
}

bool StreamRunner::push(Frame frame) {
  require(frame.points.count == 0 || frame.owner != nullptr,
          "StreamRunner::push: the frame has points but no owner");
  State& s = *state_;
  if (frame.taken == Clock::time_point()) frame.taken = Clock::now();
  State::QueuedFrame oldest;  // declared before `lock`: its points are freed after unlocking
  std::unique_lock lock(s.mutex);
  s.count_arrival();
  const bool block = s.config.policy == QueuePolicy::block;
  if (block && !s.in_worker()) s.not_full.wait(lock, [&s] { return s.ending || !s.full(); });
  frame.header.number = s.next_number++;
  const bool drops_itself = block || s.config.policy == QueuePolicy::drop_newest;
  if (s.ending || (s.full() && drops_itself)) {
    s.record_loss(frame, Loss::queue, "dropped: queue");
    return false;
  }
  if (s.full()) {
    oldest = std::move(s.frames.front());
    s.frames.pop_front();
    s.record_loss(oldest.frame, Loss::queue, "dropped: queue");
  }
  s.frames.push_back({std::move(frame), Clock::now()});
  s.arrived.notify_one();
  return true;
}

void StreamRunner::report_unreadable(Frame frame, std::string reason) {
  State& s = *state_;
  std::unique_lock lock(s.mutex);
  s.count_arrival();
  if (!s.in_worker()) s.not_full.wait(lock, [&s] { return s.ending || s.losses.size() < kMaxUnreported; });
  frame.header.number = s.next_number++;
  s.record_loss(frame, Loss::error, std::move(reason));
}

bool StreamRunner::wait_idle(Clock::time_point until) const {
  const State& s = *state_;
  std::unique_lock lock(s.mutex);
  return s.not_full.wait_until(lock, until, [&s] { return s.frames.empty() && !s.working; });
}

void StreamRunner::stop(End end) {
  State& s = *state_;
  std::deque<State::QueuedFrame> discarded;
  bool from_callback = false;
  {
    const std::lock_guard lock(s.mutex);
    from_callback = s.in_worker();
    if (end == End::discard) {
      discarded.swap(s.frames);
      for (const State::QueuedFrame& queued : discarded)
        s.record_loss(queued.frame, Loss::queue, "dropped: queue");
    }
    s.ending = true;
  }
  s.arrived.notify_all();
  s.not_full.notify_all();
  if (from_callback) return;  // the worker cannot join itself
  const std::lock_guard joining(s.join_mutex);
  if (s.worker.joinable()) s.worker.join();
}

RunnerStats StreamRunner::stats() const {
  const std::lock_guard lock(state_->mutex);
  return state_->stats;
}

}  // namespace pcl_bv
