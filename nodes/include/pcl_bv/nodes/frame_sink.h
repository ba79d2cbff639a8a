// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where results go.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/nodes/frame_result.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A pipe that nobody reads any more: for a program that prints, the end, but no failure.
class ClosedPipe : public IoError {
 public:
  using IoError::IoError;
};

class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// One frame, in order. Throws IoError if it cannot be written, ClosedPipe where SIGPIPE is ignored.
  virtual void write(const FrameResult& result) = 0;

  /// A frame that was lost, and why.
  virtual void write_error(const FrameHeader& header, const std::string& reason) = 0;

  /// The end; nothing is written afterwards. Throws IoError if what was written is not all there.
  virtual void close() {}
};

/// A JSON object a line. Each line is written whole when its frame is done, so that the file can be followed;
/// "-" is standard output. Throws IoError if it cannot be opened.
std::unique_ptr<FrameSink> make_jsonl_sink(const std::filesystem::path& file);

/// A line per volume: `seq,stamp_ns,track,cluster,points,method,cx,...`. Lost frames leave none. Otherwise as
/// make_jsonl_sink().
std::unique_ptr<FrameSink> make_csv_sink(const std::filesystem::path& file);

/// For ParaView: a file of meshes per frame, frame000000.vtp on, and at the end frames.pvd with their times,
/// which are the stamps less the first one. The folder is made if it is not there.
std::unique_ptr<FrameSink> make_vtp_sink(const std::filesystem::path& folder);

enum class SinkKind : std::uint8_t { jsonl, csv, vtp };

struct SinkDescription {
  SinkKind kind = SinkKind::jsonl;
  std::filesystem::path place;
};

/// Reads "jsonl:FILE", "csv:FILE" or "vtp:FOLDER"; opens nothing. Throws std::invalid_argument for anything
/// else.
SinkDescription parse_sink(const std::string& description);

/// One of those above.
std::unique_ptr<FrameSink> make_sink(const SinkDescription& description);

/// Calls the function with each result.
std::unique_ptr<FrameSink> make_sink(std::function<void(const FrameResult&)> on_result);

}  // namespace pcl_bv
