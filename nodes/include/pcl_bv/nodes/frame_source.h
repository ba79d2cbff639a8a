// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where frames come from.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A frame that its source has not been able to read; the next one may be fine. what() names its file and
/// says why.
class FrameError : public std::runtime_error {
 public:
  FrameError(Frame lost, const std::string& why)
      : std::runtime_error(lost.file.empty() ? why : lost.file + ": " + why),
        frame(std::move(lost)),
        reason(why) {}
  Frame frame;  ///< What is known of it: header and file.
  std::string reason;
};

enum class Next : std::uint8_t {
  frame,
  end,
  nothing  ///< Nothing has come yet: ask again.
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Replaces `frame` by the next one if it comes within `patience`; reading a file that is there may take
  /// longer. Throws FrameError for a frame that cannot be read; the next call gives the one after it. After
  /// the end, and after any other exception, it is not called again.
  virtual Next next(Frame& frame, std::chrono::milliseconds patience) = 0;

  /// What was noticed of the source as a whole since the last call, and not refused: a line each, for people.
  virtual std::vector<std::string> take_remarks() { return {}; }
};

inline constexpr double kLeastRate = 1e-3, kGreatestRate = 1e6;

/// How recordings become frames.
struct ReplayOptions {
  double rate_hz = 10;  ///< Frames a second, 0.001 to 1000000: frame n is n / rate_hz after the first.
  /// Stamps that frames have themselves: of files by stamp_in_name(), but in one way for all of a folder,
  /// whose stamps ascend if there is such a way, also with fractions that are milli-, micro- or nanoseconds
  /// without leading zeros; a remark says that none does. A name without one is a FrameError. Of messages
  /// those of their headers, and where they are 0 of when they were recorded.
  bool from_name = false;
  std::size_t bin_fields = 0;  ///< As read_cloud() takes it.
  std::size_t loops = 1;       ///< How often; at least once.
  std::string
      class_field{};       ///< An integer field of the clouds for Frame::classes; if empty, there are none.
  std::string frame_id{};  ///< Of all frames; if empty, what the recording says.

  /// A file of the sensor's poses, if not empty. A line has 12 numbers, the upper rows of the frame's matrix
  /// (KITTI: of the left camera where `Tr:` in a calib.txt beside the file says how to convert), as many
  /// lines as frames; or `seconds x y z qx qy qz qw` (TUM), where frames are between two lines at most 0.5 s
  /// apart, interpolated, or have no pose. Lines that begin with # and empty ones are skipped.
  std::filesystem::path poses{};
  std::string topic{};  ///< Of a recording; if empty, the only one with clouds.
};

/// Where the times of a source's frames can come from, beside the rate.
enum class FrameTimes : std::uint8_t {
  none,
  names,     ///< Of files, where they are asked for.
  messages,  ///< Of a recording, unless others are asked for.
  live       ///< Of messages as they come; no others.
};

/// A row of the table of sources.
struct SourceKind {
  std::string_view syntax;
  FrameTimes times;
  bool (*takes)(const std::string& name);
  std::unique_ptr<FrameSource> (*open)(const std::string& name, const ReplayOptions& options);
};

/// The first that takes a name opens it; the last takes any.
const std::vector<SourceKind>& source_kinds();
const SourceKind& source_kind(const std::string& name);

/// All that can be opened, for help.
std::string source_syntax();

/// A folder of clouds in natural order, one file, a recording (open_recording():
/// sensor_msgs/msg/PointCloud2), a capture of a Velodyne's packets (VelodyneReader), `dds:TOPIC`
/// (middleware()), which never ends, or `synth:street-sequence[:FRAMES[:SEED]]`, whose frames are made when
/// they are asked for. Throws IoError if there is no cloud or no poses can be read, std::invalid_argument for
/// a rate out of range, for names none of which has a stamp, for a topic that is not there or not said where
/// there are several, and for an unknown sequence. Further ones as Middleware::receiver() does.
std::unique_ptr<FrameSource> open_source(const std::string& name, const ReplayOptions& options = {});

/// What the function gives, until it returns false. It may wait as long as it likes: each call is in a thread
/// of its own. One that still waits when the source is destroyed is left to, so that what it uses must be
/// there until it returns. Its exceptions are those of next().
std::unique_ptr<FrameSource> make_source(std::function<bool(Frame&)> next);

/// The stamp in a file's name without its extension, nanoseconds; -1 without one. The surest way of writing a
/// time that is there counts, the last of its kind: a time since 1970 (seconds of 2001 to 2033,
/// also with a fraction, a whole number of milli- or microseconds of 2001 to 2262, or nanoseconds from 1e16
/// on), a date with hours, minutes and seconds (UTC, or with a zone east of it such as +0800; one such as
/// -0500 is ignored), a time of day, or other seconds with a decimal point. Other numbers count frames. For a
/// folder see ReplayOptions::from_name.
std::int64_t stamp_in_name(std::string_view stem);

}  // namespace pcl_bv
