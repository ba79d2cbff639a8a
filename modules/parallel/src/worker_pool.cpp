// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker_pool.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>

#include "pool_thread.h"

namespace pcl_bv::internal {
namespace {

// The process's pool, null until it is wanted. The object stays to the end of the process: others may be in
// run(), or call it, while objects are destroyed.
std::atomic<WorkerPool*> current{nullptr};

thread_local bool inside_region = false;

// A child has none of the pool's threads, one of them may have held the lock, and its condition variables
// count them as waiting. So the child leaves that pool untouched and makes its own when it wants one.
void begin_anew_in_child() {
  current = nullptr;
  inside_region = false;
}

[[maybe_unused]] const int registered = ::pthread_atfork(nullptr, nullptr, begin_anew_in_child);

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
  std::atexit(end_pool);  // a child has its parent's registration, too: end() may come twice
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

// The system may refuse a thread: then there are fewer.
void WorkerPool::start(unsigned threads) {
  const SignalsBlocked blocked;
  try {
    while (threads_.size() < threads)
      threads_.emplace_back([this] { serve(); });
  } catch (const std::exception&) {
  }
}

WorkerPool::Task* WorkerPool::wanting() {
  const auto found =
      std::find_if(tasks_.begin(), tasks_.end(), [](const Task* task) { return task->wanted > 0; });
  return found == tasks_.end() ? nullptr : *found;
}

void WorkerPool::serve() {
  schedule_as_process();
  const ParallelRegion region;
  std::unique_lock lock(mutex_);
  for (;;) {
    Task* task = nullptr;
    work_.wait(lock, [&] { return ended_ || (task = wanting()) != nullptr; });
    if (ended_) return;
    --task->wanted;
    ++task->active;
    lock.unlock();
    task->work();
    if (current != this) return;  // a child forked by work(), in which there is nobody to report to
    lock.lock();
    if (--task->active == 0) done_.notify_all();
  }
}

void WorkerPool::run(unsigned helpers, const std::function<void()>& work) {
  Task task{work, helpers, 0};
  {
    const std::lock_guard lock(mutex_);
    if (!ended_ && threads_.size() < helpers) start(helpers);
    tasks_.push_back(&task);
  }
  for (unsigned i = 0; i < helpers; ++i)
    work_.notify_one();
  {
    const ParallelRegion region;
    work();
  }
  if (current != this)
    throw std::logic_error("a child forked inside a parallel call cannot finish that call");
  std::unique_lock lock(mutex_);
  tasks_.erase(std::find(tasks_.begin(), tasks_.end(), &task));
  done_.wait(lock, [&] { return task.active == 0; });
}

}  // namespace pcl_bv::internal
