// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "read_box_labels.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <set>

#include "json_numbers.h"

namespace pcl_bv::detail {
namespace {

using LabelJson = UntrustedJson;

Obb box_from(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& size) {
  if (!size.allFinite() || size.minCoeff() < 0) refuse("the size has a number that is not 0 or more");
  return {center, axes, size / 2};
}

Eigen::Matrix3d axes_of_quaternion(double w, double x, double y, double z) {
  const Eigen::Quaterniond q(w, x, y, z);
  // Files with few decimals have quaternions whose length is 1 only to these decimals.
  if (!(std::abs(q.norm() - 1) < 0.01)) refuse("the rotation is no quaternion of length 1");
  return q.normalized().toRotationMatrix();
}

Eigen::Matrix3d turn(const Eigen::Vector3d& axis, double angle) {
  if (!std::isfinite(angle)) refuse("an angle is not finite");
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Eigen::Vector3d xyz_of(const char* key, const LabelJson& psr) {
  const LabelJson& value = member(psr, key);
  const auto at = [&](const char* axis) { return number_of(key, member(value, axis)); };
  return {at("x"), at("y"), at("z")};
}

Obb sustech_box(const LabelJson& label) {
  const LabelJson& psr = member(label, "psr");
  const Eigen::Vector3d angles = xyz_of("rotation", psr);
  const Eigen::Matrix3d axes = turn(Eigen::Vector3d::UnitX(), angles.x()) *
                               turn(Eigen::Vector3d::UnitY(), angles.y()) *
                               turn(Eigen::Vector3d::UnitZ(), angles.z());
  return box_from(xyz_of("position", psr), axes, xyz_of("scale", psr));
}

Obb nuscenes_box(const LabelJson& label) {
  const LabelJson& rotation = member(label, "rotation");
  if (!rotation.is_array() || rotation.size() != 4) refuse("rotation", "four numbers are wanted", rotation);
  const auto q = [&](std::size_t i) { return number_of("rotation", rotation[i]); };
  const Eigen::Vector3d size = vector_of("size", member(label, "size"));  // width, length, height
  return box_from(vector_of("translation", member(label, "translation")),
                  axes_of_quaternion(q(0), q(1), q(2), q(3)), {size.y(), size.x(), size.z()});
}

Obb openlabel_box(const LabelJson& cuboid) {
  const LabelJson& val = member(cuboid, "val");
  if (!val.is_array() || (val.size() != 9 && val.size() != 10))
    refuse("val", "9 or 10 numbers are wanted", val);
  const auto at = [&](std::size_t i) { return number_of("val", val[i]); };
  const std::size_t n = val.size();
  const Eigen::Matrix3d axes = n == 10 ? axes_of_quaternion(at(6), at(3), at(4), at(5))
                                       : Eigen::Matrix3d(turn(Eigen::Vector3d::UnitZ(), at(5)) *
                                                         turn(Eigen::Vector3d::UnitY(), at(4)) *
                                                         turn(Eigen::Vector3d::UnitX(), at(3)));
  return box_from({at(0), at(1), at(2)}, axes, {at(n - 3), at(n - 2), at(n - 1)});
}

// Returns whether a type marks a region without a box, which KITTI calls DontCare.
bool is_dont_care_type(std::string_view type) {
  std::string letters;
  for (const char c : type.substr(0, 40)) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper || (c >= 'a' && c <= 'z')) letters += static_cast<char>(upper ? c - 'A' + 'a' : c);
  }
  return letters == "dontcare";
}

// Converters of KITTI's labels keep these regions, with sizes of -1 or -1000.
bool is_dont_care(const LabelJson& label) {
  if (!label.is_object()) return false;
  for (const char* key : {"type", "obj_type", "detection_name", "tracking_name", "category_name"}) {
    const auto type = label.find(key);
    if (type != label.end() && type->is_string() && is_dont_care_type(type->get_ref<const std::string&>()))
      return true;
  }
  return false;
}

// Appends the box of each entry of a list. An error begins with the path of its entry.
void append_boxes(const LabelJson& list, const std::string& path, Obb (*read)(const LabelJson&),
                  std::vector<AnyVolume>& volumes) {
  list_of(path.c_str(), list);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (is_dont_care(list[i])) continue;
    try {
      volumes.emplace_back(read(list[i]));
    } catch (const std::invalid_argument& error) {
      refuse(path + '[' + std::to_string(i) + "]: " + error.what());
    }
  }
}

// Reads the boxes of all members "cuboid" at any depth: those of objects and of frames.
class OpenLabelBoxes {
 public:
  OpenLabelBoxes(const LabelJson& root, std::vector<AnyVolume>& volumes) : volumes_(volumes) {
    const auto objects = root.find("objects");
    if (objects == root.end() || !objects->is_object()) return;
    for (const auto& [id, object] : objects->items())
      if (is_dont_care(object)) dont_care_.insert(id);
  }

  // `system` is the coordinate system of the object that contains this value; empty if it names none.
  void append(const LabelJson& json, const std::string& path, std::string_view system = {},
              bool objects = false) {
    if (!json.is_structured()) return;
    std::size_t i = 0;
    for (const auto& [key, value] : json.items()) {
      ++i;
      if (!value.is_structured()) continue;
      if (objects && (dont_care_.count(key) > 0 || is_dont_care(value))) continue;
      std::string inner = path;
      inner += json.is_object() ? '.' + key.substr(0, kMaxNameBytes) : '[' + std::to_string(i - 1) + ']';
      if (json.is_object() && key == "cuboid") {
        require_one_system(value, inner, system);
        append_boxes(value, inner, openlabel_box, volumes_);
      } else {
        append(value, inner, system_of(value, system), json.is_object() && key == "objects");
      }
    }
  }

 private:
  static std::string_view system_of(const LabelJson& json, std::string_view otherwise) {
    const auto found = json.is_object() ? json.find("coordinate_system") : json.end();
    return found == json.end() || !found->is_string() ? otherwise : found->get_ref<const std::string&>();
  }

  // Boxes of several coordinate systems cannot all be in the frame of the cloud.
  void require_one_system(const LabelJson& cuboids, const std::string& path, std::string_view otherwise) {
    if (!cuboids.is_array()) return;
    for (const LabelJson& cuboid : cuboids) {
      const std::string_view name = system_of(cuboid, otherwise);
      if (name.empty() || is_dont_care(cuboid)) continue;
      if (system_.empty()) system_ = name;
      if (name != system_)
        refuse(path + ": the coordinate_system is " + in_quotes(name) + ", that of boxes before is " +
               in_quotes(system_));
    }
  }

  std::vector<AnyVolume>& volumes_;
  std::set<std::string, std::less<>> dont_care_;  // keys of objects
  std::string system_;
};

bool has_entry_with(const LabelJson& list, const char* key) {
  return list.is_array() &&
         std::any_of(list.begin(), list.end(), [&](const LabelJson& entry) { return entry.contains(key); });
}

bool read_label_list(const LabelJson& list, const std::string& path, std::vector<AnyVolume>& volumes) {
  const bool sustech = has_entry_with(list, "psr");
  if (!sustech && !has_entry_with(list, "translation")) return false;
  append_boxes(list, path, sustech ? sustech_box : nuscenes_box, volumes);
  return true;
}

struct KittiLine {
  std::vector<std::string_view> words;
  bool tracking = false;
};

bool number_in(std::string_view word, double& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

KittiLine split_kitti(std::string_view line) {
  KittiLine found;
  constexpr const char* blanks = " \t\r";
  for (std::size_t at = line.find_first_not_of(blanks);
       at != std::string_view::npos && found.words.size() < 20;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    found.words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  double first = 0;
  found.tracking = !found.words.empty() && number_in(found.words.front(), first);
  return found;
}

// Words in front of the columns that both formats have, from the type on.
std::size_t first_column(const KittiLine& line) {
  return line.tracking ? 2 : 0;
}

// 15 columns, and 16 with a score.
bool has_kitti_columns(const KittiLine& line) {
  const std::size_t columns = line.words.size() - std::min(line.words.size(), first_column(line));
  return columns == 15 || columns == 16;
}

Obb kitti_box(const KittiLine& line) {
  if (!has_kitti_columns(line)) refuse("15 or 16 columns are wanted, in labels of tracking 17 or 18");
  double value[14];
  for (std::size_t i = 0; i < 14; ++i) {
    const std::string_view word = line.words[first_column(line) + 1 + i];
    if (!number_in(word, value[i]))
      refuse("a number is wanted, not \"" + std::string(word.substr(0, 40)) + '"');
  }
  const double height = value[7], width = value[8], length = value[9], rotation = value[13];
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() << -std::sin(rotation), std::cos(rotation), -std::cos(rotation),
      -std::sin(rotation);
  return box_from({value[12], -value[10], height / 2 - value[11]}, axes, {length, width, height});
}

}  // namespace

bool read_box_labels(const UntrustedJson& json, std::vector<AnyVolume>& volumes) {
  if (json.is_array()) return read_label_list(json, "", volumes);
  if (!json.is_object()) return false;
  if (const auto root = json.find("openlabel"); root != json.end()) {
    OpenLabelBoxes(*root, volumes).append(*root, "openlabel");
    return true;
  }
  if (const auto objects = json.find("objs"); objects != json.end())
    return read_label_list(*objects, "objs", volumes);
  const auto results = json.find("results");
  if (results == json.end() || !results->is_object()) return false;
  if (std::none_of(results->begin(), results->end(),
                   [](const LabelJson& boxes) { return has_entry_with(boxes, "translation"); }))
    return false;
  for (const auto& [sample, boxes] : results->items())
    append_boxes(boxes, "results." + sample, nuscenes_box, volumes);
  return true;
}

bool has_kitti_labels(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || text[begin] == '{' || text[begin] == '[') return false;
  const std::size_t longest = 4096;  // bytes of a line; a file of JSON may be one long line
  return has_kitti_columns(
      split_kitti(text.substr(begin, std::min(text.find('\n', begin) - begin, longest))));
}

std::vector<AnyVolume> read_kitti_labels(std::string_view text) {
  std::vector<AnyVolume> volumes;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const KittiLine line = split_kitti(text.substr(at, end - at));
    at = end + 1;
    ++number;
    if (line.words.empty()) continue;
    const std::size_t type = first_column(line);
    if (type < line.words.size() && is_dont_care_type(line.words[type])) continue;
    try {
      volumes.emplace_back(kitti_box(line));
    } catch (const std::invalid_argument& error) {
      throw IoError("line " + std::to_string(number) + ": " + error.what());
    }
  }
  return volumes;
}

}  // namespace pcl_bv::detail
