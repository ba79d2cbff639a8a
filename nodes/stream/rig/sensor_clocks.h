// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Compares the clocks of the sensors of a rig: the stamp of each cloud with the time at which the cloud was
/// recorded or came, which one machine has measured for all sensors. Clouds of clocks that differ would be
/// merged with clouds of another moment.
///
/// One sensor's clock is the reference: that of the first cloud. Simulated time may run faster or slower than
/// real time, so a cloud is compared with the latest one of the reference. Another sensor becomes the
/// reference if the reference is silent, or if the stamp of its latest cloud jumped and the others' did not.
class SensorClocks {
 public:
  /// `sync_ns`: the largest difference of clocks that is not noticed.
  SensorClocks(std::size_t sensors, double sync_ns) : sensors_(sensors), sync_ns_(sync_ns) {}

  /// What was found about a cloud. Differences are positive if the clock is ahead.
  struct Found {
    std::optional<std::size_t> reference;  ///< Not set if the clock agrees with the reference.
    std::int64_t difference_ns = 0;        ///< To the reference.
    bool unusable = false;                 ///< The clocks differ by more than one second.
    /// The sensor whose latest cloud has a stamp of another time, which this cloud shows.
    std::optional<std::size_t> jumped;

    /// Returns how the clock differs, such as "its clock is 1.910 s ahead of that of /rear/points".
    std::string text(const std::string& reference_name) const;
  };

  /// Notes a cloud of the sensor. A difference that is unusable is found for each cloud, a smaller one above
  /// `sync_ns` once for each sensor, after 20 clouds in a row.
  Found note(std::size_t sensor, std::int64_t stamp_ns, std::int64_t measured_ns);

  /// Forgets all clouds.
  void restart();

 private:
  struct Sensor {
    int differing = 0;  // successive clouds that differ in the same direction
    bool reported = false;
  };

  bool note_reference(std::size_t sensor, double ahead);

  std::vector<Sensor> sensors_;
  double sync_ns_;
  std::optional<std::size_t> reference_;
  double latest_ = 0, before_ = 0;      // of the last two clouds of the reference: stamp minus measured time
  std::uint64_t clouds_of_others_ = 0;  // since the latest one of the reference
};

}  // namespace detail
}  // namespace pcl_bv
