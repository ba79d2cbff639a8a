// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Chunk and merge (Karlsson, Winberg and Larsson 2010, section 5). Work is cut into chunks of fixed size;
// results are stored by chunk number and merged in that order. So no result depends on which thread runs
// which chunk.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "pcl_bv/parallel/execution.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {
void run_chunks(const ParallelPolicy& policy, std::size_t chunks,
                const std::function<void(std::size_t)>& body);

/// Calls body(0) ... body(chunks - 1), each once, in any order and on any of the policy's threads. Returns
/// when all calls have returned.
///
/// Runs on the calling thread alone if the policy has one thread or if there is only one chunk. Also runs on
/// the calling thread alone inside another parallel region of pcl_bv or OpenMP, to avoid oversubscription. If
/// bodies throw, the remaining chunks are still run; then the exception of the failed chunk with the lowest
/// number is rethrown. A body may fork. The child may start parallel regions itself, but must never return
/// from the body. A FloatEnvironment lives during each call.
template <typename Body>
void for_each_chunk(const ParallelPolicy& policy, std::size_t chunks, Body&& body) {
  run_chunks(policy, chunks, std::ref(body));
}

/// Calls body(begin, end) for consecutive ranges of `chunk_items` items that together cover 0 ... items - 1.
/// The last range may be shorter. Runs and throws like for_each_chunk().
template <typename Body>
void for_each_range(const ParallelPolicy& policy, std::size_t items, std::size_t chunk_items, Body&& body) {
  for_each_chunk(policy, (items + chunk_items - 1) / chunk_items, [&](std::size_t chunk) {
    body(chunk * chunk_items, std::min(items, (chunk + 1) * chunk_items));
  });
}

/// Keeps the library's threads spinning between parallel regions while the object lives, so that no thread
/// needs to be woken. Waking a sleeping thread takes about 25 us.
///
/// Each thread spins for at most 2 ms at a time and occupies its processor meanwhile. Make such an object for
/// a sequence of short parallel stages. The object has an effect only for the policy Threads, outside of
/// parallel regions.
class SpinningThreads {
 public:
  explicit SpinningThreads(const ParallelPolicy& policy);
  ~SpinningThreads();
  SpinningThreads(const SpinningThreads&) = delete;
  SpinningThreads& operator=(const SpinningThreads&) = delete;

 private:
  void* pool_ = nullptr;
};

/// Sets result = identity, calls merge(result, map(i)) for i = 0 ... chunks - 1, and returns the result. The
/// maps run in parallel. The merges run in ascending order of i on the calling thread. Throws like
/// for_each_chunk().
template <typename Partial, typename Map, typename Merge>
Partial reduce_chunks(const ParallelPolicy& policy, std::size_t chunks, Partial identity, Map&& map,
                      Merge&& merge) {
  std::vector<Partial> partials(chunks, identity);
  for_each_chunk(policy, chunks, [&](std::size_t chunk) { partials[chunk] = map(chunk); });
  Partial result = std::move(identity);
  for (Partial& partial : partials)
    merge(result, std::move(partial));
  return result;
}

}  // namespace detail
}  // namespace pcl_bv
