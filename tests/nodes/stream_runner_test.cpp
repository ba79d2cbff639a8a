// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/stream_runner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

namespace pcl_bv::detail {
namespace {

using End = StreamRunner::End;
using std::chrono::milliseconds;

// A work that waits for permission: makes what is in the queue at any moment known.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_ || permits_ > 0; });
    if (!open_) --permits_;
  }
  void let_pass(int n) {
    const std::lock_guard lock(mutex_);
    permits_ += n;
    changed_.notify_all();
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  void await_arrivals(int n) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ >= n; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int waiting_ = 0, permits_ = 0;
  bool open_ = false;
};

struct Recorder {
  std::mutex mutex;
  std::vector<std::uint64_t> results, errors, numbers;
  std::vector<std::string> reasons, dropped, files;
  std::set<std::thread::id> threads;
};

Frame frame(std::uint64_t seq) {
  Frame f;
  f.header.seq = seq;
  return f;
}

StreamRunner::Callbacks recording(Recorder& out, Gate* gate = nullptr) {
  StreamRunner::Callbacks callbacks;
  callbacks.process = [gate](const Frame& f, FrameResult& result) {
    if (gate != nullptr) gate->pass();
    result = FrameResult();
    result.header = f.header;
    result.ms.total = 1;
  };
  callbacks.on_result = [&out](const Frame& f, const FrameResult&) {
    const std::lock_guard lock(out.mutex);
    out.threads.insert(std::this_thread::get_id());
    out.results.push_back(f.header.seq);
    out.numbers.push_back(f.header.number);
  };
  callbacks.on_lost = [&out](const Frame& f, Loss loss, const std::string& reason) {
    const std::lock_guard lock(out.mutex);
    out.threads.insert(std::this_thread::get_id());
    out.numbers.push_back(f.header.number);
    out.files.push_back(f.file);
    if (loss != Loss::error) {
      out.dropped.push_back(reason + ' ' + std::to_string(f.header.seq));
    } else {
      out.errors.push_back(f.header.seq);
      out.reasons.push_back(reason);
    }
  };
  return callbacks;
}

RunnerConfig with(std::size_t queue, QueuePolicy policy) {
  RunnerConfig config;
  config.queue = queue;
  config.policy = policy;
  return config;
}

void expect_balance(const FrameTotals& f) {
  EXPECT_EQ(f.in, f.processed + f.dropped_queue + f.dropped_age + f.dropped_error);
}

// Every frame is told of once, in the order of its number, by one thread that is not this one.
void expect_in_order(const Recorder& out, std::size_t frames) {
  ASSERT_EQ(out.numbers.size(), frames);
  for (std::size_t i = 0; i < frames; ++i)
    EXPECT_EQ(out.numbers[i], i);
  EXPECT_EQ(out.threads.size(), 1U);
  EXPECT_EQ(out.threads.count(std::this_thread::get_id()), 0U);
}

TEST(StreamRunner, DropOldestKeepsTheNewestAndCountsTheRest) {
  Gate gate;
  Recorder out;
  StreamRunner runner(recording(out, &gate), with(2, QueuePolicy::drop_oldest));
  EXPECT_TRUE(runner.push(frame(0)));
  gate.await_arrivals(1);  // 0 is in work, the queue is empty
  for (std::uint64_t i = 1; i <= 10; ++i)
    EXPECT_TRUE(runner.push(frame(i)));
  gate.open();
  runner.stop(End::drain);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0, 9, 10}));
  const FrameTotals totals = runner.stats().frames;
  EXPECT_EQ(totals.in, 11U);
  EXPECT_EQ(totals.processed, 3U);
  EXPECT_EQ(totals.dropped_queue, 8U);
  expect_balance(totals);
  ASSERT_EQ(out.dropped.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(out.dropped[i], "dropped: queue " + std::to_string(i + 1));
  expect_in_order(out, 11);
}

TEST(StreamRunner, DropNewestKeepsWhatWaitsAndSaysSo) {
  Gate gate;
  Recorder out;
  StreamRunner runner(recording(out, &gate), with(2, QueuePolicy::drop_newest));
  runner.push(frame(0));
  gate.await_arrivals(1);
  EXPECT_TRUE(runner.push(frame(1)));
  EXPECT_TRUE(runner.push(frame(2)));
  EXPECT_FALSE(runner.push(frame(3)));
  EXPECT_FALSE(runner.push(frame(4)));
  gate.open();
  runner.stop(End::drain);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(runner.stats().frames.dropped_queue, 2U);
  expect_balance(runner.stats().frames);
  EXPECT_EQ(out.dropped, (std::vector<std::string>{"dropped: queue 3", "dropped: queue 4"}));
  expect_in_order(out, 5);
}

TEST(StreamRunner, BlockLosesNothingUnderASlowWork) {
  Recorder out;
  StreamRunner::Callbacks callbacks = recording(out);
  callbacks.process = [](const Frame& f, FrameResult& result) {
    std::this_thread::sleep_for(milliseconds(1));
    result.header = f.header;
  };
  StreamRunner runner(callbacks, with(1, QueuePolicy::block));
  for (std::uint64_t i = 0; i < 50; ++i)
    EXPECT_TRUE(runner.push(frame(i)));
  runner.stop(End::drain);
  ASSERT_EQ(out.results.size(), 50U);
  for (std::uint64_t i = 0; i < 50; ++i)
    EXPECT_EQ(out.results[i], i);
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, AStopFreesASenderThatWaitsForRoom) {
  Gate gate;
  Recorder out;
  StreamRunner runner(recording(out, &gate), with(1, QueuePolicy::block));
  runner.push(frame(0));
  gate.await_arrivals(1);
  runner.push(frame(1));
  std::atomic<bool> accepted{true};
  std::thread sender([&] { accepted = runner.push(frame(2)); });  // no room
  std::this_thread::sleep_for(milliseconds(20));
  std::thread stopper([&] { runner.stop(End::discard); });
  sender.join();
  EXPECT_FALSE(accepted);
  gate.open();
  stopper.join();
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0}));
  EXPECT_EQ(runner.stats().frames.dropped_queue, 2U);
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, FramesOlderThanTheMaximumAgeAreDroppedAndCounted) {
  Gate gate;
  Recorder out;
  RunnerConfig config = with(5, QueuePolicy::block);
  config.max_age_ms = 30;
  StreamRunner runner(recording(out, &gate), config);
  runner.push(frame(0));
  gate.await_arrivals(1);
  runner.push(frame(1));
  runner.push(frame(2));
  std::this_thread::sleep_for(milliseconds(60));
  runner.push(frame(3));
  gate.open();
  runner.stop(End::drain);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0, 3}));
  EXPECT_EQ(runner.stats().frames.dropped_age, 2U);
  expect_balance(runner.stats().frames);
  EXPECT_EQ(out.dropped, (std::vector<std::string>{"dropped: age 1", "dropped: age 2"}));
  expect_in_order(out, 4);
}

TEST(StreamRunner, AnExceptionCostsItsFrameOnly) {
  Recorder out;
  StreamRunner::Callbacks callbacks = recording(out);
  callbacks.process = [](const Frame& f, FrameResult& result) {
    if (f.header.seq == 1) throw std::runtime_error("one is bad");
    if (f.header.seq == 2) throw 2;
    result.header = f.header;
  };
  auto record = callbacks.on_result;
  callbacks.on_result = [record](const Frame& f, const FrameResult& result) {
    if (f.header.seq == 3) throw std::runtime_error("nobody listens");
    record(f, result);
  };
  StreamRunner runner(callbacks, with(8, QueuePolicy::block));
  for (std::uint64_t i = 0; i < 5; ++i)
    runner.push(frame(i));
  runner.stop(End::drain);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0, 4}));
  EXPECT_EQ(out.errors, (std::vector<std::uint64_t>{1, 2, 3}));
  EXPECT_EQ(out.reasons[0], "one is bad");
  EXPECT_EQ(out.reasons[2], "nobody listens");
  EXPECT_EQ(runner.stats().frames.dropped_error, 3U);
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, AFrameThatItsSourceCouldNotReadIsCountedAndNamed) {
  Recorder out;
  StreamRunner runner(recording(out), with(1, QueuePolicy::block));
  Frame lost = frame(7);
  lost.file = "a.pcd";
  runner.report_unreadable(lost, "truncated");
  runner.stop(End::drain);
  EXPECT_EQ(out.errors, (std::vector<std::uint64_t>{7}));
  EXPECT_EQ(out.reasons[0], "truncated");
  EXPECT_EQ(out.files[0], "a.pcd");
  EXPECT_EQ(runner.stats().frames.in, 1U);
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, UnreadableFramesComeInTheirOrder) {
  Gate gate;
  Recorder out;
  std::vector<std::uint64_t> order;
  StreamRunner::Callbacks callbacks = recording(out, &gate);
  callbacks.on_result = [&](const Frame& f, const FrameResult&) { order.push_back(f.header.seq); };
  callbacks.on_lost = [&](const Frame& f, Loss, const std::string&) { order.push_back(f.header.seq); };
  StreamRunner runner(callbacks, with(5, QueuePolicy::drop_oldest));
  for (std::uint64_t i = 0; i < 6; ++i) {
    if (i % 2 == 0) {
      runner.push(frame(i));
    } else {
      runner.report_unreadable(frame(i), "bad");
    }
  }
  gate.open();
  runner.stop(End::drain);
  EXPECT_EQ(order, (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5}));
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, ACallbackThatPushesIntoAFullQueueDoesNotWaitForItself) {
  Gate gate;
  Recorder out;
  StreamRunner* self = nullptr;
  std::atomic<bool> accepted{true};
  StreamRunner::Callbacks callbacks = recording(out, &gate);
  callbacks.on_result = [&](const Frame& f, const FrameResult&) {
    if (f.header.seq == 0) accepted = self->push(frame(9));
  };
  StreamRunner runner(callbacks, with(1, QueuePolicy::block));
  self = &runner;
  runner.push(frame(0));
  gate.await_arrivals(1);
  runner.push(frame(1));
  gate.open();
  runner.stop(End::drain);
  EXPECT_FALSE(accepted);
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, TheTimeThatASenderIsBlockedIsNotTheFramesAge) {
  Gate gate;
  Recorder out;
  RunnerConfig config = with(1, QueuePolicy::block);
  config.max_age_ms = 40;
  StreamRunner runner(recording(out, &gate), config);
  runner.push(frame(0));
  gate.await_arrivals(1);
  std::thread sender([&] {
    runner.push(frame(1));  // waits in the queue, too long
    runner.push(frame(2));  // waits for room
  });
  std::this_thread::sleep_for(milliseconds(80));
  gate.open();
  sender.join();
  runner.stop(End::drain);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0, 2}));
  EXPECT_EQ(runner.stats().frames.dropped_age, 1U);
}

TEST(StreamRunner, DiscardDropsWhatWaitsAndFinishesWhatIsInWork) {
  Gate gate;
  Recorder out;
  StreamRunner runner(recording(out, &gate), with(9, QueuePolicy::block));
  for (std::uint64_t i = 0; i < 5; ++i)
    runner.push(frame(i));
  gate.await_arrivals(1);
  std::thread stopper([&] { runner.stop(End::discard); });
  std::this_thread::sleep_for(milliseconds(20));
  gate.open();
  stopper.join();
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0}));
  EXPECT_EQ(runner.stats().frames.dropped_queue, 4U);
  EXPECT_FALSE(runner.push(frame(9)));
  expect_balance(runner.stats().frames);
  expect_in_order(out, 5);  // what comes after the end is only counted
}

TEST(StreamRunner, TellsInItsThreadAlsoWhatComesWhileItStops) {
  Gate gate;
  Recorder out;
  StreamRunner runner(recording(out, &gate), with(2, QueuePolicy::block));
  runner.push(frame(0));
  gate.await_arrivals(1);
  runner.push(frame(1));
  std::thread stopper([&] { runner.stop(End::drain); });
  while (runner.push(frame(2))) {  // until it ends: these are processed
  }
  runner.report_unreadable(frame(3), "bad");
  gate.open();
  stopper.join();
  EXPECT_EQ(out.errors, (std::vector<std::uint64_t>{3}));
  EXPECT_EQ(out.dropped.back(), "dropped: queue 2");
  expect_in_order(out, runner.stats().frames.in);
}

TEST(StreamRunner, NumbersFramesWhateverTheirSource) {
  Recorder out;
  StreamRunner runner(recording(out), with(9, QueuePolicy::block));
  for (const std::uint64_t seq : {0, 0, 7, 7, 3})
    runner.push(frame(seq));
  runner.stop(End::drain);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0, 0, 7, 7, 3}));
  expect_in_order(out, 5);
}

TEST(StreamRunner, IsIdleWhenNothingWaitsOrIsInWork) {
  Recorder out;
  Gate gate;
  StreamRunner runner(recording(out, &gate), {2, QueuePolicy::block, 0, 0});
  const auto in = [](int ms) { return std::chrono::steady_clock::now() + milliseconds(ms); };
  EXPECT_TRUE(runner.wait_idle(in(60'000)));
  runner.push(frame(0));
  runner.push(frame(1));
  gate.await_arrivals(1);
  EXPECT_FALSE(runner.wait_idle(in(20)));
  gate.let_pass(1);
  gate.await_arrivals(2);
  EXPECT_FALSE(runner.wait_idle(in(20)));
  std::thread opener([&] { gate.open(); });
  EXPECT_TRUE(runner.wait_idle(in(60'000)));
  EXPECT_EQ(out.results.size(), 2U);
  opener.join();
  runner.stop(End::drain);
  EXPECT_TRUE(runner.wait_idle(in(60'000)));
}

TEST(StreamRunner, RefusesPointsThatNobodyKeeps) {
  Recorder out;
  StreamRunner runner(recording(out), with(9, QueuePolicy::block));
  const auto xyz = std::make_shared<std::vector<float>>(3);
  Frame f = frame(0);
  f.points = PointView::of(xyz->data(), 12, 1);
  EXPECT_THROW(runner.push(f), std::invalid_argument);
  EXPECT_EQ(runner.stats().frames.in, 0U);
  f.owner = xyz;
  EXPECT_TRUE(runner.push(f));
}

TEST(StreamRunner, ToldOfAtMostAThousandButCountsAll) {
  Gate gate;
  Recorder out;
  StreamRunner runner(recording(out, &gate), with(1, QueuePolicy::drop_newest));
  runner.push(frame(0));
  gate.await_arrivals(1);
  for (std::uint64_t i = 1; i <= 5000; ++i)
    runner.push(frame(i));
  gate.open();
  runner.stop(End::drain);
  EXPECT_EQ(out.dropped.size(), 1000U);
  EXPECT_EQ(out.dropped.back(), "dropped: queue 1001");
  EXPECT_EQ(runner.stats().frames.dropped_queue, 4999U);
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, CallbacksThatThrowCostNoFrame) {
  Recorder out;
  StreamRunner::Callbacks callbacks = recording(out);
  std::atomic<std::uint64_t> losses{0}, silences{0};
  callbacks.on_lost = [&](const Frame&, Loss, const std::string&) {
    ++losses;
    throw std::runtime_error("deaf");
  };
  callbacks.on_silence = [&](double) {
    ++silences;
    throw 3;
  };
  RunnerConfig config = with(9, QueuePolicy::block);
  config.watchdog_s = 0.01;
  StreamRunner runner(callbacks, config);
  runner.report_unreadable(frame(0), "bad");
  for (int i = 0; i < 500 && (losses < 1 || silences < 1); ++i)
    std::this_thread::sleep_for(milliseconds(10));
  runner.push(frame(1));
  runner.stop(End::drain);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{1}));
  expect_balance(runner.stats().frames);
  EXPECT_EQ(losses, 1U);
  EXPECT_GE(silences, 1U);
  EXPECT_EQ(runner.stats().callback_errors, losses + silences);
  EXPECT_EQ(nlohmann::json::parse(stats_json(runner.stats()))["callback_errors"], losses + silences);
}

TEST(StreamRunner, LatencyCountsFromWhenAFrameWasTaken) {
  Recorder out;
  StreamRunner runner(recording(out), with(9, QueuePolicy::block));
  Frame f = frame(0);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  f.taken = steady_time(std::chrono::nanoseconds(now - std::chrono::hours(1)).count());
  runner.push(f);
  runner.stop(End::drain);
  EXPECT_EQ(runner.stats().ms.latency.count(), 1U);
  EXPECT_GE(runner.stats().ms.latency.max(), 3'599'000);
}

TEST(StreamRunner, StopsTwiceFromManyThreadsAndFromItsCallback) {
  Recorder out;
  StreamRunner* self = nullptr;
  std::mutex ready;
  StreamRunner::Callbacks callbacks = recording(out);
  auto record = callbacks.on_result;
  callbacks.on_result = [&](const Frame& f, const FrameResult& result) {
    record(f, result);
    const std::lock_guard lock(ready);
    if (f.header.seq == 2) self->stop(End::discard);
  };
  StreamRunner runner(callbacks, with(100, QueuePolicy::block));
  {
    const std::lock_guard lock(ready);
    self = &runner;
  }
  for (std::uint64_t i = 0; i < 20; ++i)
    runner.push(frame(i));
  std::vector<std::thread> stoppers;
  for (int i = 0; i < 4; ++i)
    stoppers.emplace_back([&] { runner.stop(End::drain); });
  for (std::thread& t : stoppers)
    t.join();
  runner.stop(End::discard);
  EXPECT_EQ(out.results, (std::vector<std::uint64_t>{0, 1, 2}));
  expect_balance(runner.stats().frames);
}

TEST(StreamRunner, ManySendersUnderLoadLoseNoCount) {
  for (const QueuePolicy policy : {QueuePolicy::drop_oldest, QueuePolicy::drop_newest, QueuePolicy::block}) {
    Recorder out;
    StreamRunner runner(recording(out), with(3, policy));
    std::vector<std::thread> senders;
    for (std::uint64_t s = 0; s < 4; ++s) {
      senders.emplace_back([&runner, s] {
        for (std::uint64_t i = 0; i < 500; ++i)
          runner.push(frame(1000 * s + i));
      });
    }
    std::this_thread::sleep_for(milliseconds(2));
    for (std::thread& t : senders)
      t.join();
    runner.stop(End::drain);
    const FrameTotals totals = runner.stats().frames;
    EXPECT_EQ(totals.in, 2000U);
    EXPECT_EQ(totals.processed, out.results.size());
    if (policy == QueuePolicy::block) {
      EXPECT_EQ(totals.processed, 2000U);
    }
    expect_balance(totals);
  }
}

TEST(StreamRunner, ASilentSourceIsReportedOncePerSilence) {
  Recorder out;
  std::atomic<int> silences{0};
  StreamRunner::Callbacks callbacks = recording(out);
  callbacks.on_silence = [&](double seconds) {
    EXPECT_GE(seconds, 0.02);
    ++silences;
  };
  RunnerConfig config = with(1, QueuePolicy::block);
  config.watchdog_s = 0.02;
  StreamRunner runner(callbacks, config);
  const auto await = [&](int n) {
    for (int i = 0; i < 500 && silences < n; ++i)
      std::this_thread::sleep_for(milliseconds(10));
  };
  await(1);
  std::this_thread::sleep_for(milliseconds(80));
  EXPECT_EQ(silences, 1);
  runner.push(frame(0));
  await(2);
  EXPECT_EQ(silences, 2);
  runner.stop(End::drain);
}

TEST(StreamRunner, LetsGoOfACloudWhenItsFrameIsDone) {
  Recorder out;
  StreamRunner runner(recording(out), with(1, QueuePolicy::block));
  const auto cloud = std::make_shared<int>(3);
  Frame f = frame(0);
  f.owner = cloud;
  runner.push(std::move(f));
  for (int i = 0; i < 500 && cloud.use_count() > 1; ++i)
    std::this_thread::sleep_for(milliseconds(10));
  EXPECT_EQ(cloud.use_count(), 1);
}

TEST(StreamRunner, RefusesWhatCannotWork) {
  Recorder out;
  EXPECT_THROW(StreamRunner(recording(out), with(0, QueuePolicy::block)), std::invalid_argument);
  EXPECT_THROW(StreamRunner(recording(out), with(100'001, QueuePolicy::block)), std::invalid_argument);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double seconds : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    RunnerConfig late, silent;
    late.max_age_ms = silent.watchdog_s = seconds;
    EXPECT_THROW(StreamRunner(recording(out), late), std::invalid_argument) << seconds;
    EXPECT_THROW(StreamRunner(recording(out), silent), std::invalid_argument) << seconds;
  }
  EXPECT_THROW(StreamRunner({}, RunnerConfig()), std::invalid_argument);
}

TEST(StatsJson, NamesWhatBecameOfTheFrames) {
  RunnerStats stats;
  stats.frames = {10, 6, 1, 2, 1};
  stats.ms.total.add(5);
  const auto json = nlohmann::json::parse(stats_json(stats));
  EXPECT_EQ(json["frames"]["in"], 10);
  EXPECT_EQ(json["frames"]["processed"], 6);
  EXPECT_EQ(json["frames"]["dropped"]["queue"], 1);
  EXPECT_EQ(json["frames"]["dropped"]["age"], 2);
  EXPECT_EQ(json["frames"]["dropped"]["error"], 1);
  EXPECT_EQ(json["ms"]["total"]["max"], 5);
  EXPECT_EQ(json["ms"]["fit"]["p99"], 0);
}

}  // namespace
}  // namespace pcl_bv::detail
