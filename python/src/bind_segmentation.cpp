// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bind.h"
#include "clusters_object.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/segmentation/class_clusters.h"
#include "pcl_bv/segmentation/cloud_statistics.h"
#include "pcl_bv/segmentation/ground.h"
#include "segmentation_docs.h"
#include "state.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

std::size_t size_or_unlimited(py::handle value, const char* name) {
  return value.is_none() ? std::numeric_limits<std::size_t>::max()
                         : whole_number(value, name, range_of("cluster.max_size"));
}

/// Returns the settings of one class. Settings that are not in the dict are taken from `others`.
ClassOptions class_settings(std::int64_t value, py::handle settings_dict, const ClusterOptions& others) {
  ClassOptions own{value, others};
  if (!py::isinstance<py::dict>(settings_dict))
    raise_type_error("class_settings", "a dict of settings for each class", settings_dict);
  for (const auto& [key, of] : py::reinterpret_borrow<py::dict>(settings_dict)) {
    const std::string name = text(key, "class_settings");
    if (name == "drop") {
      if (!PyBool_Check(of.ptr())) raise_type_error("class_settings: drop", "True or False", of);
      own.drop = of.ptr() == Py_True;
    } else if (name == "tolerance") {
      own.clusters.tolerance =
          static_cast<float>(number(of, "class_settings: tolerance", {0, 1e6, false, true}));
    } else if (name == "min_size") {
      own.clusters.min_size = whole_number(of, "class_settings: min_size", range_of("cluster.min_size"));
    } else if (name == "max_size") {
      own.clusters.max_size = size_or_unlimited(of, "class_settings: max_size");
    } else {
      raise_value_error("class_settings", "'" + name + "' is not one of drop, tolerance, min_size, max_size");
    }
  }
  return own;
}

std::vector<ClassOptions> all_class_settings(py::handle settings_dict, const ClusterOptions& others) {
  std::vector<ClassOptions> own;
  if (settings_dict.is_none()) return own;
  if (!py::isinstance<py::dict>(settings_dict))
    raise_type_error("class_settings", "a dict of settings for each class", settings_dict);
  for (const auto& [value, of] : py::reinterpret_borrow<py::dict>(settings_dict)) {
    own.push_back(class_settings(signed_number(value, "class_settings"), of, others));
  }
  return own;
}

ClustersObject find_clusters(py::handle points, py::handle tolerance, py::handle min_size,
                             py::handle max_size, py::handle min_points, py::handle tolerance_per_metre,
                             py::handle oversized, py::handle classes, py::handle own_settings,
                             py::handle threads) {
  const PointArray array = points_of(points);
  ClusterOptions settings{static_cast<float>(number(tolerance, "tolerance", {0, 1e6, false, true}))};
  settings.min_size = whole_number(min_size, "min_size", range_of("cluster.min_size"));
  settings.max_size = size_or_unlimited(max_size, "max_size");
  settings.min_points = whole_number(min_points, "min_points", range_of("cluster.min_points"));
  settings.tolerance_per_metre = static_cast<float>(
      number(tolerance_per_metre, "tolerance_per_metre", range_of("cluster.tolerance_per_metre")));
  settings.oversized = parse_text<Oversized>(oversized, "oversized");
  const std::vector<ClassOptions> own = all_class_settings(own_settings, settings);
  if (classes.is_none() && !own.empty()) raise_value_error("class_settings", "needs the argument classes");
  const Execution execution(policy_of(threads), Isa::scalar);  // no kernel is used
  std::vector<std::int64_t> of_points;
  if (!classes.is_none()) of_points = integers(classes, "classes", array.view.count);
  ClustersObject clusters;
  clusters.points = array.view.count;
  const py::gil_scoped_release unlocked;
  if (classes.is_none()) {
    EuclideanClusterer().extract(array.view, settings, clusters.found, execution);
  } else {
    ClassClusterer().extract(array.view, of_points, settings, own, clusters.found, clusters.class_of,
                             execution);
  }
  clusters.label_points();
  return clusters;
}

/// Issues the warnings that FrameWarnings gives for a frame with this ground and no other results. Where such
/// a warning names a setting, for example "ground.method", it then names ground()'s argument "method".
void warn_of_ground(const PointView& points, const GroundConfig& config, const GroundObject& found) {
  PipelineConfig pipeline = whole_cloud_config();
  pipeline.ground = config;
  Frame frame;
  frame.points = points;
  FrameResult result;
  result.config = std::make_shared<PipelineConfig>(std::move(pipeline));
  result.points = points.count;
  result.counts.ground = found.split.ground.size();
  result.counts.nonfinite = points.count - result.counts.ground - found.split.rest.size();
  result.sensor = found.split.sensor;
  result.ground.assumed_level = found.split.assumed_level;
  std::vector<std::string> texts;
  {
    const py::gil_scoped_release unlocked;
    const auto argument = [](std::string_view key) { return std::string(key.substr(key.find('.') + 1)); };
    texts = FrameWarnings(argument).take(frame, result);
  }
  for (const std::string& text : texts)
    warn(text);
}

template <typename Options>
Options ground_options(const GroundConfig& config) {
  Options options;
  options.up = config.up;
  if constexpr (requires { options.sensor_height; }) options.sensor_height = config.sensor_height;
  if constexpr (requires { options.cell_size; })
    options.cell_size = config.cell_size.value_or(options.cell_size);
  options.distance = config.distance.value_or(options.distance);
  options.max_slope_degrees = config.max_slope_degrees.value_or(options.max_slope_degrees);
  return options;
}

GroundConfig ground_config(py::handle method, py::handle up, py::handle sensor, py::handle sensor_height,
                           py::handle distance, py::handle max_slope_degrees, py::handle cell_size) {
  GroundConfig config;
  config.method = parse_text<GroundMethod>(method, "method");
  if (config.method == GroundMethod::none)
    raise_value_error("method", "'none' is not one of plane, zones, slope");
  config.up = up_argument(up);
  const auto set = [](py::handle value, const char* name, std::optional<double>& setting) {
    if (!value.is_none()) setting = number(value, name, range_of("ground." + std::string(name)));
  };
  set(sensor_height, "sensor_height", config.sensor_height);
  set(distance, "distance", config.distance);
  set(max_slope_degrees, "max_slope_degrees", config.max_slope_degrees);
  set(cell_size, "cell_size", config.cell_size);
  if (!sensor.is_none() && config.method != GroundMethod::zones)
    raise_value_error("sensor", "is only allowed with method 'zones'");
  if (config.sensor_height && config.method == GroundMethod::slope)
    raise_value_error("sensor_height", "is not allowed with method 'slope'");
  if (config.cell_size && config.method != GroundMethod::slope)
    raise_value_error("cell_size", "is only allowed with method 'slope'");
  if (!sensor.is_none()) config.sensor = vector3(sensor, "sensor");
  return config;
}

GroundObject find_ground(py::handle points, py::handle method, py::handle up, py::handle sensor,
                         py::handle sensor_height, py::handle distance, py::handle max_slope_degrees,
                         py::handle cell_size, py::handle threads) {
  const PointArray array = points_of(points);
  const GroundConfig config =
      ground_config(method, up, sensor, sensor_height, distance, max_slope_degrees, cell_size);
  const Execution execution(policy_of(threads), Isa::scalar);  // no kernel is used
  GroundObject found;
  found.points = array.view.count;
  {
    const py::gil_scoped_release unlocked;
    if (config.method == GroundMethod::plane) {
      split_ground(array.view, ground_options<GroundPlaneOptions>(config), found.split);
    } else if (config.method == GroundMethod::slope) {
      split_ground_by_slope(array.view, ground_options<GroundSlopeOptions>(config), found.split, execution);
    } else {
      auto options = ground_options<GroundZonesOptions>(config);
      options.sensor = config.sensor;
      GroundZones().split(array.view, options, found.split, execution);
    }
    if (config.sensor) {
      found.split.sensor = find_sensor(array.view, config.up, *config.sensor, found.split.scratch);
      found.split.sensor.position = *config.sensor;
    }
  }
  warn_of_ground(array.view, config, found);
  found.split.scratch = {};
  return found;
}

py::object mask_of(const GroundObject& found) {
  std::vector<std::uint8_t> mask(found.points);
  for (const std::int32_t i : found.split.ground)
    mask[static_cast<std::size_t>(i)] = 1;
  return array_from_vector(std::move(mask)).attr("view")("bool");
}

py::dict statistics_of(py::handle points, py::handle threads) {
  const PointArray array = points_of(points);
  const Execution execution(policy_of(threads), Isa::scalar);  // no kernel is used
  CloudStatistics found;
  {
    const py::gil_scoped_release unlocked;
    found = cloud_statistics(array.view, execution);
  }
  py::dict statistics("box"_a = to_python(found.box), "nonfinite"_a = found.nonfinite, "zero"_a = found.zero);
  statistics["spacing"] = found.spacing ? py::object(py::float_(*found.spacing)) : py::none();
  return statistics;
}

py::object cluster_at(const py::object& self, py::handle index) {
  if (PyIndex_Check(index.ptr()) == 0) raise_type_error("index", "a whole number", index);
  const Py_ssize_t i = PyNumber_AsSsize_t(index.ptr(), nullptr);  // clamped to the range of Py_ssize_t
  if (i == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  const auto& found = self.cast<const ClustersObject&>().found;
  const auto size = static_cast<std::int64_t>(found.size());
  if (i < -size || i >= size)
    throw py::index_error("cluster " + repr_text(index) + " of " + std::to_string(size));
  const auto at = static_cast<std::size_t>(i < 0 ? i + size : i);
  return view_of_part(found.list(at), found.list_size(at), self);
}

py::tuple state_of(const ClustersObject& c) {
  const Clusters& f = c.found;
  const py::tuple counts = py::make_tuple(f.small_points, f.large_points, f.noise_points, f.class_points);
  return py::make_tuple(
      c.points, py::array_t<std::int32_t>(static_cast<py::ssize_t>(f.indices.size()), f.indices.data()),
      py::array_t<std::uint64_t>(static_cast<py::ssize_t>(f.offsets.size()), f.offsets.data()), counts,
      py::array_t<std::int64_t>(static_cast<py::ssize_t>(c.class_of.size()), c.class_of.data()));
}

template <typename T>
std::vector<T> list_of(const py::handle& array) {
  const auto values = py::array_t<T, py::array::c_style>(py::reinterpret_borrow<py::object>(array));
  return {values.data(), values.data() + values.size()};
}

ClustersObject from_state(py::handle given) {
  const py::tuple state = tuple_of_state(given, 5);
  ClustersObject c;
  c.points = points_of_state(state[0]);
  c.found.indices = list_of<std::int32_t>(state[1]);
  c.found.offsets = list_of<std::size_t>(state[2]);
  const py::tuple counts = tuple_of_state(state[3], 4);
  c.found.small_points = counts[0].cast<std::size_t>();
  c.found.large_points = counts[1].cast<std::size_t>();
  c.found.noise_points = counts[2].cast<std::size_t>();
  c.found.class_points = counts[3].cast<std::size_t>();
  c.class_of = list_of<std::int64_t>(state[4]);
  const auto in_cloud = [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < c.points; };
  if (c.found.offsets.empty() || c.found.offsets.front() != 0 ||
      c.found.offsets.back() != c.found.indices.size() ||
      !std::is_sorted(c.found.offsets.begin(), c.found.offsets.end()) ||
      !std::all_of(c.found.indices.begin(), c.found.indices.end(), in_cloud) ||
      !(c.class_of.empty() || c.class_of.size() == c.found.size()))
    throw py::value_error("the state is inconsistent");
  return c;
}

py::tuple state_of_ground(const GroundObject& g) {
  const GroundSplit& s = g.split;
  const auto array = [](const std::vector<std::int32_t>& list) {
    return py::array_t<std::int32_t>(static_cast<py::ssize_t>(list.size()), list.data());
  };
  return py::make_tuple(g.points, s.found, array_of(s.normal), s.offset, array(s.ground), array(s.rest));
}

GroundObject ground_from_state(py::handle given) {
  const py::tuple state = tuple_of_state(given, 6);
  GroundObject g;
  g.points = points_of_state(state[0]);
  g.split.found = state[1].cast<bool>();
  g.split.normal = vector3(state[2], "normal");
  g.split.offset = state[3].cast<double>();
  g.split.ground = list_of<std::int32_t>(state[4]);
  g.split.rest = list_of<std::int32_t>(state[5]);
  for (const auto* list : {&g.split.ground, &g.split.rest}) {
    for (const std::int32_t i : *list) {
      if (i < 0 || static_cast<std::size_t>(i) >= g.points)
        throw py::value_error("the state is inconsistent");
    }
  }
  return g;
}

std::string repr_of_clusters(const ClustersObject& c) {
  std::string text =
      "Clusters(" + std::to_string(c.found.size()) + " of " + std::to_string(c.points) + " points";
  const auto add = [&](const char* what, std::size_t n) {
    if (n > 0) text.append(", ").append(what).append("=").append(std::to_string(n));
  };
  if (c.found.size() > 0) add("largest", c.found.list_size(0));
  add("small_points", c.found.small_points);
  add("large_points", c.found.large_points);
  add("noise_points", c.found.noise_points);
  add("class_points", c.found.class_points);
  return text + ')';
}

void bind_clusters(py::module_& module) {
  using C = ClustersObject;
  py::class_<C>(module, "Clusters", clusters_doc)
      .def_property_readonly(
          "labels",
          [](const py::object& self) { return view_of_vector(self.cast<C&>().computed_labels(), self); },
          "(N,) int32: the index of each point's cluster; -1: none.")
      .def_property_readonly(
          "indices",
          [](const py::object& self) { return view_of_vector(self.cast<const C&>().found.indices, self); },
          "int32: point indices of all clusters, one cluster after the other, ascending within a cluster.")
      .def_property_readonly(
          "offsets",
          [](const py::object& self) { return view_of_vector(self.cast<const C&>().found.offsets, self); },
          "The position in indices where each cluster begins, and the length of indices as last element.")
      .def_property_readonly(
          "classes",
          [](const py::object& self) { return view_of_vector(self.cast<const C&>().class_of, self); },
          "int64: the class of each cluster; empty without classes.")
      .def_property_readonly(
          "small_points", [](const C& c) { return c.found.small_points; },
          "Number of points in clusters of fewer than min_size points.")
      .def_property_readonly(
          "large_points", [](const C& c) { return c.found.large_points; },
          "Number of points in clusters of more than max_size points.")
      .def_property_readonly(
          "noise_points", [](const C& c) { return c.found.noise_points; },
          "Number of noise points: neither core points nor within the tolerance of a core point.")
      .def_property_readonly(
          "class_points", [](const C& c) { return c.found.class_points; },
          "Number of points of classes that are dropped.")
      .def("__len__", [](const C& c) { return c.found.size(); })
      .def("__getitem__", cluster_at)
      .def("__repr__", repr_of_clusters)
      .def(py::pickle([](const C& c) -> py::object { return state_of(c); },
                      [](const py::object& state) {
                        return restore_from_state("Clusters", [&] { return from_state(state); });
                      }));
  module.def("cluster", find_clusters, "points"_a, "tolerance"_a, py::kw_only(), "min_size"_a = 1,
             "max_size"_a = py::none(), "min_points"_a = 1, "tolerance_per_metre"_a = 0,
             "oversized"_a = "drop", "classes"_a = py::none(), "class_settings"_a = py::none(),
             "threads"_a = 1, cluster_doc);
}

void bind_ground(py::module_& module) {
  using G = GroundObject;
  py::class_<G>(module, "Ground", ground_class_doc)
      .def_property_readonly(
          "found", [](const G& g) { return g.split.found; }, "Whether a ground was found.")
      .def_property_readonly(
          "normal", [](const G& g) { return array_of(g.split.normal); },
          "Unit normal of the plane, pointing up; zero vector if no ground is found.")
      .def_property_readonly(
          "offset", [](const G& g) { return g.split.offset; },
          "The height of p above the plane is normal . p - offset.")
      .def_property_readonly(
          "ground",
          [](const py::object& self) { return view_of_vector(self.cast<const G&>().split.ground, self); },
          "int32: indices of the ground's points.")
      .def_property_readonly(
          "rest",
          [](const py::object& self) { return view_of_vector(self.cast<const G&>().split.rest, self); },
          "int32: indices of the other finite points.")
      .def_property_readonly("mask", mask_of, "(N,) bool: which points are ground.")
      .def(py::pickle([](const G& g) -> py::object { return state_of_ground(g); },
                      [](const py::object& state) {
                        return restore_from_state("Ground", [&] { return ground_from_state(state); });
                      }))
      .def("__repr__", [](const G& g) {
        return "Ground(found=" + std::string(g.split.found ? "True" : "False") +
               ", ground=" + std::to_string(g.split.ground.size()) +
               ", rest=" + std::to_string(g.split.rest.size()) + " points)";
      });
  module.def("ground", find_ground, "points"_a, "method"_a = "zones", py::kw_only(), "up"_a = "z",
             "sensor"_a = py::none(), "sensor_height"_a = py::none(), "distance"_a = py::none(),
             "max_slope_degrees"_a = py::none(), "cell_size"_a = py::none(), "threads"_a = 1, ground_doc);
}

}  // namespace

void bind_segmentation(py::module_& module) {
  bind_clusters(module);
  bind_ground(module);
  module.def("statistics", statistics_of, "points"_a, py::kw_only(), "threads"_a = 1, statistics_doc);
}

}  // namespace pcl_bv::python
