// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bind.h"
#include "labels.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/io/number_text.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

using FittedVolumes = std::vector<Fitted<AnyVolume>>;

py::object python_of(Fitted<AnyVolume>&& fitted, const Method* method) {
  return to_python(std::move(fitted.volume), method, fitted);
}

/// Returns a volume if `single` is true, otherwise a list of volumes.
py::object python_of(FittedVolumes&& fitted, const std::vector<const Method*>& methods, bool single) {
  if (single) return python_of(std::move(fitted.front()), methods.front());
  py::list list(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m)
    list[m] = python_of(std::move(fitted[m]), methods[m]);
  return list;
}

py::object fit_labelled(const PointArray& points, const std::vector<const Method*>& methods, bool single,
                        py::handle labels, const Execution& execution, const MethodOptions& options) {
  const LabelGroups groups(labels, points.view);
  std::vector<FittedVolumes> fitted(groups.size());
  {
    const py::gil_scoped_release unlocked;
    for_each_view(
        groups.views(),
        [&](std::size_t i, const Execution& own) {
          fitted[i] = fit_methods(groups.views()[i], methods, options, own);
        },
        execution);
  }
  py::dict by_label;
  for (std::size_t i = 0; i < groups.size(); ++i)
    by_label[py::int_(groups.label(i))] = python_of(std::move(fitted[i]), methods, single);
  return by_label;
}

py::object fit(py::handle points, py::handle method, py::handle labels, py::handle up, py::handle growth,
               py::handle concave_length, py::handle threads, py::handle isa) {
  const PointArray array = points_of(points);
  const Execution execution = execution_of(threads, isa);
  const MethodOptions options{parse_text<SphereGrowth>(growth, "growth"), up_argument(up),
                              concave_length_argument(concave_length)};
  if (PyUnicode_Check(method.ptr()) && labels.is_none() &&
      PyUnicode_CompareWithASCIIString(method.ptr(), "all") != 0) {
    const Method* const method_used = method_of(method);
    Fitted<AnyVolume> fitted;
    {
      const py::gil_scoped_release unlocked;
      fitted = method_used->fit(array.view, options, execution);
    }
    return python_of(std::move(fitted), method_used);
  }
  bool single = false;
  const std::vector<const Method*> methods = methods_of(method, single);
  if (!labels.is_none()) return fit_labelled(array, methods, single, labels, execution, options);
  FittedVolumes fitted;
  {
    const py::gil_scoped_release unlocked;
    fitted = fit_methods(array.view, methods, options, execution);
  }
  return python_of(std::move(fitted), methods, single);
}

struct VerificationObject : Verification {};

py::object verify_volume(py::handle volume, py::handle points, py::handle threads) {
  const VolumeObject& object = volume_of(volume, "volume");
  const PointArray array = points_of(points);
  const Execution execution = execution_of(threads, py::none());
  VerificationObject found;
  {
    const py::gil_scoped_release unlocked;
    static_cast<Verification&>(found) = verify(object.value, array.view, execution);
  }
  return py::cast(found);
}

constexpr const char* fit_doc =
    "fit(points, method, labels=None, *, up='z', growth='deferred', concave_length=None, threads=1, "
    R"(isa=None)
--

Fits a bounding volume to points. Every finite point is inside the volume, by exact arithmetic.

points: (N, 3 or more) float32 or float64 with any positive distance between rows, (H, W, 3 or more), or
    records with fields x, y, z. They are not copied. Points that are not finite are dropped and counted.
method: a name of pcl_bv.methods() or its alias, or a list of them. 'all': every method but hull and best.
labels: an integer for each point, or Clusters. One volume is fitted per label, and none for negative labels.
up: the direction opposite to gravity, used by obb-yaw, obb-lshape and prism: 'x', '-z', ... or three numbers.
growth: how sphere-ritter and sphere-epos* grow the sphere: 'sequential', 'stationary' or 'deferred'.
concave_length: outlines of prisms follow bays wider than this, above 0. None: outlines are convex.
threads: number of threads; 0: all processors. isa: one of instruction_sets. Neither changes the result.

Returns a volume in the frame and unit of the points, or a list of volumes for a list of methods. With labels,
returns a dict from label (ascending) to volume or list. Without finite points, the volume is empty and has
the status 'no_valid_points'. Raises TypeError for other types of numbers, and ValueError for an unknown
method, a wrong shape or a wrong value.

>>> import numpy, pcl_bv
>>> corners = numpy.array([[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4]], numpy.float32)
>>> pcl_bv.fit(corners, 'aabb')
Aabb(min=[0, 0, 0], max=[2, 3, 4], method='aabb', used=4)
>>> box, ball = pcl_bv.fit(corners, ['obb', 'sphere'])
>>> bool(ball.contains(corners).all())
True
>>> sorted(pcl_bv.fit(corners, 'aabb', labels=[7, 7, 9, -1]))
[7, 9]
)";

constexpr const char* verify_doc = R"(verify(volume, points, *, threads=1)
--

Tests for every finite point whether it is inside the volume. The test is exact, with rational arithmetic
where doubles are not sufficient.

Returns a Verification with checked, the number of finite points, outside, the number of finite points outside
the volume, and worst, the largest distance outside a face or surface in the points' unit. Raises errors as
fit() does.

>>> import numpy, pcl_bv
>>> points = numpy.random.default_rng(1).normal(size=(1000, 3))
>>> pcl_bv.verify(pcl_bv.fit(points, 'sphere'), points)
Verification(checked=1000, outside=0, worst=0)
)";

constexpr const char* verification_doc = R"(The result of verify().

>>> import pcl_bv
>>> found = pcl_bv.verify(pcl_bv.Sphere([0, 0, 0], 1), [[0., 0, 1], [0, 0, 3]])
>>> found.checked, found.outside, found.worst
(2, 1, 2.0)
)";

constexpr const char* methods_doc = R"(methods()
--

Returns a dict from the name of each method to its aliases, in the order of the documentation.

>>> import pcl_bv
>>> pcl_bv.methods()['sphere-exact']
('sphere',)
)";

py::dict all_methods() {
  py::dict names;
  for (const Method& method : methods()) {
    py::list aliases;
    for (const std::string_view alias : method.aliases)
      aliases.append(std::string(alias));
    names[py::str(std::string(method.name))] = py::tuple(aliases);
  }
  return names;
}

}  // namespace

void bind_fit(py::module_& module) {
  module.def("fit", fit, "points"_a, "method"_a, "labels"_a = py::none(), py::kw_only(), "up"_a = "z",
             "growth"_a = "deferred", "concave_length"_a = py::none(), "threads"_a = 1, "isa"_a = py::none(),
             fit_doc);
  module.def("methods", all_methods, methods_doc);
  py::class_<VerificationObject>(module, "Verification", verification_doc)
      .def_property_readonly(
          "checked", [](const VerificationObject& v) { return v.checked; }, "Number of finite points.")
      .def_property_readonly(
          "outside", [](const VerificationObject& v) { return v.outside; },
          "Number of finite points outside the volume, by exact arithmetic.")
      .def_property_readonly(
          "worst", [](const VerificationObject& v) { return v.max_violation; },
          "The largest distance outside a face or surface, in the points' unit; 0 if none.")
      .def("__repr__", [](const VerificationObject& v) {
        return "Verification(checked=" + std::to_string(v.checked) +
               ", outside=" + std::to_string(v.outside) + ", worst=" + general_text(v.max_violation, 6) + ")";
      });
  module.def("verify", verify_volume, "volume"_a, "points"_a, py::kw_only(), "threads"_a = 1, verify_doc);
}

}  // namespace pcl_bv::python
