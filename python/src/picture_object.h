// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of Python's Picture.
#pragma once

#include "arrays.h"
#include "pcl_bv/report/picture.h"
#include "result_object.h"

namespace pcl_bv::python {
using namespace detail;

struct PictureSize {
  ViewFrom from = ViewFrom::iso;
  int width = 1600, height = 1000;
};
PictureSize picture_size(py::handle view, py::handle width, py::handle height);

/// A picture and the owners of the points, labels and volumes that it shows.
struct PictureObject {
  std::shared_ptr<const ResultObject> result{};  ///< The result that the picture shows, or null.
  PointArray points{};                           ///< The points. Empty if `result` is not null.
  std::vector<std::uint32_t> labels{};
  Picture picture{};  ///< Has references to the other members.

  py::bytes png() const;
  std::string svg() const;
};

/// Returns the HTML page of the live view, with this result.
std::string page_of_result(const ResultObject& result, std::size_t max_points);

PictureObject picture_of_result(const std::shared_ptr<const ResultObject>& result, const PictureSize& size);

}  // namespace pcl_bv::python
