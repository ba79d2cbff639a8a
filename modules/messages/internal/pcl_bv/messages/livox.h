// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clouds of Livox' drivers, which their users prefer to PointCloud2 because of the times of the points.
#pragma once

#include <optional>
#include <string>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/records.h"
#include "pcl_bv/messages/types.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// livox_ros_driver2/msg/CustomMsg. The type of the older driver (livox_ros_driver) has the same fields.
///
/// `points` are livox_ros_driver2/msg/CustomPoint: uint32 offset_time (nanoseconds after `timebase`), float32
/// x, y, z (metres), uint8 reflectivity, tag, line.
struct CustomMsg {
  static constexpr const char* ros_type = "livox_ros_driver2/msg/CustomMsg";
  static constexpr const char* old_ros_type = "livox_ros_driver/msg/CustomMsg";
  Header header;
  std::uint64_t timebase = 0;   ///< Time of the first point, nanoseconds.
  std::uint32_t point_num = 0;  ///< Number of points. Not used, because `points` has its own number.
  std::uint8_t lidar_id = 0;
  std::array<std::uint8_t, 3> rsvd{};
  Records<19, 4> points;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.timebase, m.point_num, m.lidar_id, m.rsvd, m.points);
  }
};

}  // namespace msg
namespace detail {

/// Returns a view of the message's points without a copy. The view is valid as long as the bytes of the
/// message. Returns nullopt if the message has the other byte order than this machine.
std::optional<PointView> view_points(const msg::CustomMsg& cloud);

/// Returns a view of the reflectivities (uint8) if view_points() returns a view and there are points.
std::optional<FieldView> view_intensity(const msg::CustomMsg& cloud);

/// Returns a view of the times of the points (uint32, nanoseconds after CustomMsg::timebase) under the same
/// conditions as view_intensity().
std::optional<FieldView> view_times(const msg::CustomMsg& cloud);

/// Returns an empty text: no field of this type is left out.
inline std::string skipped_fields_note(const msg::CustomMsg& /*cloud*/) {
  return {};
}

/// Returns a copy of the cloud with the fields of CustomPoint, in their order.
RawCloud raw_cloud_of(const msg::CustomMsg& cloud);

}  // namespace detail
}  // namespace pcl_bv
