// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts ROS messages to frames, and results to ROS messages. The templates work with any message types
// that have ROS's field names, namely those of pcl_bv/messages, of ROS 1 and of ROS 2 (rosidl). Poses are in
// the frame of the points.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "pcl_bv/messages/types.h"
#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Types of messages that are clouds.
enum class CloudType : std::uint8_t {
  point_cloud2,  ///< sensor_msgs/msg/PointCloud2.
  livox,         ///< livox_ros_driver2/msg/CustomMsg or livox_ros_driver/msg/CustomMsg.
  compressed,    ///< point_cloud_interfaces/msg/CompressedPointCloud2.
  /// draco_point_cloud_transport/CompressedPointCloud2 of ROS 1.
  compressed_draco
};

/// A serialised message and the owner of its bytes.
struct CloudMessage {
  const std::byte* data = nullptr;
  std::size_t size = 0;
  std::shared_ptr<const void> owner;
  bool ros1 = false;  ///< Whether `data` has ROS 1 encoding. Otherwise: CDR with its encapsulation header.
  CloudType type = CloudType::point_cloud2;
};

/// Parses a sensor_msgs/msg/PointCloud2. The result refers to the point data in the bytes of `message` and
/// does not copy them. Throws MessageError if the message is not a PointCloud2.
msg::PointCloud2 cloud_in(const CloudMessage& message);

/// Turns a cloud into a frame.
///
/// Sets points, intensity, times, owner, frame_id and the stamp, which may be 0.
/// Sets `note` to the names of fields that cannot be read (skipped_fields_note()). Points are not copied if
/// they can be read in place (view_points()). If `class_field` is not empty, Frame::classes gets the values
/// of that integer field. Throws MessageError if the message is not of CloudMessage::type, and
/// std::runtime_error if the class field cannot be used (integers_of()).
///
/// Livox' messages have the fields offset_time (times), x, y, z, reflectivity (intensity), tag and line.
void read_cloud_message(const CloudMessage& message, const std::string& class_field, Frame& frame);

/// As the function above, for a parsed message; `owner` keeps its data alive.
void read_cloud_message(const msg::PointCloud2& cloud, const std::shared_ptr<const void>& owner,
                        const std::string& class_field, Frame& frame);

/// A volume as a shape that viewers can draw.
struct VolumeShape {
  enum class Kind : std::uint8_t {
    cube,
    sphere,    ///< A sphere or an ellipsoid; VolumeShape::size holds the diameters.
    cylinder,  ///< The axis of the cylinder is z.
    lines      ///< Edges, for shapes that viewers do not know.
  };
  Kind kind = Kind::lines;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{0, 0, 0, 1};   ///< x, y, z, w.
  std::array<double, 3> size{};                    ///< Full lengths along the shape's axes; 1 for `lines`.
  std::vector<std::array<double, 3>> line_points;  ///< Two points per line, in the frame of the points.
};

/// Returns the shape of a volume. An empty volume gives `lines` without points.
VolumeShape viewer_shape(const AnyVolume& volume);

/// Returns the shapes of all volumes in the order of FrameResult::volumes. Empty volumes and volumes that
/// were not requested give `lines` without points. Call viewer_shapes() once per frame and use the result for
/// all messages, because computing the edges of a k-DOP costs as much as fitting the k-DOP.
std::vector<VolumeShape> viewer_shapes(const FrameResult& result);

/// Returns a box of a cluster as a shape: the first volume that is a box or, if no volume is a box, the
/// axis-aligned box of the first volume. A cluster without volumes gives `lines` without points.
VolumeShape box_of(const FrameResult& result, std::size_t cluster);

/// Returns the colour of a cluster (red, green, blue, alpha), 0 to 1. A tracked object keeps its colour.
std::array<float, 4> colour_of(const FrameResult& result, std::size_t cluster);

/// Returns the id of a cluster for viewers. It is the id of the cluster's track. Until the track has an id,
/// it is "cluster " and the number of the cluster in the frame.
std::string object_id(const FrameResult& result, std::size_t cluster);

namespace topics {

/// Whether a time or duration type has the field nanosec (ROS 2) instead of nsec (ROS 1).
template <class Time, class = void>
struct HasNanosec : std::false_type {};
template <class Time>
struct HasNanosec<Time, std::void_t<decltype(std::declval<Time&>().nanosec)>> : std::true_type {};

template <class Time>
void set_time(std::int64_t nanoseconds, Time& time) {
  constexpr std::int64_t second = 1'000'000'000;
  std::int64_t whole = nanoseconds / second, rest = nanoseconds % second;
  if (rest < 0) {
    --whole;
    rest += second;
  }
  time.sec = static_cast<decltype(time.sec)>(whole);
  if constexpr (HasNanosec<Time>::value) {
    time.nanosec = static_cast<decltype(time.nanosec)>(rest);
  } else {
    time.nsec = static_cast<decltype(time.nsec)>(rest);
  }
}

template <class Time>
msg::Time time_from(const Time& time) {
  if constexpr (HasNanosec<Time>::value) {
    return {static_cast<std::int32_t>(time.sec), time.nanosec};
  } else {
    return {static_cast<std::int32_t>(time.sec), time.nsec};
  }
}

template <class Header>
void set_header(const Frame& frame, Header& header) {
  set_time(frame.header.stamp_ns, header.stamp);
  header.frame_id = frame.header.frame_id;
}

template <class Point>
void set_point(const std::array<double, 3>& from, Point& to) {
  to.x = from[0];
  to.y = from[1];
  to.z = from[2];
}

template <class Pose>
void set_pose(const VolumeShape& from, Pose& pose) {
  set_point(from.position, pose.position);
  pose.orientation.x = from.orientation[0];
  pose.orientation.y = from.orientation[1];
  pose.orientation.z = from.orientation[2];
  pose.orientation.w = from.orientation[3];
}

template <class Colour>
void set_colour(const std::array<float, 4>& from, Colour& to) {
  to.r = from[0];
  to.g = from[1];
  to.b = from[2];
  to.a = from[3];
}

}  // namespace topics

/// Turns a sensor_msgs/PointCloud2 into a frame as read_cloud_message() does. `pointer` owns the message
/// (std::shared_ptr, std::unique_ptr or boost::shared_ptr) and is stored in the frame. Points are not copied
/// if they can be read in place.
template <class Pointer>
void read_cloud(Pointer pointer, const std::string& class_field, Frame& frame) {
  const auto owner = std::make_shared<const Pointer>(std::move(pointer));
  const auto& cloud = **owner;
  msg::PointCloud2 view;  // everything but the data is copied
  view.header.stamp = topics::time_from(cloud.header.stamp);
  view.header.frame_id = cloud.header.frame_id;
  view.height = cloud.height;
  view.width = cloud.width;
  for (const auto& field : cloud.fields)
    view.fields.push_back({field.name, field.offset, field.datatype, field.count});
  view.is_bigendian = cloud.is_bigendian != 0;
  view.point_step = cloud.point_step;
  view.row_step = cloud.row_step;
  view.data = {reinterpret_cast<const std::byte*>(cloud.data.data()), cloud.data.size()};
  view.is_dense = cloud.is_dense != 0;
  read_cloud_message(view, owner, class_field, frame);
}

/// Fills a vision_msgs/Detection3DArray with a box for each cluster. The id of a detection is the id of the
/// cluster's track, or empty until the track has an id. Each detection has one result with the class (empty
/// without classes), score 1, the pose of the box and the variances of the track's position.
template <class Array>
void fill_detections(const Frame& frame, const FrameResult& result, Array& array) {
  topics::set_header(frame, array.header);
  array.detections.clear();
  for (std::size_t i = 0; i < result.clusters.size(); ++i) {
    array.detections.emplace_back();
    auto& detection = array.detections.back();
    topics::set_header(frame, detection.header);
    const VolumeShape box = box_of(result, i);
    topics::set_pose(box, detection.bbox.center);
    topics::set_point(box.size, detection.bbox.size);
    detection.results.resize(1);
    auto& hypothesis = detection.results.front();
    if (!result.class_of.empty()) hypothesis.hypothesis.class_id = std::to_string(result.class_of[i]);
    hypothesis.hypothesis.score = 1;
    topics::set_pose(box, hypothesis.pose.pose);
    const TrackEntry* const track = result.track_of(i);
    if (track == nullptr) continue;
    detection.id = std::to_string(track->id);
    // diagonal of x, y, z in the packed upper triangle of a 6 x 6 matrix
    for (std::size_t axis = 0; axis < 3; ++axis) {
      constexpr std::size_t diagonal[] = {0, 6, 11};
      hypothesis.pose.covariance[7 * axis] = track->covariance[diagonal[axis]];
    }
  }
}

/// Fills a geometry_msgs/PolygonStamped with the footprint of a prism, as costmaps read it: the corners of
/// the outline at the height low(), counter-clockwise seen from above, rounded to float. Rounding can move a
/// corner inward by half a unit in the last place of its coordinates. An empty prism gives no points.
/// The polygon is not convex if the outline of the prism is not.
template <class Polygon>
void fill_footprint(const Frame& frame, const Prism& prism, Polygon& message) {
  topics::set_header(frame, message.header);
  message.polygon.points.clear();
  for (const Eigen::Vector3d& corner : prism.footprint()) {
    message.polygon.points.emplace_back();
    auto& point = message.polygon.points.back();
    point.x = static_cast<float>(corner.x());
    point.y = static_cast<float>(corner.y());
    point.z = static_cast<float>(corner.z());
  }
}

/// The set of markers or entities that viewers show. It is stored in order to delete the markers or entities
/// of objects that have ended.
class ShownObjects {
 public:
  /// Replaces the set of shown objects by `now`. Returns the shown objects that are not in `now`.
  std::set<std::pair<std::string, std::int32_t>> replace(std::set<std::pair<std::string, std::int32_t>> now);

 private:
  std::set<std::pair<std::string, std::int32_t>> shown_;
};

/// Fills a visualization_msgs/MarkerArray with a marker for each volume that is not empty, and deletes the
/// markers of `shown` whose objects have ended. The namespace of a marker is the method. The id of a marker
/// is the id of the track, or negative until the track has an id. Markers last `lifetime_ns`. `volumes` is
/// viewer_shapes(result).
template <class Array>
void fill_markers(const Frame& frame, const FrameResult& result, const std::vector<VolumeShape>& volumes,
                  std::int64_t lifetime_ns, ShownObjects& shown, Array& array) {
  using Marker = typename std::decay<decltype(array.markers.front())>::type;
  array.markers.clear();
  std::set<std::pair<std::string, std::int32_t>> now;
  const auto add = [&](const std::string& ns, std::int32_t id) -> Marker& {
    array.markers.emplace_back();
    Marker& marker = array.markers.back();
    topics::set_header(frame, marker.header);
    marker.ns = ns;
    marker.id = id;
    marker.pose.orientation.w = 1;
    return marker;
  };
  for (std::size_t i = 0; i < result.clusters.size(); ++i) {
    const TrackEntry* const track = result.track_of(i);
    // Clusters without a track get negative ids, which no track has.
    const auto id =
        track != nullptr ? static_cast<std::int32_t>(track->id) : -1 - static_cast<std::int32_t>(i);
    for (std::size_t m = 0; m < result.methods.size(); ++m) {
      if (!result.is_requested(i, m) || empty(result.volume(i, m))) continue;
      const VolumeShape& volume = volumes[i * result.methods.size() + m];
      Marker& marker = add(std::string(result.methods[m]->name), id);
      now.emplace(marker.ns, id);
      topics::set_pose(volume, marker.pose);
      topics::set_point(volume.size, marker.scale);
      topics::set_colour(colour_of(result, i), marker.color);
      topics::set_time(lifetime_ns, marker.lifetime);
      switch (volume.kind) {
        case VolumeShape::Kind::cube:
          marker.type = Marker::CUBE;
          break;
        case VolumeShape::Kind::sphere:
          marker.type = Marker::SPHERE;
          break;
        case VolumeShape::Kind::cylinder:
          marker.type = Marker::CYLINDER;
          break;
        case VolumeShape::Kind::lines:
          marker.type = Marker::LINE_LIST;
          marker.scale.x = 0.03;
          break;
      }
      marker.points.resize(volume.line_points.size());
      for (std::size_t k = 0; k < volume.line_points.size(); ++k)
        topics::set_point(volume.line_points[k], marker.points[k]);
    }
  }
  for (const auto& ended : shown.replace(std::move(now)))
    add(ended.first, ended.second).action = Marker::DELETE;
}

/// Lifetime of markers. It is three frame periods, at most 6 s, so that a viewer that misses a frame still
/// shows the objects.
class MarkerLifetime {
 public:
  /// Returns the lifetime for the next frame, nanoseconds; 300 ms for the first frame.
  std::int64_t next(std::int64_t stamp_ns);

 private:
  bool first_ = true;
  std::int64_t last_stamp_ns_ = 0, period_ns_ = 100'000'000;
};

/// Writes x, y and z as float32 and `label` as uint32 (from labels_of()), 16 bytes per point. If the frame
/// has intensities, `intensity` follows as float32, which makes 20 bytes per point.
void write_labelled_points(const Frame& frame, const FrameResult& result, std::byte* to);

namespace topics {

/// Fills all of a labelled cloud except its data.
template <class Cloud>
void set_labelled(const Frame& frame, const FrameResult& result, Cloud& cloud) {
  using Field = typename std::decay<decltype(cloud.fields.front())>::type;
  set_header(frame, cloud.header);
  const std::uint32_t fields = frame.intensity ? 5 : 4;
  cloud.fields.resize(fields);
  for (std::uint32_t i = 0; i < fields; ++i) {
    cloud.fields[i].name = std::array<const char*, 5>{"x", "y", "z", "label", "intensity"}[i];
    cloud.fields[i].offset = 4 * i;
    cloud.fields[i].datatype = i == 3 ? Field::UINT32 : Field::FLOAT32;
    cloud.fields[i].count = 1;
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(frame.points.count);
  cloud.point_step = 4 * fields;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_bigendian = false;
  cloud.is_dense = result.counts.nonfinite == 0;
}

}  // namespace topics

/// Fills a sensor_msgs/PointCloud2 with all points, in the format of write_labelled_points().
template <class Cloud>
void fill_points(const Frame& frame, const FrameResult& result, Cloud& cloud) {
  topics::set_labelled(frame, result, cloud);
  cloud.data.resize(std::size_t{cloud.point_step} * cloud.width);
  write_labelled_points(frame, result, reinterpret_cast<std::byte*>(cloud.data.data()));
}

/// Diagnostics of a stream, once per second of stream time.
class StreamHealth {
 public:
  /// Counts a lost frame.
  void count_lost() { ++lost_; }

  /// Records a processed frame. Returns whether a diagnostic message is due.
  bool record_frame(const Frame& frame, const FrameResult& result);

  /// Fills a diagnostic_msgs/DiagnosticArray. The values of the status are the number of frames, the number
  /// of lost frames, the number of objects in the last frame, and the duration of the slowest frame since the
  /// last message. The text of the status says whether frames were lost and contains the first warning under
  /// the current configuration.
  template <class Array>
  void fill(const Frame& frame, Array& array) {
    using Status = typename std::decay<decltype(array.status.front())>::type;
    topics::set_header(frame, array.header);
    array.status.resize(1);
    Status& status = array.status.front();
    status.level = lost_ > 0 || !warning_.empty() ? Status::WARN : Status::OK;
    status.name = "pcl_bv";
    status.message = lost_ > 0 ? "frames were lost" : warning_.empty() ? "running" : "";
    if (!warning_.empty()) status.message += (lost_ > 0 ? "; " : "") + warning_;
    const std::array<std::pair<const char*, std::string>, 4> values = take_values();
    status.values.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      status.values[i].key = values[i].first;
      status.values[i].value = values[i].second;
    }
  }

 private:
  std::array<std::pair<const char*, std::string>, 4> take_values();

  FrameWarnings warnings_;
  std::shared_ptr<const PipelineConfig> warned_config_;
  std::string warning_;
  std::uint64_t frames_ = 0, lost_ = 0;
  std::size_t objects_ = 0;
  std::int64_t last_message_ns_ = 0;
  double slowest_ms_ = 0;
};

}  // namespace
