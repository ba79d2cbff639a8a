// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Keeps the world of MoveIt's planning scene equal to the objects. Each frame adds all its objects again,
// since ADD replaces an object and thus also serves a late or lossy subscriber. MOVE would need an object
// that is known and has the same shape.

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "message_adapter.h"
#include "pcl_bv/messages/finite.h"
#include "pcl_bv/messages/moveit.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv::detail {
namespace {

void add_primitive(std::uint8_t type, std::vector<double> dimensions, const VolumeShape& shape,
                   msg::CollisionObject& object) {
  topics::set_pose(shape, object.pose);
  object.primitives.push_back({type, std::move(dimensions), {}});
  object.primitive_poses.emplace_back();
}

// Adds the triangles with their vertices relative to the middle of the box of the volume. Returns false if
// there are none.
bool add_mesh(const Mesh& mesh, const Aabb& box, msg::CollisionObject& object) {
  const Eigen::Vector3d middle = box.center();
  object.pose.position = {middle.x(), middle.y(), middle.z()};
  msg::TriangleMesh triangles;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3d at = vertex - middle;
    triangles.vertices.push_back({at.x(), at.y(), at.z()});
  }
  for (const std::vector<std::int32_t>& face : mesh.faces) {
    for (std::size_t k = 2; k < face.size(); ++k)
      triangles.triangles.push_back(
          {{static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[k - 1]),
            static_cast<std::uint32_t>(face[k])}});
  }
  if (triangles.triangles.empty()) return false;
  object.meshes.push_back(std::move(triangles));
  object.mesh_poses.emplace_back();
  return true;
}

// Shapes of MoveIt that contain the volume. Meshes of curved volumes would be inside them.
struct AddShape {
  msg::CollisionObject& object;

  void add_box(const AnyVolume& volume) const {
    const VolumeShape box = viewer_shape(volume);
    add_primitive(msg::ShapePrimitive::BOX, {box.size.begin(), box.size.end()}, box, object);
  }
  void operator()(const Aabb& box) const { add_box(box); }
  void operator()(const Obb& box) const { add_box(box); }
  void operator()(const Ellipsoid& ellipsoid) const { add_box(ellipsoid); }  // the box around it
  void operator()(const Sphere& sphere) const {
    add_primitive(msg::ShapePrimitive::SPHERE, {sphere.radius()}, viewer_shape(sphere), object);
  }
  void operator()(const Cylinder& cylinder) const {
    add_primitive(msg::ShapePrimitive::CYLINDER, {2 * cylinder.half_height(), cylinder.radius()},
                  viewer_shape(cylinder), object);
  }
  void operator()(const Capsule& capsule) const {
    const Eigen::Vector3d segment = capsule.b() - capsule.a();
    const Eigen::Vector3d axis = segment.isZero(0) ? Eigen::Vector3d::UnitZ() : segment;
    const double half = segment.norm() / 2 + capsule.radius();
    (*this)(Cylinder(capsule.center(), axis, capsule.radius(), half));
  }
  template <class Volume>
  void operator()(const Volume& volume) const {
    if (!add_mesh(volume.mesh(), volume.aabb(), object)) add_box(volume.aabb());
  }
};

class MoveItAdapter final : public MessageAdapter {
 public:
  MoveItAdapter(MessageSender& to, const std::string& prefix)
      : scenes_(to, prefix + "/planning_scene"),
        objects_(to, topic_of_objects(prefix + "/collision_object")) {}

  void write(const Frame& frame, const FrameResult& result) override {
    if (!scenes_.has_subscribers() && !objects_.has_subscribers()) return;
    topics::set_header(frame, header_);
    stamp_ns_ = frame.header.stamp_ns;
    clear();
    std::set<std::string> now;
    for (std::size_t i = 0; i < result.clusters.size(); ++i)
      add_object(result, i, now);
    for (const std::uint32_t track : result.active_tracks) {  // those without a cluster in this frame stay
      const std::string id = kPrefix + std::to_string(track);
      if (shown_.count(id) != 0) now.insert(id);
    }
    std::vector<std::string> ended;
    std::set_difference(shown_.begin(), shown_.end(), now.begin(), now.end(), std::back_inserter(ended));
    for (const std::string& id : ended)
      remove_object(id);
    shown_ = std::move(now);
    send();
  }

  void close() override {
    clear();
    for (const std::string& id : std::exchange(shown_, {}))
      remove_object(id);
    send();
  }

 private:
  static constexpr const char* kPrefix = "bv_";

  void clear() {
    scene_.collision_objects.clear();
    scene_.object_colors.clear();
  }

  void add_object(const FrameResult& result, std::size_t cluster, std::set<std::string>& now) {
    for (std::size_t m = 0; m < result.methods.size(); ++m) {
      const AnyVolume& volume = result.volume(cluster, m);
      if (!result.is_requested(cluster, m) || empty(volume)) continue;
      const TrackEntry* const track = result.track_of(cluster);
      msg::CollisionObject object;
      object.header = header_;
      object.id =
          kPrefix + (track != nullptr ? std::to_string(track->id) : "cluster_" + std::to_string(cluster));
      std::visit(AddShape{object}, volume);
      if (!is_finite(object)) return;
      msg::ObjectColor& colour = scene_.object_colors.emplace_back();
      colour.id = object.id;
      topics::set_colour(colour_of(result, cluster), colour.color);
      now.insert(object.id);
      scene_.collision_objects.push_back(std::move(object));
      return;
    }
  }

  void remove_object(const std::string& id) {
    msg::CollisionObject& object = scene_.collision_objects.emplace_back();
    object.header = header_;
    object.id = id;
    object.operation = msg::CollisionObject::REMOVE;
  }

  void send() {
    if (scene_.collision_objects.empty()) return;
    scene_.is_diff = scene_.robot_state.is_diff = true;
    if (scenes_.has_subscribers()) scenes_.send(stamp_ns_, scene_);
    if (!objects_.has_subscribers()) return;
    for (const msg::CollisionObject& object : scene_.collision_objects)
      objects_.send(stamp_ns_, object);
  }

  AdapterTopic<msg::PlanningScene> scenes_;
  AdapterTopic<msg::CollisionObject> objects_;
  msg::Header header_;  // of the last frame
  std::int64_t stamp_ns_ = 0;
  std::set<std::string> shown_;  // ids of the objects in the scene
  msg::PlanningScene scene_;
};

}  // namespace

std::unique_ptr<MessageAdapter> make_moveit_adapter(MessageSender& to, const std::string& prefix) {
  return std::make_unique<MoveItAdapter>(to, prefix);
}

}  // namespace pcl_bv::detail
