// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "urdf.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

#include "mounting_pose.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::detail {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMaxUrdfBytes = std::size_t{16} << 20;
// tinyxml2 compares each attribute with all previous ones of its element. URDF has at most six.
constexpr std::size_t kMaxAttributes = 100;
constexpr std::uintmax_t kMaxMeshBytes = std::uintmax_t{2} << 30;  // of all meshes together
constexpr std::size_t kMaxWarnings = 20;

std::string attribute(const XMLElement& element, const char* name) {
  const char* const value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

[[noreturn]] void fail_at(const XMLElement& element, const std::string& what) {
  throw IoError(message_line("line " + std::to_string(element.GetLineNum()) + ": " + what));
}

// Throws IoError if an element has too many attributes, before the text is parsed.
void require_few_attributes(std::string_view text) {
  const auto skip = [&](std::size_t at, std::string_view end) {
    return std::min(text.find(end, at), text.size());
  };
  for (std::size_t at = text.find('<'); at < text.size(); at = skip(at, "<")) {
    if (text.substr(at).starts_with("<!--")) {
      at = skip(at, "-->");
    } else if (text.substr(at).starts_with("<![CDATA[")) {
      at = skip(at, "]]>");
    } else if (text.substr(at).starts_with("<?")) {
      at = skip(at, "?>");
    } else {
      const std::size_t begin = at;
      std::size_t attributes = 0;
      for (; at < text.size() && text[at] != '>'; ++at) {
        if (text[at] != '"' && text[at] != '\'') continue;
        at = skip(at + 1, text.substr(at, 1));
        if (++attributes > kMaxAttributes)
          throw IoError(position_in(text, begin) + ": an element has more than " +
                        std::to_string(kMaxAttributes) + " attributes");
      }
    }
  }
}

// Adds a warning. Of many warnings the rest is only counted in the last line.
void warn(std::vector<std::string>& warnings, std::size_t& count, const std::string& line) {
  if (++count <= kMaxWarnings) return warnings.push_back(message_line(line));
  if (count > kMaxWarnings + 1) warnings.pop_back();
  warnings.push_back(std::to_string(count - kMaxWarnings) + " more parts of the URDF have problems");
}

// Returns the numbers of an attribute. A missing attribute gives `missing`.
std::vector<double> numbers_of(const XMLElement& element, const char* name, std::vector<double> missing) {
  if (element.Attribute(name) == nullptr) return missing;
  const std::string text = attribute(element, name);
  std::string_view rest(text);
  std::vector<double> numbers;
  for (double number = 0; next_number(rest, number);)
    numbers.push_back(number);
  const bool valid = rest.empty() && numbers.size() == missing.size() &&
                     std::all_of(numbers.begin(), numbers.end(),
                                 [](double number) { return std::abs(number) <= kMaxCoordinate; });
  if (!valid)
    fail_at(element, std::string(name) + " '" + text + "' is not " +
                         (missing.size() == 1 ? "a number" : std::to_string(missing.size()) + " numbers"));
  return numbers;
}

Eigen::Vector3d vector_of(const XMLElement& element, const char* name, double missing) {
  const std::vector<double> n = numbers_of(element, name, {missing, missing, missing});
  return {n[0], n[1], n[2]};
}

double length_of(const XMLElement& element, const char* name) {
  const double length = numbers_of(element, name, {-1.0})[0];
  if (!(length > 0)) fail_at(element, std::string(name) + " is not above 0");
  return length;
}

// Returns the pose of the element `origin`, which may be missing.
Pose origin_of(const XMLElement& parent) {
  const XMLElement* const origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return Pose::Identity();
  return pose_of_angles(vector_of(*origin, "xyz", 0), vector_of(*origin, "rpy", 0));
}

std::vector<std::filesystem::path> folders_in(const char* variable, const std::string& below) {
  std::vector<std::filesystem::path> folders;
  const char* const value = std::getenv(variable);
  std::istringstream list(value == nullptr ? "" : value);
  for (std::string folder; std::getline(list, folder, ':');)
    if (!folder.empty()) folders.push_back(std::filesystem::path(folder) / below);
  return folders;
}

// Returns the file of a mesh's name, which may begin with package:// or file://.
std::filesystem::path mesh_file(const std::string& name, const std::filesystem::path& urdf) {
  constexpr std::string_view package = "package://", file = "file://";
  if (name.starts_with(file)) return name.substr(file.size());
  if (!name.starts_with(package)) return urdf.parent_path() / name;
  const std::filesystem::path in_package = name.substr(package.size());
  std::vector<std::filesystem::path> folders;
  const std::filesystem::path start = std::filesystem::absolute(urdf).parent_path();
  for (std::filesystem::path above = start; above != above.parent_path(); above = above.parent_path())
    folders.push_back(above);
  for (const auto& [variable, below] : {std::pair("ROS_PACKAGE_PATH", ""), {"AMENT_PREFIX_PATH", "share"}})
    std::ranges::copy(folders_in(variable, below), std::back_inserter(folders));
  std::error_code unknown;
  for (const std::filesystem::path& folder : folders) {
    if (std::filesystem::exists(folder / in_package, unknown)) return folder / in_package;
    // The folder of the package itself may be above the URDF.
    const std::filesystem::path inside = in_package.lexically_relative(*in_package.begin());
    if (folder.filename() == *in_package.begin() && std::filesystem::exists(folder / inside, unknown))
      return folder / inside;
  }
  throw IoError("not found in the folders above the URDF, in ROS_PACKAGE_PATH and in AMENT_PREFIX_PATH");
}

// A shape that this version cannot read. The rest of the robot is right without it.
struct UnreadableShape : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The meshes that were read. Many links may have the same mesh.
struct MeshBytes {
  std::uintmax_t read = 0;

  void add(const std::filesystem::path& file) {
    std::error_code unknown;
    if (std::filesystem::is_regular_file(file, unknown)) read += std::filesystem::file_size(file, unknown);
    if (read > kMaxMeshBytes) throw IoError("all meshes together have more than 2 GiB");
  }
};

AnyVolume mesh_volume(const XMLElement& mesh, const Pose& pose, const std::filesystem::path& urdf,
                      MeshBytes& bytes) {
  const Eigen::Vector3d scale = vector_of(mesh, "scale", 1);
  const std::string name = attribute(mesh, "filename");
  try {
    const std::filesystem::path file = mesh_file(name, urdf);
    bytes.add(file);
    std::vector<Eigen::Vector3d> vertices = read_mesh_vertices(file);
    for (Eigen::Vector3d& vertex : vertices)
      vertex = pose * Eigen::Vector3d(scale.cwiseProduct(vertex));
    const Fitted<Hull> hull = fit_hull(view(vertices));
    if (hull.volume.empty()) throw IoError("has no valid vertex");
    return hull.volume;
  } catch (const IoError& error) {
    throw UnreadableShape(name + ": " + error.what());
  }
}

// Returns the volume of an element `geometry`.
AnyVolume volume_of(const XMLElement& geometry, const Pose& pose, const std::filesystem::path& urdf,
                    MeshBytes& bytes) {
  if (const XMLElement* const box = geometry.FirstChildElement("box")) {
    const Eigen::Vector3d size = vector_of(*box, "size", -1);
    if (!(size.minCoeff() > 0)) fail_at(*box, "size is not above 0");
    return Obb(Eigen::Isometry3d(pose), size / 2);
  }
  if (const XMLElement* const sphere = geometry.FirstChildElement("sphere"))
    return Sphere(pose.translation(), length_of(*sphere, "radius"));
  if (const XMLElement* const cylinder = geometry.FirstChildElement("cylinder"))
    return Cylinder(pose.translation(), pose.linear().col(2), length_of(*cylinder, "radius"),
                    length_of(*cylinder, "length") / 2);
  if (const XMLElement* const mesh = geometry.FirstChildElement("mesh"))
    return mesh_volume(*mesh, pose, urdf, bytes);
  throw UnreadableShape("line " + std::to_string(geometry.GetLineNum()) +
                        ": the geometry is not a box, sphere, cylinder or mesh");
}

void read_shapes(const XMLElement& link, const std::filesystem::path& file, MeshBytes& bytes,
                 std::size_t& problems, Urdf& urdf) {
  const std::string name = attribute(link, "name");
  for (const XMLElement* shape = link.FirstChildElement("collision"); shape != nullptr;
       shape = shape->NextSiblingElement("collision")) {
    const XMLElement* const geometry = shape->FirstChildElement("geometry");
    if (geometry == nullptr) fail_at(*shape, "a collision has no geometry");
    const Pose pose = origin_of(*shape);
    try {
      urdf.shapes.push_back({name, volume_of(*geometry, pose, file, bytes)});
    } catch (const UnreadableShape& error) {
      warn(urdf.warnings, problems, "link " + name + ": " + error.what() + "; this shape is left out");
    }
  }
}

UrdfJoint joint_of(const XMLElement& element) {
  const XMLElement* const parent = element.FirstChildElement("parent");
  const XMLElement* const child = element.FirstChildElement("child");
  if (parent == nullptr || child == nullptr) fail_at(element, "a joint has no parent or no child");
  UrdfJoint joint{attribute(element, "name"), attribute(*parent, "link"), attribute(*child, "link"),
                  origin_of(element), attribute(element, "type") != "fixed"};
  if (joint.parent.empty() || joint.child.empty()) fail_at(element, "a joint has a link without a name");
  return joint;
}

}  // namespace

Urdf read_urdf(const std::filesystem::path& file, UrdfContent content) {
  try {
    const std::string text = read_untrusted_text(file, kMaxUrdfBytes);
    require_few_attributes(text);
    tinyxml2::XMLDocument document;  // limits the depth of elements
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
      throw IoError(std::string("not XML: ") + document.ErrorName() + " at line " +
                    std::to_string(document.ErrorLineNum()));
    const XMLElement* const robot = document.FirstChildElement("robot");
    if (robot == nullptr) throw IoError("not a URDF: it has no element <robot>");
    Urdf urdf;
    MeshBytes bytes;
    std::size_t problems = 0;
    for (const XMLElement* element = robot->FirstChildElement(); element != nullptr;
         element = element->NextSiblingElement()) {
      const std::string name = element->Name();
      if (name == "joint") urdf.joints.push_back(joint_of(*element));
      if (name == "link" && content == UrdfContent::joints_and_shapes)
        read_shapes(*element, file, bytes, problems, urdf);
    }
    return urdf;
  } catch (const IoError& error) {
    throw IoError(file.string() + ": " + error.what());
  }
}

void Urdf::add_joints(Transforms& to) const {
  for (const UrdfJoint& joint : joints)
    if (!joint.movable) to.add_fixed(joint.parent, joint.child, joint.pose, true);
}

std::vector<AnyVolume> Urdf::volumes_in(const std::string& frame, std::vector<std::string>& problems) const {
  Transforms all;
  for (const UrdfJoint& joint : joints)
    all.add_fixed(joint.parent, joint.child, joint.pose);
  const bool named =
      std::any_of(shapes.begin(), shapes.end(), [&](const UrdfShape& shape) { return shape.link == frame; });
  const bool joined = std::any_of(joints.begin(), joints.end(), [&](const UrdfJoint& joint) {
    return joint.parent == frame || joint.child == frame;
  });
  if (!named && !joined) throw IoError("the URDF has no link " + frame);
  std::size_t count = 0;
  for (const std::string& line : all.take_warnings())
    warn(problems, count, line);
  std::map<std::string, FoundTransform> found;  // by link: a link may have many shapes
  std::vector<AnyVolume> volumes;
  for (const UrdfShape& shape : shapes) {
    const auto [at, first] = found.try_emplace(shape.link);
    if (first) at->second = all.find(frame, shape.link, 0);
    if (!at->second.pose) {
      if (first) warn(problems, count, "link " + shape.link + " is left out: " + at->second.problem);
      continue;
    }
    const Eigen::Isometry3d pose(*at->second.pose);
    volumes.push_back(std::visit(
        [&](const auto& volume) -> AnyVolume {
          using V = std::decay_t<decltype(volume)>;
          if constexpr (std::is_same_v<V, Obb> || std::is_same_v<V, Sphere> || std::is_same_v<V, Cylinder> ||
                        std::is_same_v<V, Hull>)
            return volume.transformed(pose);
          return volume;
        },
        shape.volume));
  }
  for (const UrdfJoint& joint : joints)
    if (joint.movable)
      warn(problems, count,
           "joint " + joint.name + " moves: the links below it are placed as at its position 0");
  return volumes;
}

}  // namespace pcl_bv::detail
