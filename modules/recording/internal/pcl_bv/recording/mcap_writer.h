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

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Writes an MCAP file chunk by chunk (https://mcap.dev/spec, profile "ros2", messages in CDR). Each chunk
/// has a CRC and is followed by its message indexes. If the process ends unexpectedly, all chunks except the
/// unfinished one can be read. close() adds the summary, which has schemas, channels, statistics, and an
/// index of chunks and attachments.
class McapWriter final : public RecordingWriter {
 public:
  struct Options {
    Compression compression = Compression::zstd;  ///< Compression of the chunks.
    /// A chunk ends when its uncompressed size reaches this number of bytes. The last message is not split.
    std::size_t chunk_bytes = 1U << 20U;
  };

  /// Opens or creates the file. The old content of the file is discarded only at the first message or
  /// attachment, or at close(). Throws IoError if the file cannot be opened.
  explicit McapWriter(const std::filesystem::path& file);
  /// Like the other constructor, with options.
  McapWriter(const std::filesystem::path& file, const Options& options);

  /// Calls close() if a message or attachment was written, and ignores errors of close(). If nothing was
  /// written, a file that this object created is removed, and a file that existed before keeps its content.
  ~McapWriter() override;
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  std::size_t add_topic(const WrittenTopic& topic) override;

  /// Adds a message to the current chunk. Negative times become 0, because MCAP's times are unsigned. If a
  /// chunk cannot be written, its messages are lost, but all chunks before it stay readable.
  void write(std::size_t topic, std::int64_t log_time_ns, std::int64_t publish_time_ns, const std::byte* data,
             std::size_t size) override;
  void attach(const std::string& name, const std::string& media_type, const std::string& content,
              std::int64_t log_time_ns) override;
  void close() override;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
