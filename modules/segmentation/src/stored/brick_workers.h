// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs work on several bricks at a time, each for one thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "distributed_points.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {

/// Calls make_worker(execution) once for each thread, and then worker(brick, records) for each brick. Frees
/// the lists. A single worker gets the execution with all threads.
template <typename MakeWorker>
void for_each_brick(const std::vector<SpillList>& lists, const StoredClusterOptions& store,
                    const Execution& execution, SpillFile& file, const MakeWorker& make_worker) {
  const std::size_t workers = std::min(bricks_at_a_time(store, execution.parallel), lists.size());
  const bool several = workers > 1;
  std::atomic<std::size_t> next = 0;
  for_each_chunk(several ? execution.parallel : ParallelPolicy{Serial{}}, workers, [&](std::size_t) {
    auto worker = make_worker(several ? Execution{Serial{}, execution.isa} : execution);
    std::vector<std::byte> records;
    for (std::size_t brick = next++; brick < lists.size(); brick = next++) {
      lists[brick].read(file, records);
      lists[brick].discard(file);
      worker(static_cast<std::uint32_t>(brick), records);
    }
  });
}

}  // namespace pcl_bv::detail
