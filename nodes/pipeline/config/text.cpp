// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>

#include "names.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/segmentation/up.h"
#include "rows.h"
#include "settings.h"

namespace pcl_bv::detail {
namespace {

constexpr Names<GroundMethod, 4> kGroundMethods{{{"none", GroundMethod::none},
                                                 {"plane", GroundMethod::plane},
                                                 {"zones", GroundMethod::zones},
                                                 {"slope", GroundMethod::slope}}};
constexpr Names<Oversized, 3> kOversized{
    {{"drop", Oversized::drop}, {"keep", Oversized::keep}, {"split", Oversized::split}}};
constexpr Names<Deskew, 3> kDeskew{{{"off", Deskew::off}, {"on", Deskew::on}, {"auto", Deskew::automatic}}};
constexpr Names<Refine, 4> kRefine{
    {{"auto", Refine::automatic}, {"off", Refine::off}, {"neck", Refine::neck}, {"tracks", Refine::tracks}}};
constexpr Names<SphereGrowth, 3> kGrowths{{{"sequential", SphereGrowth::sequential},
                                           {"stationary", SphereGrowth::stationary},
                                           {"deferred", SphereGrowth::deferred}}};
constexpr Names<QueuePolicy, 4> kPolicies{{{"auto", QueuePolicy::automatic},
                                           {"drop_oldest", QueuePolicy::drop_oldest},
                                           {"drop_newest", QueuePolicy::drop_newest},
                                           {"block", QueuePolicy::block}}};
constexpr Names<bool, 2> kFlags{{{"true", true}, {"false", false}}};

[[noreturn]] void reject(std::string_view text, const std::string& what) {
  throw std::invalid_argument("'" + std::string(text) + "' is not " + what);
}

template <typename Choice, std::size_t n>
std::string find_name(const Names<Choice, n>& names, Choice choice) {
  for (const auto& [name, value] : names) {
    if (value == choice) return std::string(name);
  }
  return {};
}

// Returns the parts between commas, without the spaces around the parts.
std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    std::string_view part = text.substr(begin, comma - begin);
    part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
    part.remove_suffix(part.size() - (part.find_last_not_of(' ') + 1));
    parts.push_back(part);
    begin = comma + 1;
  }
  return parts;
}

std::array<std::string_view, 3> three_parts_of(std::string_view text) {
  const std::vector<std::string_view> parts = parts_of(text);
  if (parts.size() != 3) reject(text, "three numbers");
  return {parts[0], parts[1], parts[2]};
}

// Returns the text of a field of a row, which is empty if the field is unset.
template <typename T>
std::string text_of_field(const T& value) {
  return to_text(value);
}
template <typename T>
std::string text_of_field(const std::optional<T>& value) {
  return value ? to_text(*value) : "";
}
std::string text_of_field(const std::filesystem::path& file) {
  return yaml_quoted(file.string());
}
std::string text_of_field(const std::string& text) {
  return text.empty() ? "" : yaml_quoted(text);
}
std::string text_of_field(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers)
    list += (list.empty() ? "[" : ", ") + (number == kNoLimit ? ".inf" : to_text(number));
  return list.empty() ? "" : list + ']';
}
std::string text_of_field(std::int64_t value) {
  return std::to_string(value);
}
std::string text_of_field(const std::vector<std::string>& names) {
  return names.empty() ? "" : '[' + to_text(names) + ']';
}

template <ConfigRow Row>
std::string text_of_rows(const std::vector<Row>& rows) {
  std::string list;
  for (const Row& row : rows) {
    std::string fields;
    visit_row(row, [&](const Setting& field, const auto& value) {
      const std::string text = text_of_field(value);
      if (text.empty()) return;
      fields.append(fields.empty() ? "" : ", ").append(field.key).append(": ").append(text);
    });
    list.append(list.empty() ? "{" : ", {").append(fields).append("}");
  }
  return list;
}

}  // namespace

std::string to_text(bool value) {
  return find_name(kFlags, value);
}
std::string to_text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}
std::string to_text(std::size_t value) {
  return value == std::numeric_limits<std::size_t>::max() ? "unlimited" : std::to_string(value);
}
std::string to_text(const Eigen::Vector3d& direction) {
  return format_up(direction);
}
std::string to_text(const std::string& name) {
  return name;
}
std::string yaml_quoted(const std::string& name) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "\"";
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < ' ') {
      text.append("\\x").append({digits[c / 16], digits[c % 16]});
    } else {
      text.append(c == '"' || c == '\\' ? "\\" : "").append(1, c);
    }
  }
  return text + '"';
}
std::string to_text(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  return list;
}
std::string to_text(const std::vector<RegionConfig>& regions) {
  return text_of_rows(regions);
}
std::string to_text(const std::vector<ClassConfig>& classes) {
  return text_of_rows(classes);
}
std::string to_text(const std::vector<RigSensor>& sensors) {
  return text_of_rows(sensors);
}
std::string to_text(GroundMethod method) {
  return find_name(kGroundMethods, method);
}
std::string to_text(const FieldName& field) {
  return yaml_quoted(field.name);
}
std::string to_text(const UprightSize& size) {
  std::string list;
  for (const double side : {size.along, size.across, size.up})
    list.append(list.empty() ? "" : ", ").append(side == kNoLimit ? "unlimited" : to_text(side));
  return list;
}
std::string to_text(Oversized rule) {
  return find_name(kOversized, rule);
}

std::string to_text(Refine refine) {
  return find_name(kRefine, refine);
}

std::string to_text(Deskew deskew) {
  return find_name(kDeskew, deskew);
}
std::string to_text(SphereGrowth growth) {
  return find_name(kGrowths, growth);
}
std::string to_text(QueuePolicy policy) {
  return find_name(kPolicies, policy);
}
std::string to_text(const std::optional<Eigen::Vector3d>& point) {
  if (!point) return "null";
  return to_text(point->x()) + ", " + to_text(point->y()) + ", " + to_text(point->z());
}

void read_text(std::string_view text, bool& value) {
  value = read_name(kFlags, text);
}
void read_text(std::string_view text, double& value) {
  if (!read_whole_text(text, value)) reject(text, "a number");
}
void read_text(std::string_view text, std::size_t& value) {
  if (text == "unlimited") {
    value = std::numeric_limits<std::size_t>::max();
  } else if (!read_whole_text(text, value)) {
    reject(text, "a whole number");
  }
}
void read_text(std::string_view text, Eigen::Vector3d& direction) {
  std::string dense(text);
  dense.erase(std::remove(dense.begin(), dense.end(), ' '), dense.end());
  direction = parse_up(dense);
}
void read_text(std::string_view text, std::string& name) {
  name = text;
}
void read_text(std::string_view text, std::vector<std::string>& names) {
  names.clear();
  for (const std::string_view name : parts_of(text)) {
    if (name == "all") {
      for (const Method* method : methods_of_all())
        names.emplace_back(method->name);
    } else {
      names.emplace_back(name);
    }
  }
}
void read_text(std::string_view text, std::vector<RegionConfig>& regions) {
  regions = {{std::filesystem::path(text)}};
}
void read_text(std::string_view text, std::vector<ClassConfig>& classes) {
  classes.assign(1, {});
  if (!read_whole_text(text, classes[0].value)) reject(text, "a whole number");
}
void read_text(std::string_view text, std::vector<RigSensor>& sensors) {
  sensors = {{std::string(text)}};
}
void read_text(std::string_view text, GroundMethod& method) {
  method = read_name(kGroundMethods, text);
}
void read_text(std::string_view text, FieldName& field) {
  field.name = text;
}
void read_text(std::string_view text, UprightSize& size) {
  const std::array<std::string_view, 3> parts = three_parts_of(text);
  double* const sides[] = {&size.along, &size.across, &size.up};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const bool unlimited = parts[k] == "unlimited" || parts[k] == ".inf";  // .inf: YAML's infinity
    *sides[k] = kNoLimit;
    if (!unlimited) read_text(parts[k], *sides[k]);
  }
}
void read_text(std::string_view text, Oversized& rule) {
  rule = read_name(kOversized, text);
}

void read_text(std::string_view text, Refine& refine) {
  refine = read_name(kRefine, text);
}

void read_text(std::string_view text, Deskew& deskew) {
  deskew = read_name(kDeskew, text);
}
void read_text(std::string_view text, SphereGrowth& growth) {
  growth = read_name(kGrowths, text);
}
void read_text(std::string_view text, QueuePolicy& policy) {
  policy = read_name(kPolicies, text);
}
void read_text(std::string_view text, std::optional<Eigen::Vector3d>& point) {
  point.reset();
  if (text == "null") return;
  const std::array<std::string_view, 3> parts = three_parts_of(text);
  Eigen::Vector3d p;
  for (Eigen::Index k = 0; k < 3; ++k)
    read_text(parts[static_cast<std::size_t>(k)], p[k]);
  point = p;
}

}  // namespace pcl_bv::detail
