// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "picture_object.h"

#include "arguments.h"
#include "pcl_bv/report/picture.h"
#include "view_html.h"

namespace pcl_bv::python {
using namespace detail;

PictureSize picture_size(py::handle view, py::handle width, py::handle height) {
  const std::string name = text(view, "view");
  constexpr std::pair<std::string_view, ViewFrom> names[] = {
      {"iso", ViewFrom::iso}, {"top", ViewFrom::top}, {"front", ViewFrom::front}, {"side", ViewFrom::side}};
  const auto found = std::find_if(std::begin(names), std::end(names),
                                  [&](const auto& known) { return known.first == name; });
  if (found == std::end(names))
    raise_value_error("view", "'" + name + "' is not one of iso, top, front, side");
  const auto pixels = [](py::handle value, const char* side) {
    return static_cast<int>(whole_number(value, side, {16, 16384}));
  };
  return {found->second, pixels(width, "width"), pixels(height, "height")};
}

py::bytes PictureObject::png() const {
  std::string content;
  {
    const py::gil_scoped_release unlocked;
    content = picture_png(picture);
  }
  return content;
}

std::string PictureObject::svg() const {
  const py::gil_scoped_release unlocked;
  return picture_svg(picture);
}

std::string page_of_result(const ResultObject& object, std::size_t max_points) {
  const py::gil_scoped_release unlocked;
  const Frame frame = object.frame();
  Report report;
  report.file = frame.header.frame_id.empty() ? "cloud" : frame.header.frame_id;
  report.points = object.result.points;
  report.counts = object.result.counts;
  report.clusters = cluster_entries(object.result);
  return view_html(frame, object.result, report, labels_of(frame, object.result), max_points);
}

PictureObject picture_of_result(const std::shared_ptr<const ResultObject>& result, const PictureSize& size) {
  PictureObject object;
  object.result = result;
  const Frame frame = result->frame();
  object.labels = labels_of(frame, result->result);
  object.picture = picture_of(frame, result->result, object.labels);
  object.picture.from = size.from;
  object.picture.width = size.width;
  object.picture.height = size.height;
  return object;
}

}  // namespace pcl_bv::python
