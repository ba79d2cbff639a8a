// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The result of a pipeline for one frame.

#include "bind.h"
#include "clusters_object.h"
#include "pcl_bv/io/number_text.h"
#include "picture_object.h"
#include "result_object.h"
#include "result_state.h"
#include "state.h"
#include "view_html.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;
using Shared = std::shared_ptr<ResultObject>;

py::object volume_at(const ClusterObject& cluster, std::size_t method) {
  const FrameResult& result = cluster.owner_result->result;
  return to_python(AnyVolume(result.volume(cluster.id, method)), result.methods[method],
                   result.results[cluster.id * result.methods.size() + method]);
}

py::list volumes_of_cluster(const ClusterObject& cluster) {
  py::list list;
  const FrameResult& result = cluster.owner_result->result;
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    if (result.is_requested(cluster.id, m)) list.append(volume_at(cluster, m));
  }
  return list;
}

py::object volume_by_name(const ClusterObject& cluster, py::handle name) {
  const Method* const method = method_of(name);
  const FrameResult& result = cluster.owner_result->result;
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    if (result.methods[m] == method && result.is_requested(cluster.id, m)) return volume_at(cluster, m);
  }
  throw py::key_error(std::string(method->name) + " is not a method of this pipeline");
}

/// Returns the indices of the cluster's points. Usually takes these indices from the pipeline's index list.
/// The pipeline makes no index list if all valid points that passed the filter are one cluster. In this case,
/// computes the indices from the labels.
py::object indices_of(const ClusterObject& cluster) {
  const FrameResult& result = cluster.owner_result->result;
  if (!result.clusters.indices.empty() || result.clusters.list_size(cluster.id) == 0)
    return view_of_part(result.clusters.indices.data() + result.clusters.offsets[cluster.id],
                        result.clusters.indices.empty() ? 0 : result.clusters.list_size(cluster.id),
                        py::cast(cluster));
  const std::vector<std::uint32_t> labels = labels_of(cluster.owner_result->frame(), result);
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == cluster.id) numbers.push_back(static_cast<std::int32_t>(i));
  }
  return read_only(array_from_vector(std::move(numbers)));
}

py::object track_of(const ClusterObject& cluster) {
  const auto& tracks = cluster.owner_result->result.tracks;
  if (tracks.empty() || !tracks[cluster.id]) return py::none();
  return py::cast(*tracks[cluster.id]);
}

std::string repr_of_cluster(const ClusterObject& cluster) {
  const FrameResult& result = cluster.owner_result->result;
  std::string text = "Cluster(id=" + std::to_string(cluster.id) +
                     ", points=" + std::to_string(result.clusters.list_size(cluster.id));
  if (!result.class_of.empty()) text += ", class_value=" + std::to_string(result.class_of[cluster.id]);
  if (!result.tracks.empty() && result.tracks[cluster.id])
    text += ", track=" + std::to_string(result.tracks[cluster.id]->id);
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    if (!result.is_requested(cluster.id, m)) continue;
    text.append(m == 0 ? ", volumes: " : ", ").append(result.methods[m]->name);
  }
  return text + ')';
}

py::list clusters_of(const Shared& self) {
  py::list list(self->result.clusters.size());
  for (std::size_t id = 0; id < self->result.clusters.size(); ++id)
    list[id] = py::cast(ClusterObject{self, id});
  return list;
}

Refinement refinement_of(const ClusterObject& cluster) {
  const std::vector<Refinement>& all = cluster.owner_result->result.refinements;
  return all.empty() ? Refinement::none : all[cluster.id];
}

py::dict counts_of(const Shared& self) {
  const Counts& c = self->result.counts;
  return py::dict("nonfinite"_a = c.nonfinite, "range"_a = c.range, "ground"_a = c.ground,
                  "small"_a = c.small, "large"_a = c.large, "noise"_a = c.noise, "inside"_a = c.inside,
                  "class"_a = c.dropped_class, "cut"_a = c.cut, "joined"_a = c.joined);
}

py::dict times_of(const Shared& self) {
  const StageTimes& ms = self->result.ms;
  return py::dict("filter"_a = ms.filter, "ground"_a = ms.ground, "cluster"_a = ms.cluster, "fit"_a = ms.fit,
                  "track"_a = ms.track, "total"_a = ms.total);
}

/// Returns the labels as int32. kLabelNone becomes -1, kLabelGround becomes -2.
py::object labels_array(const Shared& self) {
  std::vector<std::uint32_t> labels;
  {
    const py::gil_scoped_release unlocked;
    labels = labels_of(self->frame(), self->result);
  }
  return array_from_vector(std::move(labels)).attr("view")("int32");
}

py::object deskew_of(const Shared& self) {
  if (!self->result.deskew.moved()) return py::none();
  return py::str(self->result.deskew.outcome == DeskewOutcome::by_poses ? "poses" : "tracks");
}

py::object deskewed_points_of(const Shared& self) {
  if (!self->result.deskew.moved()) return py::none();
  const PointView& points = self->result.deskew.points;
  const py::dtype type =
      points.scalar == ScalarType::float32 ? py::dtype::of<float>() : py::dtype::of<double>();
  const auto count = static_cast<py::ssize_t>(points.count);
  return read_only(py::array(type, {count, py::ssize_t{3}}, self->deskewed.data(), py::cast(self)));
}

std::string repr_of_result(const Shared& self) {
  const FrameResult& result = self->result;
  return "Result(" + std::to_string(result.clusters.size()) + " clusters of " +
         std::to_string(result.points) + " points, ground=" + std::to_string(result.counts.ground) + ", in " +
         fixed_text(result.ms.total, 2) + " ms)";
}

py::array covariance_of(const TrackEntry& track) {
  Eigen::MatrixXd m(6, 6);
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index k = i; k < 6; ++k)
      m(i, k) = m(k, i) = track.covariance[next++];
  }
  return array_of(m);
}

void bind_track(py::module_& module) {
  py::class_<TrackEntry>(module, "Track", R"(An object tracked over frames.

Coordinates are in the fixed frame if the sensor's poses are given, otherwise in the sensor's frame. Units:
metres, radians, seconds.

>>> import pcl_bv
>>> pipeline = pcl_bv.Pipeline(track={'enabled': True, 'birth': 1})
>>> pipeline.process(pcl_bv.read('synth:street:20000:1')).clusters[0].track
Track(id=0, age=1, velocity=[0, 0, 0])
)")
      .def_readonly("id", &TrackEntry::id, "Unique: never given to another object.")
      .def_readonly("age", &TrackEntry::age,
                    "Number of frames since the first detection, including that frame.")
      .def_readonly("moving", &TrackEntry::moving,
                    "Whether it moves; over the ground if the sensor's motion is known.")
      .def_property_readonly(
          "velocity", [](const TrackEntry& t) { return array_of(t.velocity); }, "(3,), in m/s.")
      .def_property_readonly(
          "pose", [](const TrackEntry& t) { return read_only(py::array_t<double>(4, t.pose.data())); },
          "x, y, z of the centre and the yaw of its heading.")
      .def_property_readonly("covariance", covariance_of, "(6, 6), of x, y, z, yaw, vx, vy.")
      .def(
          "__eq__", [](const TrackEntry& a, const TrackEntry& b) { return a == b; }, py::is_operator())
      .def("__repr__", [](const TrackEntry& t) {
        return "Track(id=" + std::to_string(t.id) + ", age=" + std::to_string(t.age) +
               ", velocity=" + vector_text(t.velocity, 3) + (t.moving ? ", moving)" : ")");
      });
}

constexpr const char* cluster_class_doc =
    R"(One object of a frame: its points, volumes and track. cluster['aabb'] is the volume of that method.

>>> import pcl_bv
>>> pipeline = pcl_bv.Pipeline(volumes=['aabb', 'sphere'], cluster={'min_size': 100})
>>> cluster = pipeline.process(pcl_bv.read('synth:street:20000:1')).clusters[0]
>>> cluster['sphere'].used == cluster.points == len(cluster.indices)
True
)";

constexpr const char* result_doc =
    R"(The result of Pipeline.process() for one frame. Owns its memory and keeps the frame's array alive.

A notebook shows it as a page or a picture.

>>> import numpy, pcl_bv
>>> points = pcl_bv.read('synth:street:20000:1')
>>> result = pcl_bv.Pipeline(cluster={'min_size': 100}).process(points)
>>> len(result) == len(result.clusters), result.points
(True, 20032)
>>> bool((result.labels[result.clusters[0].indices] == 0).all())
True
>>> int((result.labels == -2).sum()) == result.counts['ground']
True
)";

constexpr const char* json_doc = R"(json(self, /)
--

Returns the frame as bv_stream writes it: a JSON object on one line. Every number is written with enough
digits to be read back exactly.

>>> import json, pcl_bv
>>> result = pcl_bv.Pipeline(cluster={'min_size': 100}).process(pcl_bv.read('synth:street:20000:1'))
>>> json.loads(result.json())['points']
20032
)";

constexpr const char* result_picture_doc = R"(picture(self, *, view='iso', width=1600, height=1000)
--

Returns a Picture of the points, clusters in colours, and the volumes. view: 'iso', 'top', 'front' or 'side'.

>>> import pcl_bv
>>> result = pcl_bv.Pipeline(cluster={'min_size': 100}).process(pcl_bv.read('synth:street:20000:1'))
>>> result.picture(view='top', width=640, height=400)
Picture(640 x 400, 18847 points)
)";

constexpr const char* page_doc = R"(page(self, /)
--

Returns the page of the live view with this frame, as text of a self-contained HTML file. The page can be
rotated and zoomed; a click on an object shows its numbers. Larger clouds are reduced to 500000 points. A
notebook shows the same page with at most 50000 points; write('x.html', result) writes the file.

>>> import numpy, pcl_bv
>>> points = numpy.random.default_rng(1).normal(size=(500, 3)) + [5, 0, 0]
>>> pcl_bv.Pipeline(ground={'method': 'none'}).process(points).page()[:15]
'<!DOCTYPE html>'
)";

// Maximum number of points in a notebook's cell. Each point takes 22 bytes in the notebook's file.
constexpr std::size_t kMaxCellPoints = 50'000;

std::string in_a_notebook(const std::string& page) {
  std::string cell =
      R"(<iframe style="width: 100%; height: 32em; border: 0" sandbox="allow-scripts" srcdoc=")";
  for (const char c : page)
    c == '"' ? cell += "&quot;" : c == '&' ? cell += "&amp;" : cell += c;
  return cell + "\"></iframe>";
}

void bind_cluster(py::module_& module) {
  py::class_<ClusterObject>(module, "Cluster", cluster_class_doc)
      .def_readonly("id", &ClusterObject::id, "Its index in the frame; 0 is the largest cluster.")
      .def_property_readonly(
          "points", [](const ClusterObject& c) { return c.owner_result->result.clusters.list_size(c.id); },
          "Number of valid points.")
      .def_property_readonly("indices", indices_of, "int32: the indices of its points in the frame's array.")
      .def_property_readonly("volumes", volumes_of_cluster,
                             "Its volumes, in the order of the setting volumes.")
      .def_property_readonly("track", track_of,
                             "The Track, or None without tracking and before the track is confirmed.")
      .def_property_readonly(
          "class_value",
          [](const ClusterObject& c) -> py::object {
            const auto& classes = c.owner_result->result.class_of;
            return classes.empty() ? py::object(py::none()) : py::object(py::int_(classes[c.id]));
          },
          "The class of its points, or None without classes.")
      .def_property_readonly(
          "cut", [](const ClusterObject& c) { return refinement_of(c) == Refinement::cut; },
          "Whether it is a part of a cluster that was cut (setting cluster.refine).")
      .def_property_readonly(
          "joined", [](const ClusterObject& c) { return refinement_of(c) == Refinement::joined; },
          "Whether it was joined from several clusters (setting cluster.refine).")
      .def("__getitem__", volume_by_name)
      .def("__repr__", repr_of_cluster);
}

}  // namespace

void bind_result(py::module_& module) {
  bind_track(module);
  bind_cluster(module);
  py::class_<ResultObject, Shared>(module, "Result", result_doc)
      .def_property_readonly("clusters", clusters_of, "A list of Cluster, the largest first.")
      .def_property_readonly(
          "points", [](const Shared& r) { return r->result.points; },
          "Number of points, including points that are not finite.")
      .def_property_readonly("counts", counts_of, "Points that are in no cluster, by reason: a dict.")
      .def_property_readonly("labels", labels_array,
                             "(N,) int32: each point's cluster; -1: none, -2: ground.")
      .def_property_readonly(
          "deskew", deskew_of,
          "How the points were moved to stamp_ns: 'poses', 'tracks', or None if they were not.")
      .def_property_readonly(
          "deskewed", deskewed_points_of,
          "(N, 3), of the type of the frame's points: the moved points, in their order; None if "
          "points were not moved. Belongs to the result. Read-only.")
      .def_property_readonly("ms", times_of, "Milliseconds of each stage: a dict.")
      .def_property_readonly(
          "stamp_ns", [](const Shared& r) { return r->result.header.stamp_ns; }, "As given.")
      .def_property_readonly(
          "seq", [](const Shared& r) { return r->result.header.seq; }, "As given, or counted.")
      .def_property_readonly(
          "frame_id", [](const Shared& r) { return r->result.header.frame_id; }, "As given.")
      .def_property_readonly(
          "ground",
          [](const Shared& r) {
            return GroundObject{r->result.ground, r->result.points};
          },
          "The Ground; its found is False if the pipeline does not detect the ground.")
      .def(
          "json",
          [](const Shared& r) {
            return frame_json(report_without_clusters(r->frame(), r->result), cluster_source(r->result));
          },
          json_doc)
      .def(
          "picture",
          [](const Shared& r, py::handle view, py::handle width, py::handle height) {
            return picture_of_result(r, picture_size(view, width, height));
          },
          py::kw_only(), "view"_a = "iso", "width"_a = 1600, "height"_a = 1000, result_picture_doc)
      .def(
          "page", [](const Shared& r) { return page_of_result(*r, kMaxPagePoints); }, page_doc)
      .def("_repr_html_", [](const Shared& r) { return in_a_notebook(page_of_result(*r, kMaxCellPoints)); })
      .def("_repr_png_", [](const Shared& r) { return picture_of_result(r, {}).png(); })
      .def("__len__", [](const Shared& r) { return r->result.clusters.size(); })
      .def("__repr__", repr_of_result)
      .def(py::pickle([](const Shared& r) -> py::object { return state_of_result(r); },
                      [](const py::object& state) {
                        return restore_from_state("Result", [&] { return result_of_state(state); });
                      }));
}

}  // namespace pcl_bv::python
