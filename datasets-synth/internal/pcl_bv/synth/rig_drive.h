// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A robot with two LiDARs that turns in a yard. The sweeps are measured column by column while it moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

struct RigDriveOptions {
  std::uint64_t seed = 1;
  double speed = 8;                ///< m/s, on a circle to the left.
  double degrees_per_second = 30;  ///< Yaw rate.
  double noise = 0.01;             ///< Standard deviation of ranges, metres.
  /// Whether the robot and all others move within a sweep. If not, they stand at the time of its stamp.
  bool rolling = true;
  std::size_t beams = 32, columns = 1024;  ///< Columns of a whole turn.
};

/// Duration of a sweep, and time between two sweeps of a sensor, seconds.
inline constexpr double kRigSweepSeconds = 0.1;
/// Number of sensors.
inline constexpr std::size_t kRigSensors = 2;
/// Frame ids of the sensors.
inline constexpr std::array<const char*, kRigSensors> kRigFrames{"front_lidar", "rear_lidar"};
/// Seconds by which the sweeps of each sensor begin after those of the first.
inline constexpr std::array<double, kRigSensors> kRigDelays{0, 0.03};

/// A pose as the upper three rows of its matrix, row by row.
using RigPose = std::array<double, 12>;

/// An upright box or, if `radius` is not 0, an upright cylinder on the ground, at a time.
struct RigObject {
  enum class Kind : std::uint8_t { wall, pole, person, parked_car, moving_car };
  Kind kind = Kind::wall;
  double x = 0, y = 0, yaw = 0;  ///< Centre and yaw in the fixed frame, metres and radians.
  double length = 0, width = 0, height = 0, radius = 0;
};

/// Part of a turn that a sensor measures; the robot's body occludes the rest.
struct RigSweep {
  double seconds = 0;                  ///< Time of its beginning.
  std::vector<float> xyz;              ///< In the sensor's frame, metres; 0, 0, 0 without a return.
  std::vector<std::uint16_t> ring;     ///< Beam, from the lowest.
  std::vector<std::uint32_t> time_ns;  ///< After the beginning.
  std::vector<std::uint32_t> object;   ///< 1 + the number of the object, 0 for the ground and no return.
};

/// The yard and the robot in it. The same options give the same bits on the same machine.
class RigDrive {
 public:
  /// Throws std::invalid_argument unless the numbers are positive (the noise may be 0) and there
  /// are at least two beams.
  explicit RigDrive(const RigDriveOptions& options);

  /// Returns the pose of the robot in the fixed frame. The robot's origin is on the ground.
  RigPose pose(double seconds) const;
  /// Returns the pose of a sensor in the robot's frame.
  static RigPose mounting(std::size_t sensor);
  /// Returns all objects at a time, always in the same order.
  std::vector<RigObject> objects(double seconds) const;
  /// Returns sweep number `number` of a sensor. O(points * objects), about 30 ms.
  RigSweep sweep(std::size_t sensor, std::size_t number) const;

 private:
  RigDriveOptions options_;
  std::vector<RigObject> standing_;
};

/// Length and seed of a recording of the drive.
struct RigSequence {
  std::size_t frames = 300;
  std::uint64_t seed = 1;
};
/// Parses "rig[:FRAMES[:SEED]]". Throws std::invalid_argument for another text.
RigSequence parse_rig_sequence(const std::string& text);
/// Returns whether the text begins as those of parse_rig_sequence().
bool is_rig_sequence(const std::string& text);

}  // namespace detail
}  // namespace pcl_bv
