// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sources of frames: files, recordings, network topics, synthetic sequences and functions.
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

/// Thrown for a frame that its source could not read; the next frame may be readable. what() names the file
/// and the reason.
class FrameError : public std::runtime_error {
 public:
  FrameError(Frame lost, const std::string& why)
      : std::runtime_error(lost.file.empty() ? why : lost.file + ": " + why),
        frame(std::move(lost)),
        reason(why) {}
  Frame frame;  ///< The known parts of the frame: header and file.
  std::string reason;
};

/// Outcome of FrameSource::next().
enum class Next : std::uint8_t {
  frame,
  end,
  timeout  ///< No frame has come yet; call next() again.
};

/// A sequence of frames.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Replaces `frame` by the next frame if it comes within `timeout`; reading an existing file may take
  /// longer. Throws FrameError for a frame that cannot be read; the next call continues with the following
  /// frame. Must not be called again after Next::end or after any other exception.
  virtual Next next(Frame& frame, std::chrono::milliseconds timeout) = 0;

  /// Returns the warnings about the source as a whole since the last call, one line each.
  virtual std::vector<std::string> take_warnings() { return {}; }
};

/// Range of ReplayOptions::rate_hz, frames per second.
inline constexpr double kMinRate = 1e-3, kMaxRate = 1e6;

/// How files and recordings become frames.
struct ReplayOptions {
  double rate_hz = 10;  ///< Frames per second, 0.001 to 1000000; frame n has the stamp n / rate_hz.
  /// Use the frames' own stamps instead of `rate_hz`.
  ///
  /// Files: the time in the name, read as by stamp_in_name(), but with one interpretation for all files of a
  /// folder. An interpretation whose stamps ascend is preferred; it may read fractions as whole milli-,
  /// micro- or nanoseconds without leading zeros. If there is none, take_warnings() returns a warning. A name
  /// without a time gives a FrameError. Messages: the stamp of the header or, if that is 0, the time of
  /// recording.
  bool own_stamps = false;
  std::size_t bin_fields = 0;  ///< Floats per point of .bin files, as in read_cloud().
  std::size_t loops = 1;       ///< Number of passes; 0 means 1.
  /// Integer field of the clouds for Frame::classes; if empty, frames have no classes.
  std::string class_field{};
  std::string frame_id{};  ///< Frame id of all frames; if empty, that of the recording.

  /// File of sensor poses; none if empty. Empty lines and lines that begin with # are skipped.
  ///
  /// KITTI: 12 numbers per line, the upper three rows of the pose matrix, and one line per frame. If a
  /// calib.txt next to the file has a line `Tr:`, the poses are those of the left camera and are converted to
  /// the sensor. TUM: `seconds x y z qx qy qz qw` per line. Poses are interpolated between two lines that are
  /// at most 0.5 s apart; other frames have no pose.
  std::filesystem::path poses{};
  std::string topic{};  ///< Topic of a recording; if empty, the only one with clouds.
};

/// Where a source can take the times of frames from, other than the rate.
enum class FrameTimes : std::uint8_t {
  none,
  names,     ///< File names, if requested by ReplayOptions::own_stamps.
  messages,  ///< Messages of a recording, unless the rate is requested.
  live       ///< Live messages; there is no other choice.
};

/// An entry of the table of sources. `accepts` tells whether this kind opens the name.
struct SourceKind {
  std::string_view syntax;
  FrameTimes times;
  bool (*accepts)(const std::string& name);
  std::unique_ptr<FrameSource> (*open)(const std::string& name, const ReplayOptions& options);
};

/// Returns the table of sources. The first kind that accepts a name opens it; the last kind accepts any name.
const std::vector<SourceKind>& source_kinds();
/// Returns the kind that opens this name.
const SourceKind& source_kind(const std::string& name);

/// Returns the syntax of all sources for help texts.
std::string source_syntax();

/// Opens a source by its name:
/// - a folder of clouds, in natural order, or one file;
/// - a recording (open_recording()) with messages sensor_msgs/msg/PointCloud2;
/// - a capture of a Velodyne sensor's packets (VelodyneReader);
/// - `dds:TOPIC` (middleware()), which never ends;
/// - `synth:street-sequence[:FRAMES[:SEED]]` and other synthetic sequences, generated frame by frame.
///
/// Throws IoError if there is no cloud or if poses cannot be read. Throws std::invalid_argument for a rate
/// out of range, for names without any time (ReplayOptions::own_stamps), for an unknown sequence, for a topic
/// that does not exist, and if no topic is given and several have clouds. Also throws as
/// Middleware::receiver() does.
std::unique_ptr<FrameSource> open_source(const std::string& name, const ReplayOptions& options = {});

/// Creates a source from a function that fills the next frame and returns false at the end. The function may
/// block, since each call has a thread of its own. A call that is still running when the source is destroyed
/// is not stopped: whatever the function uses must live until it returns. next() rethrows the exceptions of
/// the function.
std::unique_ptr<FrameSource> make_source(std::function<bool(Frame&)> next);

/// Returns the time in a file name without extension, nanoseconds; -1 if there is none.
///
/// If a name contains several times, the first of these formats that occurs is used, and its last occurrence:
/// 1. A time since 1970: seconds of 2001 to 2033, also with a fraction; a whole number of milli- or
///    microseconds of 2001 to 2262; or nanoseconds from 1e16 on.
/// 2. A date with hours, minutes and seconds: UTC, or with a time zone east of UTC such as +0800. Zones such
///    as -0500 are ignored.
/// 3. A time of day.
/// 4. Other seconds with a decimal point.
///
/// Other numbers are taken as frame numbers and ignored. For the names of a folder see
/// ReplayOptions::own_stamps.
std::int64_t stamp_in_name(std::string_view stem);

}  // namespace pcl_bv
