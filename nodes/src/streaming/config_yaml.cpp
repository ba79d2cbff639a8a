// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// YAML to a configuration and back.

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "config_fields.h"
#include "pcl_bv/segmentation/up.h"

namespace pcl_bv {
namespace {

// Where a key stands in the file, from 1; 0: nowhere.
using Lines = std::map<std::string, int>;

[[noreturn]] void fail(const std::string& name, int line, const std::string& what) {
  throw ConfigError(name + (line > 0 ? ": line " + std::to_string(line) : "") + ": " + what);
}

class Reader {
 public:
  Reader(const YAML::Node& root, std::string name) : name_(std::move(name)) { collect(root, ""); }

  void number(const char* key, double& value, NumberRange, const char* unit) {
    if (const YAML::Node* node = take(key)) value = convert<double>(key, *node, "a number", unit);
  }
  void optional_number(const char* key, std::optional<double>& value, NumberRange, const char* unit) {
    const YAML::Node* node = take(key);
    if (node == nullptr) return;
    if (node->IsNull()) {
      value.reset();
    } else {
      value = convert<double>(key, *node, "a number or null", unit);
    }
  }
  void whole(const char* key, std::size_t& value, std::size_t, std::size_t most, const char* unit) {
    const YAML::Node* node = take(key);
    if (node == nullptr) return;
    const bool endless = most == kUnlimited && node->IsScalar() && node->Scalar() == "unlimited";
    value = endless ? kUnlimited : whole_number(key, *node, unit);
  }
  void optional_point(const char* key, std::optional<Eigen::Vector3d>& value, const char* unit) {
    const YAML::Node* node = take(key);
    if (node == nullptr) return;
    value.reset();
    if (node->IsNull()) return;
    const auto point = convert<std::vector<double>>(key, *node, "a list of three numbers or null", unit);
    if (point.size() != 3) fail(name_, line(*node), std::string(key) + ": has not three numbers");
    value = Eigen::Vector3d(point[0], point[1], point[2]);
  }
  void choice(const char* key, GroundMethod& value, const char*) { read(key, value, parse_ground_method); }
  void direction(const char* key, Eigen::Vector3d& up, const char*) { read(key, up, parse_up); }
  void choice(const char* key, QueuePolicy& value, const char*) { read(key, value, parse_queue_policy); }
  void flag(const char* key, bool& value) {
    if (const YAML::Node* node = take(key)) value = convert<bool>(key, *node, "true or false", "");
  }
  void methods(const char* key, std::vector<std::string>& value) {
    if (const YAML::Node* node = take(key))
      value = convert<std::vector<std::string>>(key, *node, "a list of methods", "");
  }
  void instruction_set(const char* key, std::string& value) {
    if (const YAML::Node* node = take(key)) value = convert<std::string>(key, *node, "a name", "");
  }

  // After all fields: what is left is unknown.
  void finish() const {
    for (const auto& [key, line_number] : maps_) {
      if (sections_.count(key) == 0)
        fail(name_, line_number, "unknown key '" + key + "', or one that holds no others");
    }
    for (const auto& [key, node] : nodes_) {
      if (node.IsNull() && sections_.count(key) > 0) continue;  // a stage of which nothing is said
      if (lines_.count(key) == 0) fail(name_, line(node), "unknown key '" + key + "'");
    }
  }

  void refuse(const std::vector<ConfigProblem>& problems) const {
    if (problems.empty()) return;
    const auto found = lines_.find(problems.front().key);
    fail(name_, found == lines_.end() ? 0 : found->second,
         problems.front().key + ": " + problems.front().what);
  }

 private:
  static int line(const YAML::Node& node) { return node.Mark().line + 1; }

  void collect(const YAML::Node& node, const std::string& prefix) {
    if (node.IsNull()) return;
    if (!node.IsMap()) fail(name_, line(node), "'" + prefix + "' holds no keys");
    for (const auto& item : node) {
      const std::string name = item.first.as<std::string>();
      std::string key = prefix;
      if (!prefix.empty()) key += '.';
      key += name;
      if (name.find('.') != std::string::npos) fail(name_, line(item.first), "unknown key '" + key + "'");
      if (prefix.empty() && item.second.IsMap()) {
        if (!maps_.emplace(key, line(item.first)).second)
          fail(name_, line(item.first), key + ": is there twice");
        collect(item.second, key);
      } else if (!nodes_.emplace(key, item.second).second) {
        fail(name_, line(item.first), key + ": is there twice");
      }
    }
  }

  // The key's node, marked as known.
  const YAML::Node* take(const char* key) {
    const std::string name = key;
    if (name.find('.') != std::string::npos) sections_.insert(name.substr(0, name.find('.')));
    const auto found = nodes_.find(name);
    if (found == nodes_.end()) return nullptr;
    lines_[name] = line(found->second);
    return &found->second;
  }

  template <typename T>
  T convert(const char* key, const YAML::Node& node, const std::string& wanted, const char* unit) {
    try {
      return node.as<T>();
    } catch (const YAML::Exception&) {
      const std::string text = node.IsScalar() ? "'" + node.Scalar() + "'" : "what is there";
      fail(name_, line(node),
           std::string(key) + ": " + text + " is not " + wanted +
               (*unit ? std::string(" (") + unit + ")" : ""));
    }
  }

  std::size_t whole_number(const char* key, const YAML::Node& node, const char* unit) {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && !text.empty()) return value;
    fail(name_, line(node), std::string(key) + ": '" + text + "' is not a whole number (" + unit + ")");
  }

  template <typename Choice>
  void read(const char* key, Choice& value, Choice (*parse)(std::string_view)) {
    const YAML::Node* node = take(key);
    if (node == nullptr) return;
    try {
      value = parse(convert<std::string>(key, *node, "a name", ""));
    } catch (const std::invalid_argument& error) {
      fail(name_, line(*node), std::string(key) + ": " + error.what());
    }
  }

  std::string name_;
  std::map<std::string, YAML::Node> nodes_;
  Lines lines_;
  std::set<std::string> sections_;
  Lines maps_;
};

class Writer {
 public:
  void number(const char* key, double value, NumberRange, const char* unit) { put(key, text(value), unit); }
  void optional_number(const char* key, const std::optional<double>& value, NumberRange, const char* unit) {
    put(key, value ? text(*value) : "null", unit);
  }
  void whole(const char* key, std::size_t value, std::size_t, std::size_t, const char* unit) {
    put(key, value == kUnlimited ? "unlimited" : std::to_string(value), unit);
  }
  void optional_point(const char* key, const std::optional<Eigen::Vector3d>& p, const char* unit) {
    put(key, p ? '[' + text(p->x()) + ", " + text(p->y()) + ", " + text(p->z()) + ']' : "null", unit);
  }
  void direction(const char* key, const Eigen::Vector3d& up, const char* known) {
    put(key, up_text(up), known);
  }
  template <typename Choice>
  void choice(const char* key, Choice value, const char* known) {
    put(key, std::string(name_of(value)), known);
  }
  void flag(const char* key, bool value) { put(key, value ? "true" : "false", ""); }
  void methods(const char* key, const std::vector<std::string>& names) {
    std::string list = "[";
    for (const std::string& name : names)
      list += (list.size() > 1 ? ", " : "") + name;
    put(key, list + ']', "");
  }
  void instruction_set(const char* key, const std::string& name) { put(key, name, ""); }

  const std::string& yaml() const { return yaml_; }

 private:
  static std::string text(double value) { return value == kNoLimit ? ".inf" : digits_of(value); }

  void put(const std::string& key, const std::string& value, const std::string& comment) {
    const std::size_t dot = key.find('.');
    const std::string section = dot == std::string::npos ? "" : key.substr(0, dot);
    if (section != section_ && !section.empty()) yaml_ += section + ":\n";
    section_ = section;
    yaml_ += (section.empty() ? "" : "  ") + key.substr(dot == std::string::npos ? 0 : dot + 1) + ": " +
             value + (comment.empty() ? "" : "  # " + comment) + '\n';
  }

  std::string section_, yaml_;
};

}  // namespace

StreamConfig parse_stream_config(const std::string& text, const std::string& name,
                                 const StreamConfig& defaults) {
  StreamConfig config = defaults;
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) fail(name, documents[1].Mark().line + 1, "a second document");
    Reader reader(documents.empty() ? YAML::Node() : documents.front(), name);
    visit_stream(config, reader);
    reader.finish();
    reader.refuse(problems_of(config));
  } catch (const YAML::Exception& error) {
    fail(name, error.mark.line + 1, error.msg);
  }
  return config;
}

StreamConfig read_stream_config(const std::filesystem::path& file, const StreamConfig& defaults) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) fail(file.string(), 0, "cannot be read");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) fail(file.string(), 0, "cannot be read");
  return parse_stream_config(text, file.string(), defaults);
}

std::string to_yaml(const StreamConfig& config) {
  Writer writer;
  visit_stream(config, writer);
  return writer.yaml();
}

}  // namespace pcl_bv
