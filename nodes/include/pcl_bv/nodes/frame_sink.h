// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sinks of results: files, recordings, network topics and functions.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/frame_result.h"

namespace [[gnu::visibility("default")]] pcl_bv {

class FramePipeline;
struct StreamConfig;
namespace detail {
class RemoteParameters;
}

/// Returns the settings of a pipeline for SinkGroup::offer_settings(), so that viewers can change them. The
/// pipeline must outlive the returned object. Settings that read files or need other input (filter.regions,
/// cluster.class_field and cluster.classes) cannot be changed.
std::shared_ptr<detail::RemoteParameters> remote_settings(FramePipeline& pipeline);
/// Also has the settings of the stream's rig, which cannot be changed, and those of its runner, which only
/// recordings note. `stream.pipeline` is not used.
std::shared_ptr<detail::RemoteParameters> remote_settings(FramePipeline& pipeline,
                                                          const StreamConfig& stream);

/// Thrown if a pipe has no reader any more. A program that prints to this pipe should then end without
/// reporting a failure.
class ClosedPipe : public IoError {
 public:
  using IoError::IoError;
};

/// A receiver of results. Called by one thread.
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// Writes one frame; frames come in order. Throws IoError if neither this frame nor later ones can be
  /// written. If SIGPIPE is ignored, throws ClosedPipe for a pipe without a reader. Any other exception
  /// concerns this frame only.
  virtual void write(const Frame& frame, const FrameResult& result) = 0;

  /// Writes that a frame was lost and why.
  virtual void write_lost(const Frame&, const std::string& /*reason*/) {}

  /// Offers settings that the readers of the results may see and change. Called before the first frame.
  virtual void offer_settings(const std::shared_ptr<detail::RemoteParameters>& /*settings*/) {}

  /// Returns the warnings since the last call of take_warnings(), one line each. Warnings are not failures.
  virtual std::vector<std::string> take_warnings() { return {}; }

  /// Ends the output; nothing is written afterwards. Throws IoError if not everything could be written.
  virtual void close() {}
};

struct SinkOptions;

/// An entry of the table of sinks.
struct SinkKind {
  std::string_view name;    ///< Text before the colon: "vtp".
  /// Syntax of the text after the colon, for help: "FOLDER[,points]". "[,WORD]" is an option of the sink.
  std::string_view target;
  /// Extension of the files if `target` is a folder with a file per frame; otherwise empty.
  std::string_view files;
  std::unique_ptr<FrameSink> (*open)(const SinkOptions&);
  bool live = false;  ///< Whether the sink sends to listeners. Its target is then not a file.
};

/// Returns the table of sinks: jsonl, csv, kitti, mcap, rosbag2, dds, ws, vtp, image, labels.
const std::vector<SinkKind>& sink_kinds();

/// Returns the syntax of all sinks for help and errors: "jsonl:FILE, csv:FILE, ...".
std::string sink_syntax();

/// Which sink to open and where it writes.
struct SinkOptions {
  const SinkKind* kind = nullptr;
  /// File ("-": standard output) or folder. For dds: prefix of the topics. For ws: [HOST:]PORT.
  std::filesystem::path target;
  bool points = false;  ///< Whether to write the points of each frame, too.
  /// Programs whose messages are written, too: "moveit", "nav2", "vision". Each is an option of the sink.
  std::vector<std::string> adapters{};
};

/// Parses a description in the syntax of sink_syntax(); opens nothing. Throws std::invalid_argument for any
/// other text. If the kind has options, a comma and a word at the end are taken for one, so an unknown word
/// is an error.
SinkOptions parse_sink(const std::string& description);

/// Opens a sink.
///
/// Files, recordings and folders are created if they do not exist, in a folder that exists. The first frame or
/// close() empties an existing file or recording. After each frame, also after one that did not fit on the
/// disk, jsonl, csv and kitti files hold whole lines, mcap files whole chunks, and frames.pvd (vtp) lists the
/// frames so far. Files of single frames (vtp, image, labels) are named by FrameHeader::number. Files and
/// recordings are locked while they are written. The folders of rosbag2, image and labels are locked against
/// other processes.
///
/// Throws IoError if the sink cannot be opened or is locked, and std::invalid_argument if `kind` is null.
std::unique_ptr<FrameSink> make_sink(const SinkOptions& description);

/// Creates a sink that calls `on_result` with each result. Throws std::invalid_argument if `on_result` is
/// empty.
std::unique_ptr<FrameSink> make_sink(std::function<void(const Frame&, const FrameResult&)> on_result);

/// Writes to several sinks. A failure of one sink affects neither the other sinks nor the stream. A sink that
/// throws IoError gets no more frames. A sink that throws any other exception misses only that frame. Other
/// threads may call times() and alive().
class SinkGroup {
 public:
  /// `report` is called with one line for each failure and warning. A failure with the same text as the
  /// sink's previous failure is not reported again. Throws std::invalid_argument if `report` is empty.
  explicit SinkGroup(std::function<void(const std::string&)> report);

  /// If neither write(), write_lost() nor close() was called, for example because a sink could not be opened,
  /// the sinks remove the files that they created. Empty folders that were created for the sinks are removed,
  /// too.
  ~SinkGroup();

  /// Adds an open sink; `name` is its name in messages.
  void add(std::string name, std::unique_ptr<FrameSink> sink);

  /// Opens a sink and adds it. Throws as make_sink(); the text of an IoError begins with the sink's name.
  void add(const SinkOptions& description);

  /// Offers the settings to all sinks added so far.
  void offer_settings(const std::shared_ptr<detail::RemoteParameters>& settings);

  /// Write to all sinks except those that have thrown IoError.
  void write(const Frame& frame, const FrameResult& result);
  void write_lost(const Frame& frame, const std::string& reason);

  /// Closes all sinks. For each sink that misses more than one frame, reports the number of missing frames.
  void close();

  bool failed() const { return failed_; }  ///< Whether a sink has failed; a closed pipe is no failure.
  bool alive() const { return alive_; }    ///< Whether at least one sink still takes frames.
  /// Returns the durations of write() for each sink, milliseconds.
  std::vector<std::pair<std::string, LatencyHistogram>> times() const;

 private:
  struct Member;
  void report_failure(Member& member, const std::string& problem);
  template <typename Do>
  bool attempt(Member& member, const Do& what);
  template <typename Do>
  void each(const Do& what);

  std::function<void(const std::string&)> report_;
  std::vector<std::unique_ptr<Member>> members_;
  // For each sink whose target did not exist: the path of the target, and the outermost folder or file of
  // this path that did not exist.
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> created_;
  bool used_ = false;
  std::atomic<bool> failed_{false}, alive_{false};
};

}  // namespace pcl_bv
