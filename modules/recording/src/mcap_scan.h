// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "mcap_index.h"

namespace pcl_bv {
namespace mcap {

/// Chunks by where they begin. Optional: without it every chunk must be read.
struct Summary {
  std::map<std::uint64_t, Part> chunks;
  std::map<std::uint64_t, std::uint64_t> index_bytes;  ///< Behind a chunk.
  std::optional<Statistics> statistics;
};

/// What a walk has found that the summary does not know.
struct Unknown {
  std::uint64_t loose_messages = 0, chunks = 0;
};

/// Adds to the index all chunks and loose messages of a file, in their order, by walking over its records;
/// the chunks that the summary describes are not read. Behind damage the walk goes on at the next chunk.
Unknown scan(const InputFile& file, const Summary& summary, Index& index);

/// Adds a schema or channel to the index, wherever it stands.
void note(const Record& record, Index& index);

std::vector<std::byte> bytes_at(const InputFile& file, std::uint64_t offset, std::uint64_t size);

}  // namespace mcap
}  // namespace pcl_bv
