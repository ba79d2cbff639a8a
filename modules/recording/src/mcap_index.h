// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The index of an MCAP file, which has the channels and the positions of the file's parts with messages.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "codecs.h"
#include "mcap_records.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv::detail {
namespace mcap {

/// A part of the file that has messages: a chunk, or successive messages outside of chunks.
struct Part {
  std::uint64_t offset = 0, bytes = 0;
  std::uint64_t first_time = 0, last_time = 0;
  bool is_chunk = true;
  std::set<std::uint16_t> channels{};  ///< Channels of the part's messages; empty if unknown.
};

/// The index of a file.
struct Index {
  std::map<std::uint16_t, Schema> schemas;          ///< By id.
  std::map<std::uint16_t, Channel> channels;        ///< By id.
  std::map<std::uint16_t, std::uint64_t> messages;  ///< Number of messages by channel; empty if unknown.
  std::vector<Part> parts;                          ///< In the order of the file.
  WarningList warnings;
};

/// Returns the index of a file. Walks over the records of the file but skips the chunks that the summary
/// describes. Other chunks are read. All chunks are read if the summary is missing, is damaged, or does not
/// describe all channels and their schemas. Throws IoError if the file does not begin with MCAP's magic
/// number.
Index index_of(const InputFile& file);

/// Returns the records of a part, which refer to `raw` or `unpacked`. Throws IoError for a damaged part.
Fields load_part(const InputFile& file, const Part& part, Decompressor& decompressor,
                 std::vector<std::byte>& raw, std::vector<std::byte>& unpacked);

}  // namespace mcap
}  // namespace pcl_bv::detail
