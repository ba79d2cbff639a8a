// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/parallel/for_each_chunk.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <shared_mutex>

#include "pcl_bv/numeric/float_environment.h"
#include "worker_pool.h"

namespace pcl_bv::detail {
namespace {

// Hands out chunk numbers. If bodies fail, stores the exception of the failed chunk with the lowest number.
class ChunkQueue {
 public:
  ChunkQueue(std::size_t chunks, const std::function<void(std::size_t)>& body)
      : chunks_(chunks), body_(body) {}

  // Bodies run in IEEE's default floating-point environment, even if the host or a thread of an executor has
  // set another one.
  void work() {
    const FloatEnvironment environment;
    for (std::size_t chunk; (chunk = next_.fetch_add(1, std::memory_order_relaxed)) < chunks_;) {
      try {
        body_(chunk);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_ || chunk < failed_chunk_) {
          failure_ = std::current_exception();
          failed_chunk_ = chunk;
        }
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const std::size_t chunks_;
  const std::function<void(std::size_t)>& body_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t failed_chunk_ = 0;
};

// ThreadSanitizer does not understand libgomp's barriers and would report false races. With ThreadSanitizer,
// OpenMP policies run on the library's own threads.
#if defined(__SANITIZE_THREAD__)
constexpr bool kUseOpenMp = false;
#else
constexpr bool kUseOpenMp = true;
#endif

void work_with_openmp(ChunkQueue& queue, unsigned threads) {
#pragma omp parallel num_threads(static_cast <int>(threads))
  queue.work();
}

// State shared by a parallel region and the tasks of its executor. The region and the tasks own the state
// together, because the executor may call tasks after the region has ended.
class TaskQueue {
 public:
  explicit TaskQueue(ChunkQueue& queue) : queue_(&queue) {}

  // Runs one task. Does nothing on a thread that is already inside a parallel region: a body on this thread
  // may be waiting for the executor, and the executor may use the thread for this task meanwhile. The task
  // would then overwrite the thread's buffers, which the waiting body still uses.
  void help() {
    if (ParallelRegion::inside()) return;
    const std::shared_lock working(mutex_, std::try_to_lock);
    if (!working || queue_ == nullptr) return;
    const ParallelRegion region;
    queue_->work();
  }

  // Waits for the tasks that have begun. Tasks called later do nothing.
  void close() {
    const std::lock_guard lock(mutex_);
    queue_ = nullptr;
  }

 private:
  std::shared_mutex mutex_;
  ChunkQueue* queue_;
};

void work_with_executor(ChunkQueue& queue, const Executor& executor, unsigned threads) {
  const auto tasks = std::make_shared<TaskQueue>(queue);
  const std::unique_ptr<TaskQueue, void (*)(TaskQueue*)> closed_at_end(
      tasks.get(), [](TaskQueue* open) { open->close(); });
  executor.run(threads, [tasks](std::size_t) { tasks->help(); });
  const ParallelRegion region;
  queue.work();
}

}  // namespace

void run_chunks(const ParallelPolicy& policy, std::size_t chunks,
                const std::function<void(std::size_t)>& body) {
  const bool nested = ParallelRegion::inside() || omp_in_parallel();
  const unsigned threads =
      nested || chunks <= 1 ? 1U : static_cast<unsigned>(std::min<std::size_t>(thread_count(policy), chunks));
  ChunkQueue queue(chunks, body);
  if (threads == 1) {
    queue.work();
  } else if (kUseOpenMp && std::holds_alternative<OpenMP>(policy)) {
    work_with_openmp(queue, threads);
  } else if (const auto* executor = std::get_if<Executor>(&policy)) {
    work_with_executor(queue, *executor, threads);
  } else {
    WorkerPool::instance().run(threads - 1, [&queue] { queue.work(); });
  }
  queue.rethrow();
}

}  // namespace pcl_bv::detail

namespace pcl_bv::detail {

SpinningThreads::SpinningThreads(const ParallelPolicy& policy) {
  const unsigned threads = std::holds_alternative<Threads>(policy) ? thread_count(policy) : 1;
  if (threads == 1 || ParallelRegion::inside()) return;
  WorkerPool& pool = WorkerPool::instance();
  pool.start_spinning(threads - 1);
  pool_ = &pool;
}

SpinningThreads::~SpinningThreads() {
  if (pool_ != nullptr) WorkerPool::stop_spinning(static_cast<WorkerPool*>(pool_));
}

}  // namespace pcl_bv::detail
