// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of clouds that are processed in shares, as pcd_bv --partial --cluster and --merge --cluster find
// them.

#include "bind.h"
#include "commands/pcd_bv/inputs.h"
#include "commands/pcd_bv/object_shares.h"
#include "commands/pcd_bv/tiled_settings.h"
#include "commands/pcd_bv/tiles.h"
#include "commands/shared/messages.h"
#include "commands/shared/values.h"
#include "config_dict.h"
#include "object_share_docs.h"
#include "pcl_bv/report/cluster_json.h"
#include "state.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

/// An object of a merged cloud.
struct MergedObject {
  ClusterEntry entry;
};

/// An input that does not exist.
struct MissingInput {
  std::string name;
};

std::vector<std::string> path_list(py::handle paths, const char* name) {
  std::vector<std::string> list;
  const bool many = py::isinstance<py::list>(paths) || py::isinstance<py::tuple>(paths);
  if (!many) return {path(paths, name).string()};
  for (const py::handle each : py::reinterpret_borrow<py::sequence>(paths))
    list.push_back(path(each, name).string());
  if (list.empty()) raise_value_error(name, "an empty list");
  return list;
}

ShareOption share_argument(py::handle share) {
  const bool pair = py::isinstance<py::tuple>(share) || py::isinstance<py::list>(share);
  if (!pair || py::len(share) != 2) raise_type_error("share", "a pair (k, n)", share);
  const auto numbers = py::reinterpret_borrow<py::sequence>(share);
  ShareOption option;
  option.count = whole_number(py::object(numbers[1]), "share: n", {1, 1'000'000});
  option.number =
      whole_number(py::object(numbers[0]), "share: k", {0, static_cast<double>(option.count - 1)});
  return option;
}

/// Returns the settings of a command with --cluster. The settings are those of Pipeline().
Options options_of(py::handle cluster, py::handle volumes, py::handle memory, bool allows_ground,
                   const py::kwargs& settings) {
  py::dict all = settings.attr("copy")();
  const bool is_dict = py::isinstance<py::dict>(cluster);
  if (!is_dict) number(cluster, "cluster", {0, 1e6, false});
  all["cluster"] = is_dict ? py::reinterpret_borrow<py::object>(cluster) : py::dict("tolerance"_a = cluster);
  if (!volumes.is_none()) {
    all["volumes"] = PyUnicode_Check(volumes.ptr()) ? py::object(py::list(py::make_tuple(volumes)))
                                                    : py::reinterpret_borrow<py::object>(volumes);
  }
  Options options;
  PipelineConfig defaults = whole_cloud_config();
  defaults.threads = 1;
  options.pipeline = config_of(py::none(), py::none(), all, defaults);
  if (!options.clusters()) raise_value_error("cluster", "a tolerance above 0 is needed");
  const std::string setting = setting_not_for_tiles(options.pipeline, allows_ground);
  if (!setting.empty()) raise_value_error("settings", "shares cannot be combined with " + setting);
  for (const RegionConfig& region : options.pipeline.filter.regions)
    if (region.file.empty()) raise_value_error("filter.regions", "shares need files, not volumes");
  options.memory_bytes = whole_number(memory, "memory", {1, 1e6}) * 1'000'000;
  return options;
}

/// Calls work() without the GIL. Throws its errors as Python's exceptions. Returns the problems that it has
/// reported.
template <typename Work>
std::vector<std::string> run_unlocked(const Work& work) {
  std::vector<std::string> problems;
  try {
    const py::gil_scoped_release unlocked;
    DeferredMessages deferred;
    work();
    problems = deferred.messages;
  } catch (const UsageError& error) {
    throw py::value_error(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw IoError(error.what());
  } catch (const MissingInput& missing) {
    errno = ENOENT;
    PyErr_SetFromErrnoWithFilename(PyExc_FileNotFoundError, missing.name.c_str());
    throw py::error_already_set();
  }
  for (std::string& problem : take_problems())
    problems.push_back(std::move(problem));
  return problems;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines)
    text.append(text.empty() ? "" : "; ").append(line);
  return text;
}

/// Throws MissingInput for a file that does not exist, and IoError with all other inputs that cannot be read.
void require_inputs(const Tiles& tiles) {
  std::vector<std::string> failed;
  for (std::size_t i = 0; i < tiles.jobs().size(); ++i) {
    const Job& job = tiles.jobs()[i];
    std::error_code unknown;
    if (!tiles.header(i).error) continue;
    if (!job.recording && !is_synth(job.input) && !std::filesystem::exists(job.input, unknown))
      throw MissingInput{job.input};
    failed.push_back(job.input + ": " + *tiles.header(i).error);
  }
  if (!failed.empty()) throw IoError(joined(failed));
}

void write_share(py::handle file, py::handle inputs, py::handle cluster, py::handle share, py::handle volumes,
                 py::handle origin, py::handle memory, py::handle bin_fields, const py::kwargs& settings) {
  Options options = options_of(cluster, volumes, memory, false, settings);
  options.partial = path(file, "path");
  options.inputs = path_list(inputs, "inputs");
  options.share = share_argument(share);
  options.tiled = true;
  if (!origin.is_none()) options.origin = {true, vector3(origin, "origin")};
  options.bin_fields = whole_number(bin_fields, "bin_fields", {0, 32});
  std::shared_ptr<Tiles> tiles;
  for (const std::string& problem : run_unlocked([&] {
         tiles = plan_jobs(options).front().tiles;
         require_inputs(*tiles);
         try {
           write_object_share(*tiles, options.share, options, std::nullopt, *options.partial);
         } catch (const TileError& error) {
           throw IoError(tiles->jobs()[error.tile()].input + ": " + error.what());
         } catch (const IoError& error) {
           throw IoError(options.partial->string() + ": " + error.what());
         }
       }))
    warn(problem);
  for (std::size_t i = 0; i < tiles->jobs().size(); ++i) {
    const std::string note = tiles->note(i);
    if (!note.empty()) warn(tiles->jobs()[i].input + ": " + note);
  }
}

py::list merge_shares(py::handle paths, py::handle cluster, py::handle volumes, py::handle memory,
                      const py::kwargs& settings) {
  Options options = options_of(cluster, volumes, memory, true, settings);
  options.inputs = path_list(paths, "paths");
  options.merge = true;
  Report report;
  const std::vector<std::string> problems = run_unlocked([&] {
    const Job job = plan_jobs(options).front();
    std::error_code unknown;
    for (const std::string& file : job.partials)
      if (!std::filesystem::exists(file, unknown)) throw MissingInput{file};
    merge_object_files(job, job.partials, FileLife::lasting, options, report);
  });
  if (report.error) throw IoError(joined(problems));
  for (const std::string& problem : problems)
    warn(problem);
  py::list objects(report.clusters.size());
  for (std::size_t i = 0; i < report.clusters.size(); ++i)
    objects[i] = py::cast(MergedObject{std::move(report.clusters[i])});
  return objects;
}

py::object volume_of_entry(const VolumeEntry& entry) {
  return to_python(AnyVolume(entry.volume));
}

py::list volumes_of_object(const MergedObject& object) {
  py::list list;
  for (const VolumeEntry& entry : object.entry.volumes)
    list.append(volume_of_entry(entry));
  return list;
}

py::list methods_of_object(const MergedObject& object) {
  py::list list;
  for (const VolumeEntry& entry : object.entry.volumes)
    list.append(entry.method);
  return list;
}

py::object volume_of_method(const MergedObject& object, py::handle name) {
  const Method* const method = method_of(name);
  for (const VolumeEntry& entry : object.entry.volumes)
    if (entry.method == method->name) return volume_of_entry(entry);
  throw py::key_error(std::string(method->name) + " is not a method of this object");
}

std::string repr_of_object(const MergedObject& object) {
  const ClusterEntry& entry = object.entry;
  std::string text = "Object(id=" + std::to_string(entry.id) + ", points=" + std::to_string(entry.points);
  if (entry.class_value) text += ", class_value=" + std::to_string(*entry.class_value);
  if (entry.incomplete) text += ", incomplete=True";
  for (const VolumeEntry& each : entry.volumes)
    text.append(&each == entry.volumes.data() ? ", volumes: " : ", ").append(each.method);
  return text + ')';
}

MergedObject object_of_state(const py::object& state) {
  const py::tuple parts = tuple_of_state(state, 2);
  MergedObject object{read_cluster_json(text(parts[0], "text"))};
  object.entry.incomplete = parts[1].cast<bool>();
  return object;
}

}  // namespace

void bind_object_shares(py::module_& module) {
  py::class_<MergedObject>(module, "Object", object_doc)
      .def_property_readonly(
          "id", [](const MergedObject& o) { return o.entry.id; }, "Its index; 0 is the largest object.")
      .def_property_readonly(
          "points", [](const MergedObject& o) { return o.entry.points; }, "Number of valid points.")
      .def_property_readonly("volumes", volumes_of_object, "Its volumes, in the order of methods.")
      .def_property_readonly("methods", methods_of_object, "The names of the methods of its volumes.")
      .def_property_readonly(
          "class_value",
          [](const MergedObject& o) -> py::object {
            return o.entry.class_value ? py::object(py::int_(*o.entry.class_value)) : py::object(py::none());
          },
          "The class of its points, or None without classes.")
      .def_property_readonly(
          "incomplete", [](const MergedObject& o) { return o.entry.incomplete; },
          "Whether it may lack points, because points of a file near it are damaged.")
      .def("__getitem__", volume_of_method)
      .def("__repr__", repr_of_object)
      .def(py::pickle([](const MergedObject& o)
                          -> py::object { return py::make_tuple(cluster_json(o.entry), o.entry.incomplete); },
                      [](const py::object& state) {
                        return restore_from_state("Object", [&] { return object_of_state(state); });
                      }));
  module.def("write_object_share", write_share, "path"_a, "inputs"_a, py::kw_only(), "cluster"_a,
             "share"_a = py::make_tuple(0, 1), "volumes"_a = py::none(), "origin"_a = py::none(),
             "memory"_a = 600, "bin_fields"_a = 0, write_object_share_doc);
  module.def("merge_object_shares", merge_shares, "paths"_a, py::kw_only(), "cluster"_a,
             "volumes"_a = py::none(), "memory"_a = 600, merge_object_shares_doc);
}

}  // namespace pcl_bv::python
