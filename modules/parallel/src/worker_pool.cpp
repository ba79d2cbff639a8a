// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker_pool.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>

#include "pool_thread.h"

namespace pcl_bv::detail {
namespace {

// The pool of the process; null until a pool is first needed. The pool is never deleted, because other
// threads may still use WorkerPool::run() while static objects are destroyed.
std::atomic<WorkerPool*> current{nullptr};

thread_local bool inside_region = false;

// The time for which a thread spins before it sleeps. It is longer than the pause between two consecutive
// parallel stages of a frame.
constexpr std::chrono::milliseconds kSpinTime{2};

// Spins until the condition holds, but for at most kSpinTime. Returns whether the condition holds.
template <typename Condition>
bool spin_until(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + kSpinTime;
  for (unsigned i = 1; !condition(); ++i) {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
    if (i % 256 == 0 && std::chrono::steady_clock::now() > end) return false;
  }
  return true;
}

// A forked child does not have the threads of the parent's pool. One of these threads may have held the
// pool's lock at the time of the fork, and the pool's condition variables still count the threads as waiting.
// So the child never touches the parent's pool, and makes a new pool when it needs one.
void reset_in_child() {
  current = nullptr;
  inside_region = false;
}

[[maybe_unused]] const int registered = ::pthread_atfork(nullptr, nullptr, reset_in_child);

void end_pool() {
  if (WorkerPool* const pool = current) pool->end();
}

}  // namespace

ParallelRegion::ParallelRegion() {
  inside_region = true;
}

ParallelRegion::~ParallelRegion() {
  inside_region = false;
}

bool ParallelRegion::inside() {
  return inside_region;
}

WorkerPool& WorkerPool::instance() {
  WorkerPool* pool = current;
  if (pool != nullptr) return *pool;
  auto fresh = std::make_unique<WorkerPool>();
  if (!current.compare_exchange_strong(pool, fresh.get())) return *pool;
  // A forked child inherits this registration and adds its own, so end_pool() may be called twice.
  std::atexit(end_pool);
  return *fresh.release();
}

void WorkerPool::end() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(ended_, true)) return;
  }
  work_.notify_all();
  for (std::thread& thread : threads_)
    thread.join();
}

// If the system refuses a thread, the pool continues with fewer threads.
void WorkerPool::start(unsigned threads) {
  const SignalsBlocked blocked;
  try {
    while (threads_.size() < threads)
      threads_.emplace_back([this] { serve(); });
  } catch (const std::exception&) {
  }
}

// Makes the pool's threads avoid `processor`, the one on which the caller works; -1 allows all processors.
// Some systems run threads on as few processors as possible, to save power or to pack virtual machines. Such
// a system wakes a helper on the caller's processor. The helper then waits for milliseconds until the caller
// stops, while other processors are idle.
void WorkerPool::exclude_processor(int processor) {
  if (std::exchange(avoided_, processor) != processor) avoid_processor(processor, threads_);
}

WorkerPool::Task* WorkerPool::find_open_task() {
  const auto found =
      std::find_if(tasks_.begin(), tasks_.end(), [](const Task* task) { return task->wanted > 0; });
  return found == tasks_.end() ? nullptr : *found;
}

// Spins until run() offers the next task. Returns false if no task is offered within kSpinTime, or if no
// SpinningThreads object exists any more. Spinning is worthwhile because waking a sleeping thread takes 25
// us, and a stage of a frame may take no longer than that.
bool WorkerPool::spin_for_task(std::unique_lock<std::mutex>& lock) {
  const std::uint64_t seen = run_count_;
  ++spinning_;
  lock.unlock();
  spin_until([&] { return run_count_ != seen || spin_requests_ == 0; });
  lock.lock();
  --spinning_;
  return run_count_ != seen;
}

void WorkerPool::serve() {
  const ParallelRegion region;
  std::unique_lock lock(mutex_);
  adopt_main_thread_scheduling(avoided_);
  for (;;) {
    Task* task = find_open_task();
    while (task == nullptr && !ended_ && spin_requests_ > 0 && spinning_ < max_spinning_ &&
           spin_for_task(lock))
      task = find_open_task();
    if (task == nullptr) {
      const std::uint64_t requests = spin_request_count_;
      work_.wait(lock, [&] {
        return ended_ || spin_request_count_ != requests || (task = find_open_task()) != nullptr;
      });
    }
    if (ended_) return;
    if (task == nullptr) continue;
    --task->wanted;
    ++task->active;
    lock.unlock();
    task->work();
    if (current != this) return;  // in a child forked by work(): there is no caller to notify
    lock.lock();
    if (--task->active == 0) done_.notify_all();  // after this, run() may destroy the task at any time
  }
}

void WorkerPool::start_spinning(unsigned helpers) {
  {
    const std::lock_guard lock(mutex_);
    if (!ended_ && threads_.size() < helpers) start(helpers);
    if (tasks_.empty()) exclude_processor(current_processor());
    max_spinning_ = std::max(max_spinning_, helpers);
    ++spin_requests_;
    ++spin_request_count_;
  }
  work_.notify_all();
}

void WorkerPool::stop_spinning(WorkerPool* pool) {
  if (current != pool) return;
  const std::lock_guard lock(pool->mutex_);
  if (--pool->spin_requests_ == 0) pool->max_spinning_ = 0;
}

void WorkerPool::run(unsigned helpers, const std::function<void()>& work) {
  Task task{work, helpers, 0};
  unsigned sleeping = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!ended_ && threads_.size() < helpers) start(helpers);
    if (tasks_.empty()) exclude_processor(current_processor());
    tasks_.push_back(&task);
    ++run_count_;
    sleeping = helpers - std::min(helpers, spinning_);
  }
  for (unsigned i = 0; i < sleeping; ++i)
    work_.notify_one();
  {
    const ParallelRegion region;
    work();
  }
  if (current != this)
    throw std::logic_error("a forked child must not return from the body of a parallel call");
  std::unique_lock lock(mutex_);
  tasks_.erase(std::find(tasks_.begin(), tasks_.end(), &task));
  if (spin_requests_ > 0 && task.active > 0) {
    lock.unlock();
    spin_until([&] { return task.active == 0; });
    lock.lock();
  }
  const auto done = [&] { return task.active == 0; };
  if (done_.wait_for(lock, kSpinTime, done)) return;
  // Helpers may now use the caller's processor too. The caller's processor is free while the caller waits,
  // and the other processors may be busy.
  exclude_processor(-1);
  done_.wait(lock, done);
}

}  // namespace pcl_bv::detail
