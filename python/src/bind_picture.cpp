// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Output of pictures and of files. The extension of a file selects its format.

#include "bind.h"
#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/report/csv.h"
#include "pcl_bv/report/meshes.h"
#include "pcl_bv/report/picture.h"
#include "picture_object.h"
#include "raw_cloud_array.h"
#include "view_html.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

/// Adds volumes. They are coloured by label or, if all volumes have the same label, by method.
void add_volumes(const std::vector<LabelledVolume>& volumes, Picture& picture) {
  const auto several = [&](const LabelledVolume& v) { return v.number != volumes.front().number; };
  const bool labelled = std::any_of(volumes.begin(), volumes.end(), several);
  for (const LabelledVolume& each : volumes) {
    const Method* const method = each.volume->method;
    const std::string name(method != nullptr ? method->name : shape_name(each.volume->value));
    const auto found = std::find(picture.methods.begin(), picture.methods.end(), name);
    const auto m = static_cast<std::uint32_t>(found - picture.methods.begin());
    if (found == picture.methods.end()) picture.methods.push_back(name);
    const auto number = static_cast<std::uint32_t>(each.number);
    picture.volumes.push_back(
        {each.volume->value, labelled ? number : m, labelled ? std::to_string(number) : "", m});
  }
}

PictureObject show(py::handle points, py::handle volumes, py::handle labels, py::handle view, py::handle up,
                   py::handle unit, py::handle width, py::handle height) {
  PictureObject object;
  const PictureSize size = picture_size(view, width, height);
  if (!points.is_none()) object.points = points_of(points);
  Picture& picture = object.picture;
  picture.points = object.points.view;
  if (!labels.is_none()) {
    object.labels = point_labels(labels, picture.points.count);
    picture.labels = object.labels.data();
  }
  add_volumes(volumes_of(volumes, "volumes"), picture);
  picture.unit = text(unit, "unit");
  picture.up = up_argument(up);
  picture.from = size.from;
  picture.width = size.width;
  picture.height = size.height;
  return object;
}

/// Returns the volumes as clusters of a report, one for each label.
std::vector<ClusterEntry> entries_of_volumes(py::handle volumes) {
  std::vector<ClusterEntry> entries;
  for (const LabelledVolume& each : volumes_of(volumes, "what")) {
    const auto id = static_cast<std::size_t>(each.number);
    if (entries.empty() || entries.back().id != id) entries.emplace_back().id = id;
    ClusterEntry& entry = entries.back();
    entry.points = std::max(entry.points, each.volume->fit.used);
    const Method* const method = each.volume->method;
    entry.volumes.push_back({std::string(method != nullptr ? method->name : shape_name(each.volume->value)),
                             each.volume->value,
                             {},
                             std::string(each.volume->fit.reason)});
  }
  return entries;
}

struct Reported {
  std::vector<ClusterEntry> clusters;
  std::optional<FrameReport> frame{};
};

Reported reported(py::handle what) {
  if (!py::isinstance<ResultObject>(what)) return {entries_of_volumes(what)};
  const auto result = what.cast<std::shared_ptr<ResultObject>>();
  FrameReport frame = report_of(result->frame(), result->result);
  return {frame.clusters, frame};
}

std::string json_text(const Reported& found) {
  if (found.frame) return frame_json(*found.frame) + '\n';
  Report report;
  for (const ClusterEntry& cluster : found.clusters)
    report.points += cluster.points;
  report.clusters = found.clusters;
  return report_json(report) + '\n';
}

std::string csv_text(const Reported& found) {
  if (!found.frame) {
    Report report;
    report.clusters = found.clusters;
    return report_csv_heading() + report_csv(report);
  }
  std::string text = frames_csv_heading();
  const std::string frame =
      std::to_string(found.frame->seq) + ',' + std::to_string(found.frame->stamp_ns) + ',';
  for (const ClusterEntry& cluster : found.clusters)
    append_csv(frame + (cluster.track ? std::to_string(cluster.track->id) : ""), cluster, text, true);
  return text;
}

void write_anything(py::handle file, py::handle what, py::handle labels) {
  const std::filesystem::path target = path(file, "path");
  const std::string extension = lower_case_extension(target);
  if (extension == ".pcd") return write_cloud(target, what, labels);
  if (!labels.is_none())
    raise_value_error("labels", "can only be written to a .pcd file, not to " + repr_text(file));
  if (extension == ".png" || extension == ".svg") {
    PictureObject object = py::isinstance<ResultObject>(what)
                               ? picture_of_result(what.cast<std::shared_ptr<ResultObject>>(), {})
                           : py::isinstance<PictureObject>(what) ? what.cast<PictureObject>()
                                                                 : PictureObject();
    if (!object.result && !py::isinstance<PictureObject>(what))
      add_volumes(volumes_of(what, "what"), object.picture);
    const py::gil_scoped_release unlocked;
    return write_picture(target, object.picture);
  }
  if (extension == ".html") {
    if (!py::isinstance<ResultObject>(what)) raise_type_error("what", "a Result for a .html file", what);
    const auto result = what.cast<std::shared_ptr<ResultObject>>();
    return write_file_atomically(target, page_of_result(*result, kMaxPagePoints));
  }
  const Reported found = reported(what);
  if (extension == ".json" || extension == ".jsonl") return write_file_atomically(target, json_text(found));
  if (extension == ".csv") return write_file_atomically(target, csv_text(found));
  const std::optional<MeshFormat> format = mesh_format(target);
  if (!format)
    raise_value_error(
        "path", "'" + extension + "' is not one of .json, .csv, .ply, .vtp, .glb, .png, .svg, .html, .pcd");
  const py::gil_scoped_release unlocked;
  write_volumes(target, found.clusters, *format);
}

constexpr const char* picture_doc =
    R"(A picture of points and volumes. It is rendered by png() or svg() and needs no display.

A notebook shows it; write(path, picture) saves it. It keeps the array of its points alive.

>>> import pcl_bv
>>> picture = pcl_bv.show([[0., 0, 0], [1, 1, 1]], pcl_bv.Sphere([0, 0, 0], 1), width=320, height=200)
>>> picture.png()[1:4]
b'PNG'
)";

constexpr const char* show_doc =
    R"(show(points, volumes=None, labels=None, *, view='iso', up='z', unit='m', width=1600, height=1000)
--

Returns a Picture of points and volumes, for a notebook or a file.

points: as for fit(), or None. volumes: a volume, a list, or a dict by label, as returned by fit().
labels: the cluster of each point (-1: none, -2: ground), Clusters, or a Result. Clusters select the colours.
view: 'iso', 'top', 'front' or 'side'. up: as for fit(). width, height: 16 to 16384 pixels.

>>> import numpy, pcl_bv
>>> points = numpy.random.default_rng(1).normal(size=(500, 3))
>>> pcl_bv.show(points, pcl_bv.fit(points, ['obb', 'sphere']))
Picture(1600 x 1000, 500 points, 2 volumes)
)";

constexpr const char* png_doc = R"(png(self, /)
--

Returns the picture as bytes of a PNG file.

>>> import pcl_bv
>>> pcl_bv.show([[0., 0, 0]], width=16, height=16).png()[1:4]
b'PNG'
)";

constexpr const char* svg_doc = R"(svg(self, /)
--

Returns the picture as text of an SVG file: the volumes as lines that can be edited, the points as one image.

>>> import pcl_bv
>>> '<svg' in pcl_bv.show([[0., 0, 0]], width=16, height=16).svg()
True
)";

constexpr const char* write_doc = R"(write(path, what, labels=None)
--

Writes a file atomically, in the format of its extension.

.json, .csv, .ply, .vtp, .glb, .png, .svg: `what` is a Result, a volume, a list of volumes, or a dict of these by
    label, as returned by fit(). .json and .csv have the format of pcd_bv, or of bv_stream for a Result. .ply,
    .vtp and .glb contain meshes.
.png, .svg: `what` may also be a Picture.
.html: `what` is a Result. The file is the page of Result.page().
.pcd: `what` is points as for fit(). Records are written with all their fields. labels has an integer for each
    point, which becomes the field `label`.

Raises OSError if the file cannot be written, and ValueError for another extension.

>>> import os, pcl_bv, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> path = os.path.join(folder.name, 'volumes.json')
>>> pcl_bv.write(path, pcl_bv.fit([[0., 0, 0], [1, 2, 3]], ['aabb', 'dop14']))
>>> pcl_bv.read_volumes(path)
[Aabb(min=[0, 0, 0], max=[1, 2, 3]), Kdop(k=14, volume=0)]
>>> folder.cleanup()
)";

std::string repr_of_picture(const PictureObject& p) {
  std::string text = "Picture(" + std::to_string(p.picture.width) + " x " + std::to_string(p.picture.height) +
                     ", " + std::to_string(p.picture.points.count) + " points";
  if (!p.result && !p.picture.volumes.empty())
    text += ", " + std::to_string(p.picture.volumes.size()) + " volumes";
  return text + ')';
}

}  // namespace

void bind_picture(py::module_& module) {
  py::class_<PictureObject>(module, "Picture", picture_doc)
      .def("png", &PictureObject::png, png_doc)
      .def("svg", &PictureObject::svg, svg_doc)
      .def("_repr_png_", &PictureObject::png)
      .def("__repr__", repr_of_picture);
  module.def("show", show, "points"_a, "volumes"_a = py::none(), "labels"_a = py::none(), py::kw_only(),
             "view"_a = "iso", "up"_a = "z", "unit"_a = "m", "width"_a = 1600, "height"_a = 1000, show_doc);
  module.def("write", write_anything, "path"_a, "what"_a, "labels"_a = py::none(), write_doc);
}

}  // namespace pcl_bv::python
