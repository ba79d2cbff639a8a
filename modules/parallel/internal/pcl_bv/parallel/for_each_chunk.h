// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Chunk and merge (paper §5): work in fixed chunks, results by chunk number, merged in order. Which thread
// does what can then not change a bit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "pcl_bv/parallel/policy.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace internal {
void run_chunks(const ParallelPolicy& policy, std::size_t chunks,
                const std::function<void(std::size_t)>& body);
}  // namespace internal

/// Calls body(0) ... body(chunks - 1), each once, in any order and on any of the policy's threads; returns
/// when all are done. Serial if the policy has one thread, if there is one chunk, or inside another parallel
/// region (no oversubscription). If bodies throw, every chunk is still tried and the exception of the lowest
/// chunk is rethrown. A child that a body forks may make calls of its own, but never returns from the body.
template <typename Body>
void for_each_chunk(const ParallelPolicy& policy, std::size_t chunks, Body&& body) {
  internal::run_chunks(policy, chunks, std::ref(body));
}

/// Calls body(begin, end) for runs of `of_chunk` items, the last of which may be shorter: each of 0, 1, ...
/// items - 1 is in one of them.
template <typename Body>
void for_each_run(const ParallelPolicy& policy, std::size_t items, std::size_t of_chunk, Body&& body) {
  for_each_chunk(policy, (items + of_chunk - 1) / of_chunk,
                 [&](std::size_t chunk) { body(chunk * of_chunk, std::min(items, (chunk + 1) * of_chunk)); });
}

/// While it lives, threads of our own that the policy uses wait for its calls without sleeping, up to 2 ms each
/// time: for stages that follow one another, since a thread that sleeps wakes in some 25 us. They cost the
/// processors on which they wait. Does nothing for other policies, and inside a parallel region.
class AwakeThreads {
 public:
  explicit AwakeThreads(const ParallelPolicy& policy);
  ~AwakeThreads();
  AwakeThreads(const AwakeThreads&) = delete;
  AwakeThreads& operator=(const AwakeThreads&) = delete;

 private:
  void* pool_ = nullptr;
};

/// merge(...merge(merge(identity, map(0)), map(1))..., map(chunks - 1)): the maps in parallel, the merges in
/// order.
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

}  // namespace pcl_bv
