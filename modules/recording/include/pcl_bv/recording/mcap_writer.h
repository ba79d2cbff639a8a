// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "pcl_bv/recording/compression.h"
#include "pcl_bv/recording/recording_writer.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An MCAP file (https://mcap.dev/spec, profile "ros2", messages in CDR) that grows by chunks, each with its
/// index and CRC. What was written before the process ends in any way can be read, but for the chunk it was
/// in. close() adds the summary: schemas, channels, statistics, and an index of chunks and attachments.
class McapWriter final : public RecordingWriter {
 public:
  struct Options {
    Compression compression = Compression::zstd;
    std::size_t chunk_bytes =
        1U << 20U;  ///< A chunk ends with the message that makes it so long, uncompressed.
  };

  /// Opens or makes the file. The first message or attachment, or close(), empties it. Throws IoError if it
  /// cannot be opened.
  explicit McapWriter(const std::filesystem::path& file);
  McapWriter(const std::filesystem::path& file, const Options& options);

  /// Closes what is open and reports no failure. Without a message, an attachment and close() the file is as
  /// it was before, or is removed if the writer made it.
  ~McapWriter() override;
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  std::size_t add_topic(const WrittenTopic& topic) override;

  /// Negative times become 0, MCAP has no others. Where a chunk cannot be written, those before are in the
  /// file.
  void write(std::size_t topic, std::int64_t log_time_ns, std::int64_t publish_time_ns, const std::byte* data,
             std::size_t size) override;
  void attach(const std::string& name, const std::string& media_type, const std::string& content,
              std::int64_t log_time_ns) override;
  void close() override;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
