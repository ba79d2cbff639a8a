// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

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

namespace pcl_bv {
namespace mcap {

/// Where messages are: a chunk, or messages that follow each other outside of any.
struct Part {
  std::uint64_t offset = 0, bytes = 0;
  std::uint64_t first_time = 0, last_time = 0;
  bool is_chunk = true;
  std::set<std::uint16_t> channels{};  ///< Of its messages; empty if nobody says.
};

struct Index {
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::map<std::uint16_t, std::uint64_t> messages;  ///< By channel, if the file says.
  std::vector<Part> parts;                          ///< As they lie in the file.
  WarningList warnings;
};

/// What is in a file, by a walk over its records, which passes over the chunks that the summary describes.
/// Where the summary is missing, damaged, or lacks chunks or a channel's schema, chunks are read, too. Throws
/// IoError if the file does not begin as MCAP does.
Index index_of(const InputFile& file);

/// The records of a part, which look into `raw` or `unpacked`. Throws IoError for a part that is damaged.
Fields load_part(const InputFile& file, const Part& part, Decompressor& decompressor,
                 std::vector<std::byte>& raw, std::vector<std::byte>& unpacked);

}  // namespace mcap
}  // namespace pcl_bv
