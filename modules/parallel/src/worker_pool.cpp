// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One lock, held for a few lines: calls are worth 200 us and more.

#include "worker_pool.h"

#include <unistd.h>

#include <algorithm>
#include <system_error>

namespace pcl_bv::internal {
namespace {

thread_local bool inside_pool = false;

}  // namespace

// A fork has the pool but not its threads: there is nobody to join, and to destroy a condition that they wait
// for would wait for them.
void WorkerPool::End::operator()(WorkerPool* pool) const {
  if (::getpid() == pool->process_) delete pool;
}

WorkerPool& WorkerPool::instance() {
  static const std::unique_ptr<WorkerPool, End> pool(new WorkerPool);
  return *pool;
}

bool WorkerPool::inside() {
  return inside_pool;
}

WorkerPool::WorkerPool() : process_(::getpid()) {}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  work_.notify_all();
  for (std::thread& thread : threads_)
    thread.join();
}

// The system may refuse a thread: then there are fewer.
void WorkerPool::start(unsigned threads) {
  try {
    while (threads_.size() < threads)
      threads_.emplace_back([this] { serve(); });
  } catch (const std::system_error&) {
  }
}

WorkerPool::Task* WorkerPool::wanting() {
  const auto found =
      std::find_if(tasks_.begin(), tasks_.end(), [](const Task* task) { return task->wanted > 0; });
  return found == tasks_.end() ? nullptr : *found;
}

void WorkerPool::serve() {
  inside_pool = true;
  std::unique_lock lock(mutex_);
  for (;;) {
    Task* task = nullptr;
    work_.wait(lock, [&] { return stop_ || (task = wanting()) != nullptr; });
    if (stop_) return;
    --task->wanted;
    ++task->active;
    lock.unlock();
    task->work(task->argument);
    lock.lock();
    if (--task->active == 0) done_.notify_all();
  }
}

void WorkerPool::run(unsigned helpers, void (*work)(void*), void* argument) {
  Task task{work, argument, inside_pool ? 0 : helpers, 0};
  if (task.wanted == 0) return work(argument);
  {
    const std::lock_guard lock(mutex_);
    if (threads_.size() < helpers) start(helpers);
    tasks_.push_back(&task);
  }
  for (unsigned i = 0; i < helpers; ++i)
    work_.notify_one();
  inside_pool = true;
  work(argument);
  inside_pool = false;
  std::unique_lock lock(mutex_);
  tasks_.erase(std::find(tasks_.begin(), tasks_.end(), &task));
  done_.wait(lock, [&] { return task.active == 0; });
}

}  // namespace pcl_bv::internal
