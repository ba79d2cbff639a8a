// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the chunks and messages of an MCAP file by walking over its records.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "mcap_index.h"

namespace pcl_bv::detail {
namespace mcap {

/// The content of a file's summary. With an empty Summary, scan() reads every chunk.
struct Summary {
  std::map<std::uint64_t, Part> chunks;                ///< By position in the file.
  std::map<std::uint64_t, std::uint64_t> index_bytes;  ///< Bytes of the message indexes behind each chunk.
  std::optional<Statistics> statistics;
};

/// Number of messages outside of chunks, and number of chunks that the summary does not describe.
struct UnindexedCounts {
  std::uint64_t loose_messages = 0, chunks = 0;
};

/// Walks over the records of a file and adds all chunks and all messages outside of chunks to the index, in
/// the order of the file. Chunks that the summary describes are not read. After damage, the walk continues at
/// the next chunk.
UnindexedCounts scan(const InputFile& file, const Summary& summary, Index& index);

/// Adds a schema or channel record to the index. Ignores all other records.
void add_schema_or_channel(const Record& record, Index& index);

/// Reads `size` bytes of the file.
std::vector<std::byte> bytes_at(const InputFile& file, std::uint64_t offset, std::uint64_t size);

}  // namespace mcap
}  // namespace pcl_bv::detail
