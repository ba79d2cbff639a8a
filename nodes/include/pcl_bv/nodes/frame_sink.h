// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where results go.
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

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/nodes/latency.h"
#include "pcl_bv/nodes/remote_settings.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A pipe that nobody reads any more: for a program that prints, the end, but no failure.
class ClosedPipe : public IoError {
 public:
  using IoError::IoError;
};

/// Called by one thread.
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// One frame, in order. Throws IoError if nothing more can be written, ClosedPipe where SIGPIPE is ignored;
  /// anything else is of this frame only.
  virtual void write(const Frame& frame, const FrameResult& result) = 0;

  /// A frame that was lost, and why.
  virtual void write_lost(const Frame&, const std::string& /*reason*/) {}

  /// Before the first frame: settings that those who read the results may see and change.
  virtual void offer(const std::shared_ptr<RemoteSettings>& /*settings*/) {}

  /// What was noticed and harms no frame, since the last call: a line each, for people.
  virtual std::vector<std::string> take_remarks() { return {}; }

  /// The end; nothing is written afterwards. Throws IoError if what was written is not all there.
  virtual void close() {}
};

struct SinkDescription;

/// A row of the table of sinks.
struct SinkKind {
  std::string_view name;   ///< What stands before the colon: "vtp".
  std::string_view place;  ///< What stands after it, as --help says: "FOLDER[,points]".
  std::string_view files;  ///< How the names of its files end, where the place is their folder; else empty.
  std::unique_ptr<FrameSink> (*open)(const SinkDescription&);
  bool live = false;  ///< Sent to whoever listens: the place is no file.
};

/// jsonl, csv, mcap, rosbag2, dds, ws, vtp, image, labels.
const std::vector<SinkKind>& sink_kinds();

/// "jsonl:FILE, csv:FILE, ...": all of them, for help and errors.
std::string sink_syntax();

struct SinkDescription {
  const SinkKind* kind = nullptr;
  std::filesystem::path place;  ///< "-" is standard output; of dds the topics' prefix, of ws [HOST:]PORT.
  bool points = false;          ///< The frame's points, too.
};

/// Reads what sink_syntax() says; opens nothing. Throws std::invalid_argument for anything else.
SinkDescription parse_sink(const std::string& description);

/// Opens it: a file or recording is made if it is not there, and emptied by the first frame or by close(); a
/// folder is made if it is not there. Throws IoError, std::invalid_argument without a kind. After each frame
/// files hold whole lines (jsonl, csv; where the disk is full, the last one may be cut) and frames.pvd (vtp)
/// lists it; files of a frame (vtp, image, labels) are named by FrameHeader::number.
std::unique_ptr<FrameSink> make_sink(const SinkDescription& description);

/// Calls the function with each result. Throws std::invalid_argument without one.
std::unique_ptr<FrameSink> make_sink(std::function<void(const Frame&, const FrameResult&)> on_result);

/// Many sinks, of which none harms another or the stream: one that throws IoError is given up, what else it
/// throws costs it a frame. times() and alive() may be called from any thread.
class SinkGroup {
 public:
  /// `say` is told of each failure in words, once in a row. Throws std::invalid_argument without it.
  explicit SinkGroup(std::function<void(const std::string&)> say);

  /// Without a frame and without close(), as when one of them could not be opened, each sink removes the
  /// files that it made, and folders that were made for them are removed if they are empty.
  ~SinkGroup();

  void add(std::string name, std::unique_ptr<FrameSink> sink);

  /// Opens it; throws as make_sink(), with its name.
  void add(const SinkDescription& description);

  /// To all that were added so far.
  void offer(const std::shared_ptr<RemoteSettings>& settings);

  void write(const Frame& frame, const FrameResult& result);
  void write_lost(const Frame& frame, const std::string& reason);

  /// Closes all, and says which lack more than one frame, and how many.
  void close();

  bool failed() const { return failed_; }  ///< Whether anything was not written, but to a closed pipe.
  bool alive() const { return alive_; }    ///< Whether one still takes frames.
  std::vector<std::pair<std::string, LatencyHistogram>> times() const;  ///< Of write(), milliseconds.

 private:
  struct Member;
  void complain(Member& member, const std::string& problem);
  template <typename Do>
  bool attempt(Member& member, const Do& what);
  template <typename Do>
  void each(const Do& what);

  std::function<void(const std::string&)> say_;
  std::vector<std::unique_ptr<Member>> members_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>>
      made_;  // places, and what was missing above
  bool used_ = false;
  std::atomic<bool> failed_{false}, alive_{false};
};

}  // namespace pcl_bv
