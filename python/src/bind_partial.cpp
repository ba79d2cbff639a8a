// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Python's Partial and RegionMask.

#include "pcl_bv/fitting/partial.h"

#include "bind.h"
#include "pcl_bv/trees/region_mask.h"
#include "state.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

Partial make_partial(py::handle points, py::handle first, py::handle threads) {
  const std::size_t begin = whole_number(first, "first", {0, kNoLimit});
  const Execution execution = execution_of(threads, py::none());
  if (points.is_none()) return Partial();
  const PointArray array = points_of(points);
  const py::gil_scoped_release unlocked;
  return Partial(array.view, begin, execution);
}

Partial merged(const Partial& a, const Partial& b) {
  const py::gil_scoped_release unlocked;
  Partial both = a;
  both.merge(b);
  return both;
}

py::object fit_partial(const Partial& partial, py::handle names, py::handle up, py::handle threads) {
  bool single = false;
  const std::vector<const Method*> methods = methods_of(names, single);
  const Execution execution = execution_of(threads, py::none());
  const MethodOptions options{SphereGrowth::deferred, up_argument(up)};
  std::vector<Fitted<AnyVolume>> fitted(methods.size());
  {
    const py::gil_scoped_release unlocked;
    for (std::size_t m = 0; m < methods.size(); ++m)
      fitted[m] = partial.fit(*methods[m], options, execution);
  }
  if (single) return to_python(std::move(fitted[0].volume), methods[0], fitted[0]);
  py::list list(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m)
    list[m] = to_python(std::move(fitted[m].volume), methods[m], fitted[m]);
  return list;
}

py::bytes bytes_of(const Partial& partial) {
  const std::vector<std::byte> bytes = partial.to_bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Partial from_bytes(py::handle bytes) {
  if (!PyBytes_Check(bytes.ptr())) raise_type_error("bytes", "the bytes of to_bytes()", bytes);
  const std::string_view content = py::reinterpret_borrow<py::bytes>(bytes);
  return Partial::from_bytes(reinterpret_cast<const std::byte*>(content.data()), content.size());
}

RegionMask make_mask(py::handle volumes, py::handle padding) {
  const double inflation = number(padding, "padding", {0, 1e100});
  std::vector<Region> regions;
  for (const LabelledVolume& each : volumes_of(volumes, "volumes"))
    regions.push_back({each.volume->value, inflation});
  return RegionMask(regions);
}

py::object mask_contains(const RegionMask& mask, py::handle points, py::handle threads) {
  const PointArray array = points_of(points);
  const Execution execution = execution_of(threads, py::none());
  std::vector<std::uint8_t> inside;
  {
    const py::gil_scoped_release unlocked;
    mask.mark(array.view, inside, execution);
  }
  return array_from_vector(std::move(inside)).attr("view")("bool");
}

constexpr const char* partial_doc = R"(Partial(points=None, first=0, *, threads=1)
--

A partial result of a part of a cloud. The volumes of the whole cloud are fitted from the merged partial
results of its parts. A Partial has a few kilobytes and serves for clouds in many files or on many machines.
It is immutable and can be pickled.

points: as for fit(). None: no points, as start value of a sum.
first: the index of the part's first point in the whole cloud. No point may be in two parts.

The volumes do not depend on the parts or on the order of merging, to the last bit. The volumes equal those of
a fit of the whole cloud, except for the last bits of sphere-exact and obb-yaw of more than 4096 points.

>>> import functools, numpy, operator, pcl_bv
>>> points = numpy.random.default_rng(1).normal(size=(9000, 3))
>>> parts = [pcl_bv.Partial(points[i:i + 3000], first=i) for i in (0, 3000, 6000)]
>>> whole = functools.reduce(operator.add, parts)
>>> whole.fit('dop26') == pcl_bv.fit(points, 'dop26')
True
)";

constexpr const char* partial_merge_doc = R"(merge(self, other, /)
--

Returns the partial result of the points of self and other, as self + other does. Neither argument changes.

Raises ValueError if a point is in both, or if the points of one are float32 and those of the other float64.

>>> import pcl_bv
>>> len(pcl_bv.Partial([[0., 0, 0]]).merge(pcl_bv.Partial([[1., 1, 1]], first=1)))
2
)";

constexpr const char* partial_fit_doc = R"(fit(self, method, *, up='z', threads=1)
--

Returns the volume of all points, or a list of volumes for a list of methods, as pcl_bv.fit() does.

Raises ValueError for methods that need all points: sphere-ritter, sphere-epos* and obb-lshape.

>>> import pcl_bv
>>> pcl_bv.Partial([[0., 0, 0], [2, 2, 2]]).fit('aabb').max
array([2., 2., 2.])
)";

constexpr const char* to_bytes_doc = R"(to_bytes(self, /)
--

Returns bytes for a file or a message: about 2 kB, and 32 bytes per stored point. They are the same on every
machine.

>>> import pcl_bv
>>> part = pcl_bv.Partial([[0., 0, 0], [2, 2, 2]])
>>> pcl_bv.Partial.from_bytes(part.to_bytes()).fit('aabb') == part.fit('aabb')
True
)";

constexpr const char* from_bytes_doc = R"(from_bytes(bytes, /)
--

Restores a Partial from the bytes of to_bytes(). Raises ValueError with the reason for any other bytes.

>>> import pcl_bv
>>> len(pcl_bv.Partial.from_bytes(pcl_bv.Partial([[0., 0, 0]]).to_bytes()))
1
)";

constexpr const char* mask_doc = R"(RegionMask(volumes, padding=0)
--

Tests points against volumes that are inflated by `padding` (in the points' unit), for example a robot's links
or a region of interest.

volumes: a volume, a list of volumes, or a dict of volumes or lists, as returned by fit().

>>> import pcl_bv
>>> links = pcl_bv.RegionMask([pcl_bv.Sphere([0, 0, 0], 1), pcl_bv.Sphere([5, 0, 0], 1)], padding=0.5)
>>> links.contains([[0., 0, 1.4], [3, 0, 0]])
array([ True, False])
)";

constexpr const char* mask_contains_doc = R"(contains(self, points, *, threads=1)
--

Returns an array of bool: whether each point is inside any of the volumes. points: as for fit().

>>> import pcl_bv
>>> pcl_bv.RegionMask(pcl_bv.Sphere([0, 0, 0], 1)).contains([[0., 0, 1], [0, 0, 2]])
array([ True, False])
)";

}  // namespace

void bind_partial(py::module_& module) {
  py::class_<Partial>(module, "Partial", partial_doc)
      .def(py::init(&make_partial), "points"_a = py::none(), "first"_a = 0, py::kw_only(), "threads"_a = 1,
           init_doc(partial_doc).c_str())
      .def(
          "merge",
          [](const Partial& a, py::handle other) {
            if (!py::isinstance<Partial>(other)) raise_type_error("other", "a Partial", other);
            return merged(a, other.cast<const Partial&>());
          },
          "other"_a, py::pos_only(), partial_merge_doc)
      .def("__add__", merged, py::is_operator())
      .def("fit", fit_partial, "method"_a, py::kw_only(), "up"_a = "z", "threads"_a = 1, partial_fit_doc)
      .def("to_bytes", bytes_of, to_bytes_doc)
      .def_static("from_bytes", from_bytes, "bytes"_a, py::pos_only(), from_bytes_doc)
      .def("__len__", &Partial::size)
      .def("__repr__", [](const Partial& p) { return "Partial(of " + std::to_string(p.size()) + " points)"; })
      .def(py::pickle([](const Partial& p) -> py::object { return bytes_of(p); },
                      [](const py::object& state) {
                        return restore_from_state("Partial", [&] { return from_bytes(state); });
                      }));
  py::class_<RegionMask>(module, "RegionMask", mask_doc)
      .def(py::init(&make_mask), "volumes"_a, "padding"_a = 0, init_doc(mask_doc).c_str())
      .def("contains", mask_contains, "points"_a, py::kw_only(), "threads"_a = 1, mask_contains_doc);
}

}  // namespace pcl_bv::python
