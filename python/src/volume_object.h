// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A volume as Python holds it: a value that no call changes, so that threads may share it.
#pragma once

#include "arguments.h"
#include "arrays.h"

namespace pcl_bv::python {

/// What all have in common, whatever their shape; with what the fit said that made it, if one did.
struct VolumeObject {
  AnyVolume value;
  const Method* method = nullptr;  ///< Null if it is not the result of a fit.
  EstimationResult fit{};
};

/// One class of Python for each shape.
template <typename Shape>
struct ShapeObject : VolumeObject {
  const Shape& shape() const { return std::get<Shape>(value); }
};

/// As an object of the class of its shape.
py::object to_python(AnyVolume&& volume, const Method* method = nullptr, const EstimationResult& fit = {});

/// The volume of an argument.
const VolumeObject& volume_of(py::handle value, const char* name);

/// The volumes of a list, of a dict's values (each a volume or a list), or one alone; each with its label or
/// number.
struct NumberedVolume {
  std::int64_t number;
  const VolumeObject* volume;
};
std::vector<NumberedVolume> volumes_of(py::handle value, const char* name);

/// "ok", "degenerate", "no_valid_points" or "failed".
const char* status_name(EstimationStatus status);

/// What a constructor of the class takes, in its order.
py::tuple arguments_of(const Aabb& box);
py::tuple arguments_of(const Kdop& kdop);
py::tuple arguments_of(const Sphere& sphere);
py::tuple arguments_of(const Obb& box);
py::tuple arguments_of(const Cylinder& cylinder);
py::tuple arguments_of(const Capsule& capsule);
py::tuple arguments_of(const Ellipsoid& ellipsoid);
py::tuple arguments_of(const Hull& hull);

/// What pickle keeps of a fit, and back. Reasons are texts that are never freed.
py::tuple fit_state(const VolumeObject& volume);
void set_fit_state(py::handle state, VolumeObject& volume);

/// "Sphere(center=[1, 2, 3], radius=4, method='sphere-exact', used=100)", with six digits.
std::string repr_of(const VolumeObject& volume);

}  // namespace pcl_bv::python
