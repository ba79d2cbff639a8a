// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of Python's Result and Cluster.
#pragma once

#include <cstring>

#include "arrays.h"
#include "pcl_bv/nodes/frame_result.h"

namespace pcl_bv::python {
using namespace detail;

/// The result for a frame, and the frame's points. Pictures and clusters of the result need these points.
struct ResultObject {
  FrameResult result;
  PointArray points;
  std::optional<Pose> pose{};
  std::vector<double> deskewed{};  ///< x, y, z of the moved points, as float32 or float64.

  /// Copies the moved points, if there are any, from the memory of the pipeline to this object. The next
  /// frame overwrites the memory of the pipeline.
  void own_deskewed_points() {
    if (result.deskew.moved()) own_deskewed_points(result.deskew.points);
  }

  /// Copies `packed`, the packed points that replace those of the frame.
  void own_deskewed_points(const PointView& packed) {
    const std::size_t bytes = packed.count * packed.stride;
    deskewed.resize((bytes + sizeof(double) - 1) / sizeof(double));
    if (bytes > 0) std::memcpy(deskewed.data(), packed.data, bytes);
    result.deskew.points =
        packed_points(reinterpret_cast<const std::byte*>(deskewed.data()), packed.scalar, packed.count);
  }

  Frame frame() const {
    Frame frame;
    frame.header = result.header;
    frame.points = points.view;
    frame.pose = pose;
    return frame;
  }
};

/// A cluster of a result. It keeps the result alive.
struct ClusterObject {
  std::shared_ptr<const ResultObject> owner_result;
  std::size_t id = 0;
};

}  // namespace pcl_bv::python

/// Loads a plain pointer first: for an object without a value this raises the TypeError of module.cpp, where
/// pybind11's own caster raises a RuntimeError about holders.
template <>
class pybind11::detail::type_caster<std::shared_ptr<pcl_bv::python::ResultObject>>
    : public copyable_holder_caster<pcl_bv::python::ResultObject,
                                    std::shared_ptr<pcl_bv::python::ResultObject>> {
 public:
  bool load(handle source, bool convert) {
    return make_caster<pcl_bv::python::ResultObject>().load(source, convert) &&
           copyable_holder_caster::load(source, convert);
  }
};
