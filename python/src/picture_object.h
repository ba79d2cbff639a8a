// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "arrays.h"
#include "result_object.h"

namespace pcl_bv::python {

struct PictureSize {
  ViewFrom from = ViewFrom::iso;
  int width = 1600, height = 1000;
};
PictureSize picture_size(py::handle view, py::handle width, py::handle height);

/// A picture, and what it is of.
struct PictureObject {
  std::shared_ptr<const ResultObject> result{};  ///< Or points of its own:
  PointArray points{};
  std::vector<std::uint32_t> labels{};
  Picture picture{};  ///< Looks at the above.

  py::bytes png() const;
  std::string svg() const;
};

/// The page of the live view with a result, as HTML.
std::string page_of_result(const ResultObject& result, std::size_t most_points);

PictureObject picture_of_result(const std::shared_ptr<const ResultObject>& result, const PictureSize& size);

}  // namespace pcl_bv::python
