// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Defines a Python class for each shape. The properties of the class have the same names as in files.

#include "bind.h"
#include "read_shapes.h"
#include "state.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

template <typename Shape>
ShapeObject<Shape> object_of(Shape shape) {
  ShapeObject<Shape> object;
  object.value = std::move(shape);
  return object;
}

/// Defines the class of a shape. `make` is the constructor. Pickling stores the arguments of the constructor.
template <typename Shape, typename Make>
py::class_<ShapeObject<Shape>, VolumeObject> bind(py::module_& module, const char* name, const char* doc,
                                                  Make make) {
  py::class_<ShapeObject<Shape>, VolumeObject> type(module, name, doc);
  type.def(py::pickle(
      [](const ShapeObject<Shape>& v) -> py::object {
        return py::make_tuple(arguments_of(v.shape()), fit_state(v));
      },
      [make, name](const py::object& state) {
        return restore_from_state(name, [&] {
          const py::tuple parts = tuple_of_state(state, 2);
          ShapeObject<Shape> object = object_of(make(tuple_of_state(parts[0], arguments_of(Shape()).size())));
          set_fit_state(parts[1], object);
          return object;
        });
      }));
  return type;
}

/// Defines a property for an argument of the constructor. `i` is the index of the argument in arguments_of().
template <typename Shape, typename Class>
void property(Class& type, const char* name, std::size_t i, const char* doc) {
  type.def_property_readonly(
      name, [i](const ShapeObject<Shape>& v) { return py::object(arguments_of(v.shape())[i]); }, doc);
}

/// Returns the shape of an argument. The argument must be of the class of `Shape`.
template <typename Shape>
const Shape& same_shape(py::handle other) {
  if (!py::isinstance<ShapeObject<Shape>>(other))
    raise_type_error("other", "a volume of the same class", other);
  return other.cast<const ShapeObject<Shape>&>().shape();
}

/// Defines overlaps() and merge().
template <typename Shape, typename Class>
void bind_merging(Class& type) {
  type.def(
      "overlaps",
      [](const ShapeObject<Shape>& a, py::handle b) { return a.shape().overlaps(same_shape<Shape>(b)); },
      "other"_a, py::pos_only(), overlaps_doc);
  type.def(
      "merge",
      [](const ShapeObject<Shape>& a, py::handle b) {
        if constexpr (std::is_same_v<Shape, Obb>) {
          return object_of(a.shape().merged(same_shape<Shape>(b)));
        } else {
          return object_of(Shape(a.shape()).merge(same_shape<Shape>(b)));
        }
      },
      "other"_a, py::pos_only(), merge_doc);
}

template <typename Shape, typename Class>
void bind_extend(Class& type) {
  type.def(
      "extend",
      [](const ShapeObject<Shape>& v, py::handle points) {
        const py::array_t<double> numbers = doubles(points, "points");
        if (numbers.ndim() == 1 && numbers.size() == 0) return object_of(Shape(v.shape()));
        if (numbers.size() % 3 != 0 || numbers.ndim() > 2 || numbers.shape(numbers.ndim() - 1) != 3)
          raise_value_error("points", "expected (3,) or (N, 3) numbers, got " + repr_text(points));
        Shape extended = v.shape();
        for (py::ssize_t i = 0; i < numbers.size(); i += 3)
          extended.extend(Eigen::Map<const Eigen::Vector3d>(numbers.data() + i));
        return object_of(std::move(extended));
      },
      "points"_a, py::pos_only(), extend_doc);
}

void bind_boxes(py::module_& module) {
  auto aabb = bind<Aabb>(module, "Aabb", aabb_doc, [](const py::tuple& a) { return make_aabb(a[0], a[1]); });
  aabb.def(py::init([](py::handle min, py::handle max) { return object_of(make_aabb(min, max)); }), "min"_a,
           "max"_a, init_doc(aabb_doc).c_str());
  property<Aabb>(aabb, "min", 0, "The lower corner.");
  property<Aabb>(aabb, "max", 1, "The upper corner.");
  bind_merging<Aabb>(aabb);
  bind_extend<Aabb>(aabb);

  auto obb = bind<Obb>(module, "Obb", obb_doc, [](const py::tuple& a) { return make_obb(a[0], a[1], a[2]); });
  obb.def(py::init([](py::handle center, py::handle axes, py::handle half_extents) {
            return object_of(make_obb(center, axes, half_extents));
          }),
          "center"_a, "axes"_a, "half_extents"_a, init_doc(obb_doc).c_str());
  property<Obb>(obb, "axes", 1, "(3, 3): axes[i] is a unit vector.");
  property<Obb>(obb, "half_extents", 2, "Half the size along each axis.");
  obb.def_property_readonly(
      "quaternion",
      [](const ShapeObject<Obb>& v) {
        return array_of(Eigen::MatrixXd(v.shape().quaternion().coeffs())).attr("ravel")();
      },
      "x, y, z, w of the rotation from the box's axes to the frame.");
  obb.def_property_readonly(
      "pose", [](const ShapeObject<Obb>& v) { return array_of(Eigen::MatrixXd(v.shape().pose().matrix())); },
      "(4, 4): from the box's own coordinates to the frame.");
  obb.def_property_readonly(
      "yaw", [](const ShapeObject<Obb>& v) { return v.shape().yaw(); },
      "Rotation of axes[0] about axes[2] from x, in radians, -pi (exclusive) to pi: the heading of an "
      "upright\n"
      "box; from y where axes[2] is less than 45 degrees from x. NaN if empty.");
  bind_merging<Obb>(obb);
}

void bind_slabs(py::module_& module) {
  auto kdop =
      bind<Kdop>(module, "Kdop", kdop_doc, [](const py::tuple& a) { return make_kdop(a[0], a[1], a[2]); });
  kdop.def(py::init([](py::handle directions, py::handle min, py::handle max) {
             return object_of(make_kdop(directions, min, max));
           }),
           "directions"_a, "min"_a, "max"_a, init_doc(kdop_doc).c_str());
  property<Kdop>(kdop, "directions", 0, "(n, 3): directions of the slabs, not of unit length.");
  property<Kdop>(kdop, "min", 1, "(n,): the minimum of directions[i] . p in each slab.");
  property<Kdop>(kdop, "max", 2, "(n,): the maximum of directions[i] . p in each slab.");
  kdop.def(
      "tightened", [](const ShapeObject<Kdop>& v) { return object_of(v.shape().tightened()); },
      tightened_doc);
  bind_merging<Kdop>(kdop);
  bind_extend<Kdop>(kdop);

  auto hull = bind<Hull>(module, "Hull", hull_doc,
                         [](const py::tuple& a) { return make_hull(a[0], a[1], a[2], a[3]); });
  hull.def(py::init([](py::handle vertices, py::handle faces, py::handle planes, py::handle rank) {
             return object_of(make_hull(vertices, faces, planes, rank));
           }),
           "vertices"_a, "faces"_a, "planes"_a, "rank"_a = 3, init_doc(hull_doc).c_str());
  property<Hull>(hull, "vertices", 0, "(V, 3): the extreme points.");
  property<Hull>(hull, "faces", 1,
                 "(F, 3): vertex indices, counter-clockwise seen from outside; none if the hull is flat.");
  property<Hull>(hull, "planes", 2, "(P, 4): nx, ny, nz, d with n . p <= d for each point p of the hull.");
  property<Hull>(hull, "rank", 3, "Number of dimensions that the hull spans, 0 to 3.");
}

void bind_prism(py::module_& module) {
  auto prism = bind<Prism>(module, "Prism", prism_doc,
                           [](const py::tuple& a) { return make_prism(a[0], a[1], a[2], a[3]); });
  prism.def(py::init([](py::handle axes, py::handle outline, py::handle low, py::handle high) {
              return object_of(make_prism(axes, outline, low, high));
            }),
            "axes"_a, "outline"_a, "low"_a, "high"_a, init_doc(prism_doc).c_str());
  property<Prism>(prism, "axes", 0, "(3, 3): axes[0] and axes[1] span the plane, axes[2] is up.");
  property<Prism>(prism, "outline", 1, "(n, 2): corners along axes[0] and axes[1], counter-clockwise.");
  property<Prism>(prism, "low", 2, "Smallest height along axes[2]; infinity if empty.");
  property<Prism>(prism, "high", 3, "Largest height along axes[2]; -infinity if empty.");
  prism.def_property_readonly(
      "footprint_area", [](const ShapeObject<Prism>& v) { return v.shape().footprint_area(); },
      "Area of the outline.");
  prism.def_property_readonly(
      "is_convex", [](const ShapeObject<Prism>& v) { return v.shape().is_convex(); },
      "Whether the outline is convex.");
}

void bind_round(py::module_& module) {
  auto sphere =
      bind<Sphere>(module, "Sphere", sphere_doc, [](const py::tuple& a) { return make_sphere(a[0], a[1]); });
  sphere.def(
      py::init([](py::handle center, py::handle radius) { return object_of(make_sphere(center, radius)); }),
      "center"_a, "radius"_a, init_doc(sphere_doc).c_str());
  property<Sphere>(sphere, "radius", 1, "-1 if empty.");
  bind_merging<Sphere>(sphere);
  bind_extend<Sphere>(sphere);

  auto cylinder = bind<Cylinder>(module, "Cylinder", cylinder_doc,
                                 [](const py::tuple& a) { return make_cylinder(a[0], a[1], a[2], a[3]); });
  cylinder.def(py::init([](py::handle center, py::handle axis, py::handle radius, py::handle half_height) {
                 return object_of(make_cylinder(center, axis, radius, half_height));
               }),
               "center"_a, "axis"_a, "radius"_a, "half_height"_a, init_doc(cylinder_doc).c_str());
  property<Cylinder>(cylinder, "axis", 1, "A unit vector.");
  property<Cylinder>(cylinder, "radius", 2, "-1 if empty.");
  property<Cylinder>(cylinder, "half_height", 3, "Half the length along the axis.");

  auto capsule = bind<Capsule>(module, "Capsule", capsule_doc,
                               [](const py::tuple& a) { return make_capsule(a[0], a[1], a[2]); });
  capsule.def(py::init([](py::handle a, py::handle b, py::handle radius) {
                return object_of(make_capsule(a, b, radius));
              }),
              "a"_a, "b"_a, "radius"_a, init_doc(capsule_doc).c_str());
  property<Capsule>(capsule, "a", 0, "One end of the segment.");
  property<Capsule>(capsule, "b", 1, "Its other end.");
  property<Capsule>(capsule, "radius", 2, "-1 if empty.");

  auto ellipsoid = bind<Ellipsoid>(module, "Ellipsoid", ellipsoid_doc,
                                   [](const py::tuple& a) { return make_ellipsoid(a[0], a[1], a[2]); });
  ellipsoid.def(py::init([](py::handle center, py::handle axes, py::handle radii) {
                  return object_of(make_ellipsoid(center, axes, radii));
                }),
                "center"_a, "axes"_a, "radii"_a, init_doc(ellipsoid_doc).c_str());
  property<Ellipsoid>(ellipsoid, "axes", 1, "(3, 3): axes[i] is a unit vector.");
  property<Ellipsoid>(ellipsoid, "radii", 2, "Along each axis.");
}

}  // namespace

void bind_shapes(py::module_& module) {
  bind_boxes(module);
  bind_slabs(module);
  bind_prism(module);
  bind_round(module);
}

}  // namespace pcl_bv::python
