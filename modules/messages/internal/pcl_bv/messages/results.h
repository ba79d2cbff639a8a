// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages about objects, of vision_msgs 4, visualization_msgs of Humble and later, and Foxglove's scenes.
// types.h describes each_field().
#pragma once

#include "pcl_bv/messages/types.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// std_msgs/msg/ColorRGBA.
struct ColorRGBA {
  float r = 0, g = 0, b = 0, a = 1;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.r, m.g, m.b, m.a);
  }
};

/// vision_msgs/msg/ObjectHypothesis.
struct ObjectHypothesis {
  std::string class_id;
  double score = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.class_id, m.score);
  }
};

/// vision_msgs/msg/ObjectHypothesisWithPose.
struct ObjectHypothesisWithPose {
  ObjectHypothesis hypothesis;
  PoseWithCovariance pose;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.hypothesis, m.pose);
  }
};

/// vision_msgs/msg/BoundingBox3D.
struct BoundingBox3D {
  Pose center;
  Vector3 size;  ///< Full edge lengths in metres, not half lengths.
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.center, m.size);
  }
};

/// vision_msgs/msg/Detection3D.
struct Detection3D {
  Header header;
  std::vector<ObjectHypothesisWithPose> results;
  BoundingBox3D bbox;
  std::string id;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.results, m.bbox, m.id);
  }
};

/// vision_msgs/msg/Detection3DArray.
struct Detection3DArray {
  static constexpr const char* ros_type = "vision_msgs/msg/Detection3DArray";
  Header header;
  std::vector<Detection3D> detections;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.detections);
  }
};

/// sensor_msgs/msg/CompressedImage.
struct CompressedImage {
  Header header;
  std::string format;
  Bytes data;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.format, m.data);
  }
};

/// visualization_msgs/msg/UVCoordinate.
struct UVCoordinate {
  float u = 0, v = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.u, m.v);
  }
};

/// visualization_msgs/msg/MeshFile.
struct MeshFile {
  std::string filename;
  Bytes data;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.filename, m.data);
  }
};

/// visualization_msgs/msg/Marker.
struct Marker {
  enum : std::int32_t { ARROW = 0, CUBE, SPHERE, CYLINDER, LINE_STRIP, LINE_LIST, TEXT_VIEW_FACING = 9 };
  enum : std::int32_t { ADD = 0, DELETE = 2, DELETEALL };
  Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t type = ARROW;
  std::int32_t action = ADD;
  Pose pose;
  Vector3 scale;
  ColorRGBA color;
  Duration lifetime;
  bool frame_locked = false;
  std::vector<Point> points;
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.ns, m.id, m.type, m.action, m.pose, m.scale, m.color, m.lifetime, m.frame_locked,
          m.points, m.colors);
    if constexpr (!Visit::ros1) visit(m.texture_resource, m.texture, m.uv_coordinates);
    visit(m.text, m.mesh_resource);
    if constexpr (!Visit::ros1) visit(m.mesh_file);
    visit(m.mesh_use_embedded_materials);
  }
};

/// visualization_msgs/msg/MarkerArray.
struct MarkerArray {
  static constexpr const char* ros_type = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.markers);
  }
};

/// foxglove_msgs/msg/Color.
struct SceneColor {
  double r = 0, g = 0, b = 0, a = 1;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.r, m.g, m.b, m.a);
  }
};

/// foxglove_msgs/msg/CubePrimitive and SpherePrimitive. `size` has the full lengths along the pose's axes.
struct SolidPrimitive {
  Pose pose;
  Vector3 size;
  SceneColor color;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.size, m.color);
  }
};

/// foxglove_msgs/msg/CylinderPrimitive.
struct CylinderPrimitive {
  Pose pose;
  Vector3 size;  ///< Full lengths. z is along the cylinder's axis.
  double bottom_scale = 1, top_scale = 1;
  SceneColor color;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.size, m.bottom_scale, m.top_scale, m.color);
  }
};

/// foxglove_msgs/msg/ArrowPrimitive.
struct ArrowPrimitive {
  Pose pose;  ///< The arrow points along x.
  double shaft_length = 0, shaft_diameter = 0, head_length = 0, head_diameter = 0;
  SceneColor color;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.shaft_length, m.shaft_diameter, m.head_length, m.head_diameter, m.color);
  }
};

/// foxglove_msgs/msg/LinePrimitive.
struct LinePrimitive {
  enum : std::uint8_t { LINE_STRIP = 0, LINE_LOOP, LINE_LIST };
  std::uint8_t type = LINE_LIST;
  Pose pose;
  double thickness = 1;
  bool scale_invariant = false;  ///< Whether `thickness` is in pixels.
  std::vector<Point> points;
  SceneColor color;
  std::vector<SceneColor> colors;
  std::vector<std::uint32_t> indices;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.type, m.pose, m.thickness, m.scale_invariant, m.points, m.color, m.colors, m.indices);
  }
};

/// foxglove_msgs/msg/TriangleListPrimitive.
struct TriangleListPrimitive {
  Pose pose;
  std::vector<Point> points;
  SceneColor color;
  std::vector<SceneColor> colors;
  std::vector<std::uint32_t> indices;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.points, m.color, m.colors, m.indices);
  }
};

/// foxglove_msgs/msg/TextPrimitive.
struct TextPrimitive {
  Pose pose;
  bool billboard = true;
  double font_size = 0;
  bool scale_invariant = false;
  SceneColor color;
  std::string text;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.billboard, m.font_size, m.scale_invariant, m.color, m.text);
  }
};

/// foxglove_msgs/msg/ModelPrimitive.
struct ModelPrimitive {
  Pose pose;
  Vector3 scale;
  SceneColor color;
  bool override_color = false;
  std::string url, media_type;
  Bytes data;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.scale, m.color, m.override_color, m.url, m.media_type, m.data);
  }
};

/// foxglove_msgs/msg/SceneEntityDeletion.
struct SceneEntityDeletion {
  enum : std::uint8_t { MATCHING_ID = 0, ALL };
  Time timestamp;
  std::uint8_t type = MATCHING_ID;
  std::string id;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.timestamp, m.type, m.id);
  }
};

/// foxglove_msgs/msg/SceneEntity.
struct SceneEntity {
  Time timestamp;
  std::string frame_id, id;
  Duration lifetime;
  bool frame_locked = false;
  std::vector<KeyValue> metadata;
  std::vector<ArrowPrimitive> arrows;
  std::vector<SolidPrimitive> cubes, spheres;
  std::vector<CylinderPrimitive> cylinders;
  std::vector<LinePrimitive> lines;
  std::vector<TriangleListPrimitive> triangles;
  std::vector<TextPrimitive> texts;
  std::vector<ModelPrimitive> models;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.timestamp, m.frame_id, m.id, m.lifetime, m.frame_locked, m.metadata, m.arrows, m.cubes, m.spheres,
          m.cylinders, m.lines, m.triangles, m.texts, m.models);
  }
};

/// foxglove_msgs/msg/SceneUpdate.
struct SceneUpdate {
  static constexpr const char* ros_type = "foxglove_msgs/msg/SceneUpdate";
  std::vector<SceneEntityDeletion> deletions;
  std::vector<SceneEntity> entities;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.deletions, m.entities);
  }
};

}  // namespace msg
}  // namespace pcl_bv
