// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shares unpacked chunks among the readers of one file: a rig reads each topic of a recording with a reader
// of its own, and the topics are in the same chunks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {

/// Bytes of a chunk, which do not change.
using UnpackedChunk = std::shared_ptr<const std::vector<std::byte>>;

/// The chunks of a file that were unpacked last, up to 32 MiB. All functions may be called by any thread.
class ChunkCache {
 public:
  /// Returns the cache of a file: the same one for all readers of this process that have the file open.
  static std::shared_ptr<ChunkCache> of(const InputFile& file);

  /// Returns the chunk at this position in the file, or null.
  UnpackedChunk find(std::uint64_t offset);
  void add(std::uint64_t offset, UnpackedChunk chunk);

 private:
  std::mutex mutex_;
  std::deque<std::pair<std::uint64_t, UnpackedChunk>> chunks_;  // the last one was added last
  std::size_t bytes_ = 0;
};

/// Returns the records of a chunk, from the cache if it has them. Otherwise calls `unpack(bytes)`, which may
/// leave `bytes` empty if its result refers to other memory. `chunk` keeps the records alive. A single reader
/// unpacks into `own`, whose memory it uses again, and stores nothing in the cache.
template <class Records, class Unpack>
Records unpack_shared(const std::shared_ptr<ChunkCache>& cache, std::uint64_t offset, UnpackedChunk& chunk,
                      std::vector<std::byte>& own, const Unpack& unpack) {
  chunk.reset();
  if (cache.use_count() == 1) return unpack(own);
  chunk = cache->find(offset);
  if (chunk) return Records(chunk->data(), chunk->size());
  const auto made = std::make_shared<std::vector<std::byte>>();
  const Records records = unpack(*made);
  chunk = made;
  if (!made->empty()) cache->add(offset, chunk);
  return records;
}

}  // namespace pcl_bv::detail
