// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts dicts to YAML, so that the parser of configuration files also checks dicts.

#include "config_dict.h"

#include <cstdio>

#include "arguments.h"
#include "pipeline/config/settings.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

constexpr const char* kConfigName = "Pipeline";

std::string quoted(const std::string& text) {
  std::string yaml = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') yaml += '\\';
    if (static_cast<unsigned char>(c) < ' ') {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      yaml += code;
    } else {
      yaml += c;
    }
  }
  return yaml + '"';
}

constexpr int max_depth = 16;                // settings nest 4 deep, but a list may contain itself
constexpr std::size_t max_values = 100'000;  // a list may contain another list many times

/// Counters of yaml_of(), for the limits above.
struct YamlCounters {
  int depth = 0;
  std::size_t values = 0;
};

std::string yaml_of(py::handle value, const std::string& key, YamlCounters& counters);

template <typename Sequence>
std::string yaml_list(const Sequence& list, const std::string& key, YamlCounters& counters) {
  std::string yaml;
  for (const py::handle element : list)
    yaml.append(yaml.empty() ? "" : ", ").append(yaml_of(element, key, counters));
  return '[' + yaml + ']';
}

std::string yaml_map(const py::dict& map, const std::string& prefix, YamlCounters& counters) {
  std::string yaml;
  for (const auto& [name, value] : map) {
    if (!PyUnicode_Check(name.ptr())) raise_type_error(kConfigName, "a text as key", name);
    const auto key = name.cast<std::string>();
    yaml.append(yaml.empty() ? "" : ", ").append(quoted(key)).append(": ");
    const std::string path = prefix.empty() ? key : std::string(prefix).append(".").append(key);
    yaml += yaml_of(value, path, counters);
  }
  return '{' + yaml + '}';
}

std::string yaml_of_any(py::handle value, const std::string& key, YamlCounters& counters) {
  if (value.is_none()) return "null";
  if (PyBool_Check(value.ptr())) return value.ptr() == Py_True ? "true" : "false";
  if (PyUnicode_Check(value.ptr())) return quoted(value.cast<std::string>());
  if (PyLong_Check(value.ptr())) return py::str(value).cast<std::string>();
  if (PyFloat_Check(value.ptr())) {
    const std::string text = to_text(value.cast<double>());
    return text == "inf" || text == "-inf" ? (text[0] == '-' ? "-.inf" : ".inf")
           : text == "nan"                 ? ".nan"
                                           : text;
  }
  if (py::isinstance<py::dict>(value))
    return yaml_map(py::reinterpret_borrow<py::dict>(value), key, counters);
  if (py::isinstance<py::list>(value))
    return yaml_list(py::reinterpret_borrow<py::list>(value), key, counters);
  if (py::isinstance<py::tuple>(value))
    return yaml_list(py::reinterpret_borrow<py::tuple>(value), key, counters);
  if (py::hasattr(value, "tolist"))
    return yaml_of(value.attr("tolist")(), key, counters);  // numpy arrays and scalars
  if (py::hasattr(value, "__fspath__")) return quoted(path(value, key.c_str()).string());
  raise_type_error(key.c_str(), "a number, a text, a list or a dict", value);
}

std::string yaml_of(py::handle value, const std::string& key, YamlCounters& counters) {
  if (++counters.depth > max_depth)
    raise_value_error(key.c_str(), "nested more than " + std::to_string(max_depth) + " deep");
  if (++counters.values > max_values)
    raise_value_error(key.c_str(), "more than " + std::to_string(max_values) + " values");
  std::string yaml = yaml_of_any(value, key, counters);
  --counters.depth;
  return yaml;
}

/// Regions that are given by volumes, which YAML cannot express. The constructor replaces the volumes in the
/// settings by a file name. put_into() adds the volumes to the parsed configuration.
class RegionVolumes {
 public:
  explicit RegionVolumes(const py::dict& settings) : settings_(settings) {
    if (!settings.contains("filter") || !py::isinstance<py::dict>(settings["filter"])) return;
    py::dict filter = settings["filter"].attr("copy")();
    if (!filter.contains("regions") || !py::isinstance<py::list>(filter["regions"])) return;
    py::list regions;
    for (const py::handle each : py::list(filter["regions"])) {
      volumes_.emplace_back();
      if (py::isinstance<py::dict>(each) && each.contains("volumes")) {
        py::dict region = each.attr("copy")();
        for (const LabelledVolume& one : volumes_of(region.attr("pop")("volumes"), "filter.regions: volumes"))
          volumes_.back().push_back(one.volume->value);
        if (volumes_.back().empty())
          raise_value_error("filter.regions", "a region must have at least one volume");
        region["file"] = "volumes";
        regions.append(region);
      } else {
        regions.append(each);
      }
    }
    filter["regions"] = regions;
    settings_ = settings.attr("copy")();
    settings_["filter"] = filter;
  }

  const py::dict& settings() const { return settings_; }

  void put_into(std::vector<RegionConfig>& regions) {
    for (std::size_t i = 0; i < volumes_.size(); ++i) {
      if (volumes_[i].empty()) continue;
      regions[i].file.clear();
      regions[i].volumes = std::move(volumes_[i]);
    }
  }

 private:
  py::dict settings_;
  std::vector<std::vector<AnyVolume>> volumes_;  // volumes of each region; empty if the region has a file
};

/// Parses a dict. Errors have no line number, because a dict has no lines.
StreamConfig read_dict(const py::dict& settings, const StreamConfig& defaults) {
  RegionVolumes regions(settings);
  YamlCounters counters;
  StreamConfig config = parse_stream_config(yaml_map(regions.settings(), "", counters), "", defaults);
  regions.put_into(config.pipeline.filter.regions);
  return config;
}

StreamConfig read_config(py::handle config, const StreamConfig& defaults) {
  if (config.is_none()) return defaults;
  if (py::isinstance<py::dict>(config)) return read_dict(py::reinterpret_borrow<py::dict>(config), defaults);
  if (PyUnicode_Check(config.ptr())) {
    const auto text = config.cast<std::string>();
    if (text.find_first_of("\n:{") != std::string::npos)
      return parse_stream_config(text, kConfigName, defaults);
  } else if (!py::hasattr(config, "__fspath__")) {
    raise_type_error("config", "a dict, YAML or a path", config);
  }
  return read_stream_config(path(config, "config"), defaults);
}

// Converts a setting's value to a Python object that read_dict() accepts.
py::object python_value(bool value) {
  return py::bool_(value);
}
py::object python_value(double value) {
  return py::float_(value);
}
py::object python_value(std::size_t value) {
  if (value == std::numeric_limits<std::size_t>::max()) return py::str("unlimited");
  return py::int_(value);
}
py::object python_value(const std::string& name) {
  return py::str(name);
}
py::object python_value(const FieldName& field) {
  return py::str(field.name);
}
py::object python_value(const UprightSize& size) {
  return py::list(py::make_tuple(size.along, size.across, size.up));
}
py::object python_value(const Eigen::Vector3d& v) {
  return py::str(to_text(v));
}
py::object python_value(const std::vector<std::string>& names) {
  py::list list;
  for (const std::string& name : names)
    list.append(name);
  return list;
}
template <typename T>
py::object python_value(const std::optional<T>& value) {
  if (!value) return py::none();
  if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return py::list(py::make_tuple(value->x(), value->y(), value->z()));
  } else {
    return python_value(*value);
  }
}
py::object python_value(const std::vector<RegionConfig>& regions) {
  py::list list;
  for (const RegionConfig& region : regions) {
    py::dict entry;
    if (region.volumes.empty()) {
      entry["file"] = region.file.string();
    } else {
      py::list volumes;
      for (const AnyVolume& volume : region.volumes)
        volumes.append(to_python(AnyVolume(volume)));
      entry["volumes"] = volumes;
    }
    entry["keep"] = region.keep;
    entry["padding"] = region.padding;
    list.append(entry);
  }
  return list;
}
py::object python_value(const std::vector<ClassConfig>& classes) {
  py::list list;
  for (const ClassConfig& own : classes) {
    py::dict entry;
    const auto add = [&](const char* key, const auto& value) {
      if (value) entry[key] = python_value(*value);
    };
    entry["value"] = own.value;
    entry["drop"] = own.drop;
    add("tolerance", own.tolerance);
    add("min_size", own.min_size);
    add("max_size", own.max_size);
    if (!own.volumes.empty()) entry["volumes"] = python_value(own.volumes);
    if (!own.name.empty()) entry["name"] = own.name;
    list.append(entry);
  }
  return list;
}
template <typename Choice>
std::enable_if_t<std::is_enum_v<Choice>, py::object> python_value(Choice choice) {
  return py::str(to_text(choice));
}

template <typename T>
std::string range_text(const Setting& setting, const T& /*value*/) {
  constexpr bool real = std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>;
  if constexpr (real || std::is_same_v<T, std::size_t> || std::is_same_v<T, std::optional<std::size_t>>) {
    const NumberRange& range = setting.range;
    return (range.closed ? ", >= " : ", > ") + to_text(range.min) +
           (range.max < kFinite ? ", <= " + to_text(range.max) : "");
  }
  return "";
}

}  // namespace

PipelineConfig config_of(py::handle config, py::handle preset, const py::dict& settings,
                         const PipelineConfig& defaults) {
  StreamConfig stream;
  stream.pipeline = defaults;
  if (!preset.is_none()) {
    try {
      apply_preset(text(preset, "preset"), stream.pipeline);
    } catch (const std::invalid_argument& error) {
      raise_value_error("preset", error.what());
    }
  }
  return read_dict(settings, read_config(config, stream)).pipeline;
}

py::dict dict_of(const PipelineConfig& config) {
  py::dict all;
  visit_pipeline(config, [&](const Setting& setting, const auto& value) {
    const std::size_t dot = setting.key.find('.');
    const std::string key(setting.key.substr(dot == std::string_view::npos ? 0 : dot + 1));
    if (dot == std::string_view::npos) {
      all[py::str(key)] = python_value(value);
      return;
    }
    const py::str stage(std::string(setting.key.substr(0, dot)));
    if (!all.contains(stage)) all[stage] = py::dict();
    all[stage][py::str(key)] = python_value(value);
  });
  return all;
}

std::string settings_text() {
  std::string text;
  const PipelineConfig defaults;
  visit_pipeline(defaults, [&](const Setting& setting, const auto& value) {
    std::string default_text = to_text(value);
    if (default_text == "null" || default_text.empty())
      default_text = setting.unset.empty() ? "none" : std::string(setting.unset);
    text.append("    ").append(setting.key).append(" = ").append(default_text);
    if (!setting.unit.empty()) text.append(" [").append(setting.unit).append("]");
    text.append(range_text(setting, value)).append("\n        ").append(setting.help).append("\n");
  });
  return text;
}

}  // namespace pcl_bv::python
