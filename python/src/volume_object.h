// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of Python's volumes. Volumes never change, so that threads may share them.
#pragma once

#include "arguments.h"
#include "arrays.h"

namespace pcl_bv::python {
using namespace detail;

/// The base of all shapes' classes: a volume and the result of its fit.
struct VolumeObject {
  AnyVolume value;
  const Method* method = nullptr;  ///< Null if the volume is not the result of a fit.
  EstimationResult fit{};
};

/// The Python class of a shape.
template <typename Shape>
struct ShapeObject : VolumeObject {
  const Shape& shape() const { return std::get<Shape>(value); }
};

/// Converts a volume to an object of its shape's class.
py::object to_python(AnyVolume&& volume, const Method* method = nullptr, const EstimationResult& fit = {});

/// Returns the volume of an argument. Raises a TypeError if the argument is not a volume.
const VolumeObject& volume_of(py::handle value, const char* name);

/// A volume and its label. If the argument is a dict, the label is the key of the volume, otherwise 0.
struct LabelledVolume {
  std::int64_t number;
  const VolumeObject* volume;
};

/// Returns the volumes of an argument. The argument must be None, a volume, a list of volumes, or a dict
/// whose values are volumes or lists of volumes.
std::vector<LabelledVolume> volumes_of(py::handle value, const char* name);

/// Returns the name of a status: "ok", "degenerate", "no_valid_points" or "failed".
const char* status_name(EstimationStatus status);

/// Returns the arguments, in order, with which the constructor gives the same shape.
py::tuple arguments_of(const Aabb& box);
py::tuple arguments_of(const Kdop& kdop);
py::tuple arguments_of(const Sphere& sphere);
py::tuple arguments_of(const Obb& box);
py::tuple arguments_of(const Cylinder& cylinder);
py::tuple arguments_of(const Capsule& capsule);
py::tuple arguments_of(const Ellipsoid& ellipsoid);
py::tuple arguments_of(const Hull& hull);
py::tuple arguments_of(const Prism& prism);

/// These functions convert the result of a fit to and from the state that pickle stores.
py::tuple fit_state(const VolumeObject& volume);
void set_fit_state(py::handle state, VolumeObject& volume);

/// Returns "[x, y, z]" with `digits` significant digits.
std::string vector_text(const Eigen::Vector3d& v, int digits);

/// Returns the repr() with six digits, for example "Sphere(center=[1, 2, 3], radius=4, method='sphere-exact',
/// used=100)".
std::string repr_of(const VolumeObject& volume);

}  // namespace pcl_bv::python
