// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "parameters.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pcl_bv/io/untrusted_text.h"
#include "pipeline/config/settings.h"
#include "stream/topics/message_adapter.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Numbers become text here, because yaml-cpp would follow the locale of the program, such as 1.000 for 1000.
YAML::Node yaml_of_number(double value) {
  return std::isfinite(value) ? YAML::Node(to_text(value)) : YAML::Node(value);
}

// Converts parameters to YAML. Whole numbers of ROS parameters have only 32 bits. Larger numbers must be in
// the file that the parameter `config` names.
YAML::Node yaml_of(XmlRpc::XmlRpcValue& value, int depth = 0) {
  constexpr int max_depth = 16;  // settings have at most 4 levels
  if (depth > max_depth) throw ConfigError("parameters have more than 16 levels");
  using Value = XmlRpc::XmlRpcValue;
  YAML::Node node;
  switch (value.getType()) {
    case Value::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case Value::TypeInt:
      return YAML::Node(std::to_string(static_cast<int>(value)));
    case Value::TypeDouble:
      return yaml_of_number(value);
    case Value::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case Value::TypeArray:
      node = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i)
        node.push_back(yaml_of(value[i], depth + 1));
      return node;
    case Value::TypeStruct:
      node = YAML::Node(YAML::NodeType::Map);
      for (auto& [key, inner] : value)
        node[key] = yaml_of(inner, depth + 1);
      return node;
    default:
      throw ConfigError(
          "a parameter has a type that is not supported (supported: number, text, bool, list, map)");
  }
}

// Returns the names of adapters, which a command line gives as a text with commas.
std::vector<std::string> adapters_in(const YAML::Node& list) {
  std::vector<std::string> names;
  if (list.IsScalar()) {
    std::istringstream text(list.Scalar());
    for (std::string name; std::getline(text, name, ',');)
      names.push_back(name);
  } else {
    try {
      names = list.as<std::vector<std::string>>();
    } catch (const YAML::Exception&) {
      throw std::invalid_argument("is not a list of names");
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const std::string& adapter : names)
    adapter_kind(adapter);
  return names;
}

// Calls work(), and adds to its errors the name of the node, and how to remove the parameter: a parameter
// with `key` stays on the parameter server when the node ends, and would be read again by the next one.
// Without a key, the error concerns all parameters.
template <typename Work>
void with_parameter(const std::string& node, const std::string& key, const Work& work) {
  const auto fail = [&](const std::string& what) {
    const std::string path = node + (key.empty() ? "" : '/' + key);
    throw ConfigError(message_line(node + ": " + what) +
                      "; parameters stay on the parameter server until 'rosparam delete " + printable(path) +
                      "'");
  };
  try {
    work();
  } catch (const ConfigError& error) {
    fail(error.what());
  } catch (const std::invalid_argument& error) {
    fail(key + ": " + error.what());
  }
}

// Adds the parameters, such as "preset: indoor, cluster/tolerance: 0.4", to `text`.
void list_parameters(const YAML::Node& tree, const std::string& path, std::string& text) {
  for (const auto& entry : tree) {
    const std::string name = path + entry.first.Scalar();
    if (entry.second.IsMap()) {
      list_parameters(entry.second, name + '/', text);
    } else {
      const std::string value = entry.second.IsScalar() ? entry.second.Scalar() : "a list";
      if (!value.empty()) text.append(text.empty() ? "" : ", ").append(name + ": " + value);
    }
  }
}

}  // namespace

NodeConfig config_of(const ros::NodeHandle& parameters) {
  const std::string& name = parameters.getNamespace();
  NodeConfig config;
  config.pipeline.threads = 0;
  XmlRpc::XmlRpcValue all;
  if (!parameters.getParam("", all) || all.getType() != XmlRpc::XmlRpcValue::TypeStruct) return config;
  YAML::Node tree;
  with_parameter(name, "", [&] { tree = yaml_of(all); });
  const auto take = [&](const char* key) {
    if (tree[key] && !tree[key].IsScalar()) throw std::invalid_argument("is not a text");
    std::string text = tree[key] ? tree[key].Scalar() : std::string();
    tree.remove(key);
    return text;
  };
  tree.remove("num_worker_threads");  // a parameter of a standalone nodelet's manager, not ours
  list_parameters(tree, "", config.parameters);
  config.parameters = printable(config.parameters);
  with_parameter(name, "preset", [&] {
    if (const std::string preset = take("preset"); !preset.empty()) apply_preset(preset, config.pipeline);
  });
  with_parameter(name, "config", [&] {
    if (const std::string file = take("config"); !file.empty())
      static_cast<StreamConfig&>(config) = read_stream_config(file, config);
  });
  if (tree["volumes"] && tree["volumes"].IsScalar()) {  // on a command line: _volumes:=aabb,sphere
    std::vector<std::string> methods;
    read_text(tree["volumes"].Scalar(), methods);
    tree["volumes"] = methods;
  }
  with_parameter(name, "publish", [&] {
    if (tree["publish"]) config.publish = adapters_in(tree["publish"]);
  });
  tree.remove("publish");
  with_parameter(name, "", [&] {
    if (tree.size() > 0)
      static_cast<StreamConfig&>(config) = parse_stream_config(YAML::Dump(tree), "", config);
  });
  return config;
}

}  // namespace pcl_bv
