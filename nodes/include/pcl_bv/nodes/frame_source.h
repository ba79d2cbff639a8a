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
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Thrown for a frame that its source could not read. The next frame may be readable. what() names the file
/// and the reason.
class FrameError : public std::runtime_error {
 public:
  FrameError(Frame lost, const std::string& why)
      : std::runtime_error(lost.file.empty() ? why : lost.file + ": " + why),
        frame(std::move(lost)),
        reason(why) {}
  Frame frame;  ///< The header and the file of the frame, as far as known.
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
  /// frame. After next() has returned Next::end or thrown an exception other than FrameError, it must not be
  /// called again.
  virtual Next next(Frame& frame, std::chrono::milliseconds timeout) = 0;

  /// Returns the warnings about the whole source since the last call of take_warnings(), one line each.
  virtual std::vector<std::string> take_warnings() { return {}; }
};

/// Range of ReplayOptions::rate_hz, frames per second.
inline constexpr double kMinRate = 1e-3, kMaxRate = 1e6;

/// How files and recordings become frames.
struct ReplayOptions {
  double rate_hz = 10;  ///< Frames per second (kMinRate to kMaxRate). Frame n has the stamp n / rate_hz.
  /// Use the frames' own stamps instead of `rate_hz`.
  ///
  /// For files, the stamp is the time in the name. All names of a folder are read in one format of
  /// stamp_in_name(), if possible in one whose stamps ascend. If no format gives ascending stamps, or if the
  /// files must be sorted by time, take_warnings() returns a warning. A name without a time gives a
  /// FrameError. In some folders, the fractions of seconds are whole numbers of milli-, micro- or nanoseconds
  /// without leading zeros. With milliseconds, 12.5 then means 12.005 s.
  ///
  /// For messages, the stamp is that of the header, which may be 0. If two headers in a row have the stamp 0,
  /// or the only one of a recording, their driver writes no stamps. Then the stamp is the time of sending or
  /// recording, and take_warnings() returns a warning.
  bool own_stamps = false;
  std::size_t bin_fields = 0;  ///< Floats per point of .bin files, as in read_cloud().
  /// Number of passes over all frames; 0 is treated as 1. Frame::pass has the number of the pass. With own
  /// stamps, each pass has the same stamps.
  std::size_t loops = 1;
  /// Integer field of the clouds for Frame::classes. If empty, frames have no classes.
  std::string class_field{};
  std::string frame_id{};  ///< Frame id of all frames. If empty: the frame ids of the source.

  /// File of sensor poses. If empty, frames have poses only if their source generates poses. Empty lines and
  /// lines that begin with # are skipped.
  ///
  /// KITTI files have one line per frame with 12 numbers, the upper three rows of the pose matrix. If files
  /// are missing, so that their number differs from that of the poses, the number in each file name is the
  /// number of its line, from 0, and take_warnings() says so. Otherwise open_source() throws IoError. If a
  /// calib.txt next to the file has a line `Tr:`, the poses are those of the left camera and are converted to
  /// the sensor.
  ///
  /// TUM files have lines `seconds x y z qx qy qz qw`. The pose of a frame is interpolated between the lines
  /// before and after its stamp if these two lines are at most 0.5 s apart. Otherwise the frame has no pose.
  std::filesystem::path poses{};
  std::string topic{};       ///< Topic of a recording. If empty: its only topic with clouds.
  bool point_times = false;  ///< Whether open_rig() sets Frame::seconds, which deskewing needs.
};

/// Where a source can take the times of frames from, instead of ReplayOptions::rate_hz.
enum class FrameTimes : std::uint8_t {
  none,
  names,     ///< The file names, if ReplayOptions::own_stamps is set.
  messages,  ///< The messages or packets of a recording, if ReplayOptions::own_stamps is set.
  live       ///< The live messages, always. A rate cannot be requested.
};

/// An entry of the table of sources. `accepts` tells whether a source of this kind can have this name.
struct SourceKind {
  std::string_view syntax;
  FrameTimes times;
  bool (*accepts)(const std::string& name);
  std::unique_ptr<FrameSource> (*open)(const std::string& name, const ReplayOptions& options);
};

/// Returns the table of sources. The first kind that accepts a name opens it; the last kind accepts any name.
const std::vector<SourceKind>& source_kinds();
/// Returns the first kind that accepts this name.
const SourceKind& source_kind(const std::string& name);

/// Returns the syntax of all sources for help texts.
std::string source_syntax();

/// Opens a source by its name:
/// - a folder of clouds, in natural order, or one file;
/// - a recording (open_recording()) with messages sensor_msgs/msg/PointCloud2;
/// - a capture of the packets of Velodyne, Hesai, Livox or Ouster sensors;
/// - `dds:TOPIC` (middleware()), which never ends;
/// - `synth:street-sequence[:FRAMES[:SEED]]` and other synthetic sequences, generated frame by frame.
///
/// Throws IoError if there is no cloud or if poses cannot be read. Throws std::invalid_argument
/// - for a rate out of range or an unknown sequence;
/// - if stamps are to come from names (ReplayOptions::own_stamps) and no name has a time;
/// - if the topic does not exist or the source has no topics, or if no topic is given and several topics have
///   clouds.
///
/// Also throws as Middleware::receiver() does.
std::unique_ptr<FrameSource> open_source(const std::string& name, const ReplayOptions& options = {});

/// A sensor of a rig.
struct RigSensor {
  /// Topic of its clouds, or the name of its source if the source has no topics. In a capture of packets of
  /// several sensors: ADDRESS:PORT.
  std::string topic{};
  std::string frame{};  ///< Frame id of the sensor. If empty: the frame id of its clouds.
  /// Pose of the sensor in RigConfig::frame: x, y, z in metres, then roll, pitch, yaw in radians (rotations
  /// about the fixed axes x, y, z, in this order, as in URDF) or a quaternion x, y, z, w. If empty: from
  /// transforms.
  std::vector<double> pose{};
  /// Name of the source that has the topic. Only needed if several sources have it.
  std::string source{};
};

/// Several sensors whose clouds become one cloud.
struct RigConfig {
  /// Coordinate frame of the merged clouds, such as "base_link". If empty, there is no rig.
  std::string frame{};
  /// Frame that does not move, such as "odom". If given, the pose of `frame` in it comes from transforms.
  std::string fixed_frame{};
  /// Topic of type nav_msgs/Odometry, recorded or live, whose poses replace those of /tf for the frame that
  /// it names as its child. If empty: /tf, or in a recording without /tf the first topic of this type.
  std::string odometry{};
  /// Clouds whose stamps differ by less than this belong to one frame, milliseconds, above 0, at most 1000.
  /// Live sources also wait for a late cloud for this time.
  double sync_ms = 50;
  std::string urdf{};  ///< URDF file of the robot, whose fixed joints are transforms. May be empty.
  /// Drop points inside the collision geometry of the URDF, inflated by this, metres.
  std::optional<double> self_filter{};
  std::vector<RigSensor> sensors{};  ///< If empty: all sources and all their topics of clouds.

  /// Returns a line for each value that is not allowed.
  std::vector<std::string> validate() const;
};

/// Opens several sources as one, whose frames have the clouds of all sensors in the frame `rig.frame`.
///
/// Transforms between frames come from RigSensor::pose, from the URDF, and from the topics /tf, /tf_static
/// and RigConfig::odometry of recordings and of ROS 2. Between two transforms of a topic, which are at most
/// 0.5 s apart, poses are interpolated. A cloud without a transform to `rig.frame` gives a FrameError; it is
/// never used without one.
///
/// Clouds belong to one frame if their stamps are less than `rig.sync_ms` after the first one, whose stamp
/// the frame has. Frame::seconds has the time of each point, also of sensors without own times, so that
/// deskewing compensates the different stamps. If a sensor sends nothing, the other sensors' frames go on,
/// and take_warnings() tells which sensor is silent. A cloud of a sensor whose clock differs from the others'
/// by more than 1 s gives a FrameError. Points without a return, at (0, 0, 0), become NaN. Clouds of
/// recordings have their own stamps, whatever ReplayOptions::own_stamps is.
///
/// Throws as open_source() for each source, std::invalid_argument if a sensor of `rig.sensors` has no source
/// or the other way round, or if several sources have its topic and it names none of them, if sources are of
/// different kinds (FrameTimes), if `options` has loops or a frame_id, or if no recording has the topic
/// `rig.odometry`, and IoError if the URDF cannot be read.
std::unique_ptr<FrameSource> open_rig(const std::vector<std::string>& sources, const RigConfig& rig,
                                      const ReplayOptions& options = {});

/// Returns the region of the collision shapes of `rig.urdf` in the frame `rig.frame`, inflated by
/// `rig.self_filter`, for FilterConfig::regions. Returns nullopt if `rig.self_filter` is not set. Joints that
/// move are at position 0. `warnings` gets a line for each such joint and for each shape that is left out.
/// Throws IoError if the URDF cannot be read, or has no link `rig.frame` or no shape.
std::optional<RegionConfig> robot_body(const RigConfig& rig, std::vector<std::string>& warnings);

/// Creates a source from a function that fills the next frame and returns false at the end.
/// FrameSource::next() rethrows the exceptions of the function.
///
/// The function may block, because each call runs in its own thread. A call that is still running when the
/// source is destroyed is not stopped. Everything that the function uses must live until that call returns.
std::unique_ptr<FrameSource> make_source(std::function<bool(Frame&)> next);

/// Returns the time in a file name without extension, nanoseconds; -1 if there is none.
///
/// A name may contain several times. stamp_in_name() uses the first format of the list below that occurs in
/// the name, and returns the last time in this format.
/// 1. A time since 1970: seconds of 2001 to 2033, also with a fraction; a whole number of milli- or
///    microseconds of 2001 to 2262; or a whole number of nanoseconds, at least 1e16.
/// 2. A date with hours, minutes and seconds, in UTC or in a time zone east of UTC such as +0800. Zones west
///    of UTC such as -0500 are ignored.
/// 3. A time of day.
/// 4. Other seconds with a decimal point.
///
/// Other numbers are treated as frame numbers and ignored. ReplayOptions::own_stamps describes how the names
/// of a whole folder are read.
std::int64_t stamp_in_name(std::string_view stem);

}  // namespace pcl_bv
