// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/schema.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl_bv {
namespace {

// Definitions by type name. In a definition, each type is written with its package, which ROS allows
// everywhere.
constexpr std::pair<std::string_view, std::string_view> kDefinitions[]{
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/Point32", "float32 x\nfloat32 y\nfloat32 z\n"},
    {"geometry_msgs/Polygon", "geometry_msgs/Point32[] points\n"},
    {"geometry_msgs/PolygonStamped", "std_msgs/Header header\ngeometry_msgs/Polygon polygon\n"},
    {"geometry_msgs/PolygonInstance", "geometry_msgs/Polygon polygon\nint64 id\n"},
    {"geometry_msgs/PolygonInstanceStamped",
     "std_msgs/Header header\ngeometry_msgs/PolygonInstance polygon\n"},
    {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    {"geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/PointField",
     "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
     "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n"},
    {"sensor_msgs/PointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"},
    {"livox_ros_driver/CustomPoint",
     "uint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\nuint8 reflectivity\nuint8 tag\nuint8 line\n"},
    {"livox_ros_driver/CustomMsg",
     "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] rsvd\n"
     "livox_ros_driver/CustomPoint[] points\n"},
    {"livox_ros_driver2/CustomPoint",
     "uint32 offset_time\nfloat32 x\nfloat32 y\nfloat32 z\nuint8 reflectivity\nuint8 tag\nuint8 line\n"},
    {"livox_ros_driver2/CustomMsg",
     "std_msgs/Header header\nuint64 timebase\nuint32 point_num\nuint8 lidar_id\nuint8[3] rsvd\n"
     "livox_ros_driver2/CustomPoint[] points\n"},
    {"point_cloud_interfaces/CompressedPointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] compressed_data\nbool is_dense\nstring "
     "format\n"},
    {"draco_point_cloud_transport/CompressedPointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] compressed_data\nbool is_dense\n"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"diagnostic_msgs/KeyValue", "string key\nstring value\n"},
    {"diagnostic_msgs/DiagnosticStatus",
     "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\n"
     "string hardware_id\ndiagnostic_msgs/KeyValue[] values\n"},
    {"diagnostic_msgs/DiagnosticArray",
     "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"},
    {"vision_msgs/ObjectHypothesis", "string class_id\nfloat64 score\n"},
    {"vision_msgs/ObjectHypothesisWithPose",
     "vision_msgs/ObjectHypothesis hypothesis\ngeometry_msgs/PoseWithCovariance pose\n"},
    {"vision_msgs/BoundingBox3D", "geometry_msgs/Pose center\ngeometry_msgs/Vector3 size\n"},
    {"vision_msgs/Detection3D",
     "std_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n"
     "vision_msgs/BoundingBox3D bbox\nstring id\n"},
    {"vision_msgs/Detection3DArray", "std_msgs/Header header\nvision_msgs/Detection3D[] detections\n"},
    {"unique_identifier_msgs/UUID", "uint8[16] uuid\n"},
    {"nav2_dynamic_msgs/Obstacle",
     "unique_identifier_msgs/UUID uuid\nfloat32 score\ngeometry_msgs/Point position\n"
     "geometry_msgs/Vector3 velocity\ngeometry_msgs/Vector3 size\nfloat64[9] position_covariance\n"
     "float64[9] velocity_covariance\n"},
    {"nav2_dynamic_msgs/ObstacleArray", "std_msgs/Header header\nnav2_dynamic_msgs/Obstacle[] obstacles\n"},
    {"object_recognition_msgs/ObjectType", "string key\nstring db\n"},
    {"shape_msgs/SolidPrimitive",
     "uint8 BOX=1\nuint8 SPHERE=2\nuint8 CYLINDER=3\nuint8 CONE=4\nuint8 PRISM=5\nuint8 type\n"
     "float64[<=3] dimensions\nuint8 BOX_X=0\nuint8 BOX_Y=1\nuint8 BOX_Z=2\nuint8 SPHERE_RADIUS=0\n"
     "uint8 CYLINDER_HEIGHT=0\nuint8 CYLINDER_RADIUS=1\nuint8 CONE_HEIGHT=0\nuint8 CONE_RADIUS=1\n"
     "uint8 PRISM_HEIGHT=0\ngeometry_msgs/Polygon polygon\n"},
    {"shape_msgs/MeshTriangle", "uint32[3] vertex_indices\n"},
    {"shape_msgs/Mesh", "shape_msgs/MeshTriangle[] triangles\ngeometry_msgs/Point[] vertices\n"},
    {"shape_msgs/Plane", "float64[4] coef\n"},
    {"geometry_msgs/Wrench", "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n"},
    {"sensor_msgs/JointState",
     "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"},
    {"sensor_msgs/MultiDOFJointState",
     "std_msgs/Header header\nstring[] joint_names\ngeometry_msgs/Transform[] transforms\n"
     "geometry_msgs/Twist[] twist\ngeometry_msgs/Wrench[] wrench\n"},
    {"trajectory_msgs/JointTrajectoryPoint",
     "float64[] positions\nfloat64[] velocities\nfloat64[] accelerations\nfloat64[] effort\n"
     "builtin_interfaces/Duration time_from_start\n"},
    {"trajectory_msgs/JointTrajectory",
     "std_msgs/Header header\nstring[] joint_names\ntrajectory_msgs/JointTrajectoryPoint[] points\n"},
    {"octomap_msgs/Octomap",
     "std_msgs/Header header\nbool binary\nstring id\nfloat64 resolution\nint8[] data\n"},
    {"octomap_msgs/OctomapWithPose",
     "std_msgs/Header header\ngeometry_msgs/Pose origin\noctomap_msgs/Octomap octomap\n"},
    {"moveit_msgs/CollisionObject",
     "std_msgs/Header header\ngeometry_msgs/Pose pose\nstring id\nobject_recognition_msgs/ObjectType type\n"
     "shape_msgs/SolidPrimitive[] primitives\ngeometry_msgs/Pose[] primitive_poses\n"
     "shape_msgs/Mesh[] meshes\ngeometry_msgs/Pose[] mesh_poses\nshape_msgs/Plane[] planes\n"
     "geometry_msgs/Pose[] plane_poses\nstring[] subframe_names\ngeometry_msgs/Pose[] subframe_poses\n"
     "byte ADD=0\nbyte REMOVE=1\nbyte APPEND=2\nbyte MOVE=3\nbyte operation\n"},
    {"moveit_msgs/AttachedCollisionObject",
     "string link_name\nmoveit_msgs/CollisionObject object\nstring[] touch_links\n"
     "trajectory_msgs/JointTrajectory detach_posture\nfloat64 weight\n"},
    {"moveit_msgs/RobotState",
     "sensor_msgs/JointState joint_state\nsensor_msgs/MultiDOFJointState multi_dof_joint_state\n"
     "moveit_msgs/AttachedCollisionObject[] attached_collision_objects\nbool is_diff\n"},
    {"moveit_msgs/AllowedCollisionEntry", "bool[] enabled\n"},
    {"moveit_msgs/AllowedCollisionMatrix",
     "string[] entry_names\nmoveit_msgs/AllowedCollisionEntry[] entry_values\n"
     "string[] default_entry_names\nbool[] default_entry_values\n"},
    {"moveit_msgs/LinkPadding", "string link_name\nfloat64 padding\n"},
    {"moveit_msgs/LinkScale", "string link_name\nfloat64 scale\n"},
    {"moveit_msgs/ObjectColor", "string id\nstd_msgs/ColorRGBA color\n"},
    {"moveit_msgs/PlanningSceneWorld",
     "moveit_msgs/CollisionObject[] collision_objects\noctomap_msgs/OctomapWithPose octomap\n"},
    {"moveit_msgs/PlanningScene",
     "string name\nmoveit_msgs/RobotState robot_state\nstring robot_model_name\n"
     "geometry_msgs/TransformStamped[] fixed_frame_transforms\n"
     "moveit_msgs/AllowedCollisionMatrix allowed_collision_matrix\n"
     "moveit_msgs/LinkPadding[] link_padding\nmoveit_msgs/LinkScale[] link_scale\n"
     "moveit_msgs/ObjectColor[] object_colors\nmoveit_msgs/PlanningSceneWorld world\nbool is_diff\n"},
    {"vision_msgs/BoundingBox3DArray", "std_msgs/Header header\nvision_msgs/BoundingBox3D[] boxes\n"},
    {"vision_msgs/VisionClass", "uint16 class_id\nstring class_name\n"},
    {"vision_msgs/LabelInfo",
     "std_msgs/Header header\nvision_msgs/VisionClass[] class_map\nfloat32 threshold\n"},
    {"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    {"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    {"visualization_msgs/Marker",
     "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\nint32 LINE_STRIP=4\nint32 LINE_LIST=5\n"
     "int32 CUBE_LIST=6\nint32 SPHERE_LIST=7\nint32 POINTS=8\nint32 TEXT_VIEW_FACING=9\n"
     "int32 MESH_RESOURCE=10\nint32 TRIANGLE_LIST=11\nint32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\n"
     "int32 DELETEALL=3\nstd_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
     "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
     "builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
     "std_msgs/ColorRGBA[] colors\nstring texture_resource\nsensor_msgs/CompressedImage texture\n"
     "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n"
     "visualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n"},
    {"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
    {"foxglove_msgs/Color", "float64 r\nfloat64 g\nfloat64 b\nfloat64 a\n"},
    {"foxglove_msgs/KeyValuePair", "string key\nstring value\n"},
    {"foxglove_msgs/ArrowPrimitive",
     "geometry_msgs/Pose pose\nfloat64 shaft_length\nfloat64 shaft_diameter\nfloat64 head_length\n"
     "float64 head_diameter\nfoxglove_msgs/Color color\n"},
    {"foxglove_msgs/CubePrimitive",
     "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 size\nfoxglove_msgs/Color color\n"},
    {"foxglove_msgs/SpherePrimitive",
     "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 size\nfoxglove_msgs/Color color\n"},
    {"foxglove_msgs/CylinderPrimitive",
     "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 size\nfloat64 bottom_scale\nfloat64 top_scale\n"
     "foxglove_msgs/Color color\n"},
    {"foxglove_msgs/LinePrimitive",
     "uint8 LINE_STRIP=0\nuint8 LINE_LOOP=1\nuint8 LINE_LIST=2\nuint8 type\ngeometry_msgs/Pose pose\n"
     "float64 thickness\nbool scale_invariant\ngeometry_msgs/Point[] points\nfoxglove_msgs/Color color\n"
     "foxglove_msgs/Color[] colors\nuint32[] indices\n"},
    {"foxglove_msgs/TriangleListPrimitive",
     "geometry_msgs/Pose pose\ngeometry_msgs/Point[] points\nfoxglove_msgs/Color color\n"
     "foxglove_msgs/Color[] colors\nuint32[] indices\n"},
    {"foxglove_msgs/TextPrimitive",
     "geometry_msgs/Pose pose\nbool billboard\nfloat64 font_size\nbool scale_invariant\n"
     "foxglove_msgs/Color color\nstring text\n"},
    {"foxglove_msgs/ModelPrimitive",
     "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nfoxglove_msgs/Color color\nbool override_color\n"
     "string url\nstring media_type\nuint8[] data\n"},
    {"foxglove_msgs/SceneEntityDeletion",
     "uint8 MATCHING_ID=0\nuint8 ALL=1\nbuiltin_interfaces/Time timestamp\nuint8 type\nstring id\n"},
    {"foxglove_msgs/SceneEntity",
     "builtin_interfaces/Time timestamp\nstring frame_id\nstring id\nbuiltin_interfaces/Duration lifetime\n"
     "bool frame_locked\nfoxglove_msgs/KeyValuePair[] metadata\nfoxglove_msgs/ArrowPrimitive[] arrows\n"
     "foxglove_msgs/CubePrimitive[] cubes\nfoxglove_msgs/SpherePrimitive[] spheres\n"
     "foxglove_msgs/CylinderPrimitive[] cylinders\nfoxglove_msgs/LinePrimitive[] lines\n"
     "foxglove_msgs/TriangleListPrimitive[] triangles\nfoxglove_msgs/TextPrimitive[] texts\n"
     "foxglove_msgs/ModelPrimitive[] models\n"},
    {"foxglove_msgs/SceneUpdate",
     "foxglove_msgs/SceneEntityDeletion[] deletions\nfoxglove_msgs/SceneEntity[] entities\n"},
};

}  // namespace

std::string_view definition_of(std::string_view name) {
  const auto* const found = std::find_if(std::begin(kDefinitions), std::end(kDefinitions),
                                         [&](const auto& entry) { return entry.first == name; });
  if (found == std::end(kDefinitions))
    throw std::invalid_argument("unknown message type '" + std::string(name) + "'");
  return found->second;
}

}  // namespace pcl_bv
