// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One lock, held for a few lines: calls are worth 200 us and more.

#include "worker_pool.h"

#include <unistd.h>

#include <algorithm>
#include <exception>

namespace pcl_bv::internal {
namespace {

thread_local bool inside_pool = false;

}  // namespace

// The object stays to the end of the process: others may be in run(), or call it, while objects are
// destroyed.
WorkerPool& WorkerPool::instance() {
  static WorkerPool* const pool = new WorkerPool;
  static const End end{*pool};
  return *pool;
}

WorkerPool::End::~End() {
  if (::getpid() == pool.process_) pool.end();
}

bool WorkerPool::inside() {
  return inside_pool;
}

WorkerPool::WorkerPool() : process_(::getpid()) {}

void WorkerPool::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
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
  } catch (const std::exception&) {
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
    work_.wait(lock, [&] { return ended_ || (task = wanting()) != nullptr; });
    if (ended_) return;
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
    if (!ended_ && threads_.size() < helpers) start(helpers);
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
