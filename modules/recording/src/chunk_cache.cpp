// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "chunk_cache.h"

#include <algorithm>
#include <map>

namespace pcl_bv::detail {
namespace {

// Transforms are read 0.5 s ahead of the clouds, which are a few chunks of 1 MiB.
constexpr std::size_t kMaxBytes = std::size_t{32} << 20;

}  // namespace

std::shared_ptr<ChunkCache> ChunkCache::of(const InputFile& file) {
  static std::mutex mutex;
  // Never destroyed, because other threads may read until the process ends.
  static auto* const caches = new std::map<FileIdentity, std::weak_ptr<ChunkCache>>;
  const std::lock_guard lock(mutex);
  std::erase_if(*caches, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<ChunkCache>& known = (*caches)[file.identity()];
  std::shared_ptr<ChunkCache> cache = known.lock();
  if (!cache) known = cache = std::make_shared<ChunkCache>();
  return cache;
}

UnpackedChunk ChunkCache::find(std::uint64_t offset) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(chunks_.rbegin(), chunks_.rend(),
                                  [&](const auto& chunk) { return chunk.first == offset; });
  return found == chunks_.rend() ? nullptr : found->second;
}

void ChunkCache::add(std::uint64_t offset, UnpackedChunk chunk) {
  const std::lock_guard lock(mutex_);
  bytes_ += chunk->size();
  chunks_.emplace_back(offset, std::move(chunk));
  while (bytes_ > kMaxBytes) {
    bytes_ -= chunks_.front().second->size();
    chunks_.pop_front();
  }
}

}  // namespace pcl_bv::detail
