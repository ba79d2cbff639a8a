// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "volume_object.h"

#include "pcl_bv/io/number_text.h"
#include "state.h"

#include <mutex>
#include <set>

namespace pcl_bv::python {
using namespace detail;
namespace {

/// Returns a view of a copy of the text. The copy is never freed, because EstimationResult::reason does not
/// own its text.
std::string_view interned_text(const std::string& text) {
  static std::mutex mutex;
  static std::set<std::string>* const texts = new std::set<std::string>;
  const std::lock_guard lock(mutex);
  return *texts->insert(text).first;
}

void append(std::string& text, const char* name, double value) {
  text.append(text.empty() ? "" : ", ").append(name).append("=").append(general_text(value, 6));
}

void append(std::string& text, const char* name, const Eigen::Vector3d& v) {
  text.append(text.empty() ? "" : ", ").append(name).append("=").append(vector_text(v, 6));
}

/// Appends the parameters of a shape to a repr().
struct ReprText {
  std::string text{};

  void operator()(const Aabb& box) {
    append(text, "min", box.min());
    append(text, "max", box.max());
  }
  void operator()(const Kdop& kdop) {
    text = "k=" + std::to_string(2 * kdop.size());
    append(text, "volume", kdop.volume());
  }
  void operator()(const Sphere& sphere) {
    append(text, "center", sphere.center());
    append(text, "radius", sphere.radius());
  }
  void operator()(const Obb& box) {
    append(text, "center", box.center());
    append(text, "half_extents", box.half_extents());
  }
  void operator()(const Cylinder& cylinder) {
    append(text, "center", cylinder.center());
    append(text, "axis", cylinder.axis());
    append(text, "radius", cylinder.radius());
    append(text, "half_height", cylinder.half_height());
  }
  void operator()(const Capsule& capsule) {
    append(text, "a", capsule.a());
    append(text, "b", capsule.b());
    append(text, "radius", capsule.radius());
  }
  void operator()(const Ellipsoid& ellipsoid) {
    append(text, "center", ellipsoid.center());
    append(text, "radii", ellipsoid.radii());
  }
  void operator()(const Hull& hull) {
    text = "vertices=" + std::to_string(hull.vertices().size()) +
           ", faces=" + std::to_string(hull.triangles().size());
    append(text, "volume", hull.volume());
  }
  void operator()(const Prism& prism) {
    text = "corners=" + std::to_string(prism.outline().size());
    append(text, "low", prism.low());
    append(text, "high", prism.high());
    append(text, "footprint_area", prism.footprint_area());
  }
};

py::array slabs(const SlabVector& v) {
  return read_only(py::array_t<double>(v.size(), v.data()));
}

}  // namespace

py::object to_python(AnyVolume&& volume, const Method* method, const EstimationResult& fit) {
  return std::visit(
      [&](auto&& shape) -> py::object {
        ShapeObject<std::decay_t<decltype(shape)>> object;
        object.value = std::forward<decltype(shape)>(shape);
        object.method = method;
        object.fit = fit;
        return py::cast(std::move(object));
      },
      std::move(volume));
}

const VolumeObject& volume_of(py::handle value, const char* name) {
  if (!py::isinstance<VolumeObject>(value)) raise_type_error(name, "a volume", value);
  return value.cast<const VolumeObject&>();
}

std::vector<LabelledVolume> volumes_of(py::handle value, const char* name) {
  std::vector<LabelledVolume> found;
  const auto add = [&](std::int64_t number, py::handle of) {
    if (py::isinstance<py::list>(of) || py::isinstance<py::tuple>(of)) {
      for (const py::handle each : of)
        found.push_back({number, &volume_of(each, name)});
    } else {
      found.push_back({number, &volume_of(of, name)});
    }
  };
  if (value.is_none()) return found;
  if (!py::isinstance<py::dict>(value)) {
    add(0, value);
    return found;
  }
  for (const auto& [label, of] : py::reinterpret_borrow<py::dict>(value))
    add(static_cast<std::int64_t>(whole_number(label, name, {0, 4294967293})), of);
  return found;
}

const char* status_name(EstimationStatus status) {
  constexpr const char* names[] = {"ok", "degenerate", "no_valid_points", "failed"};
  return names[static_cast<std::size_t>(status)];
}

py::tuple arguments_of(const Aabb& box) {
  return py::make_tuple(array_of(box.min()), array_of(box.max()));
}
py::tuple arguments_of(const Kdop& kdop) {
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t i = 0; i < kdop.size(); ++i)
    directions.push_back(kdop.set()->direction(i));
  return py::make_tuple(array_of(directions), slabs(kdop.min()), slabs(kdop.max()));
}
py::tuple arguments_of(const Sphere& sphere) {
  return py::make_tuple(array_of(sphere.center()), sphere.radius());
}
py::tuple arguments_of(const Obb& box) {
  return py::make_tuple(array_of(box.center()), array_of(Eigen::MatrixXd(box.axes().transpose())),
                        array_of(box.half_extents()));
}
py::tuple arguments_of(const Cylinder& cylinder) {
  return py::make_tuple(array_of(cylinder.center()), array_of(cylinder.axis()), cylinder.radius(),
                        cylinder.half_height());
}
py::tuple arguments_of(const Capsule& capsule) {
  return py::make_tuple(array_of(capsule.a()), array_of(capsule.b()), capsule.radius());
}
py::tuple arguments_of(const Ellipsoid& ellipsoid) {
  return py::make_tuple(array_of(ellipsoid.center()), array_of(Eigen::MatrixXd(ellipsoid.axes().transpose())),
                        array_of(ellipsoid.radii()));
}
py::tuple arguments_of(const Hull& hull) {
  py::array_t<std::int32_t> faces({static_cast<py::ssize_t>(hull.triangles().size()), py::ssize_t{3}});
  if (!hull.triangles().empty())
    std::copy_n(hull.triangles().front().data(), 3 * hull.triangles().size(), faces.mutable_data());
  py::array_t<double> planes({static_cast<py::ssize_t>(hull.planes().size()), py::ssize_t{4}});
  double* next = planes.mutable_data();
  for (const HullPlane& plane : hull.planes()) {
    next = std::copy_n(plane.normal.data(), 3, next);
    *next++ = plane.offset;
  }
  return py::make_tuple(array_of(hull.vertices()), read_only(std::move(faces)), read_only(std::move(planes)),
                        hull.rank());
}

py::tuple arguments_of(const Prism& prism) {
  Eigen::MatrixXd outline(static_cast<Eigen::Index>(prism.outline().size()), 2);
  for (std::size_t i = 0; i < prism.outline().size(); ++i)
    outline.row(static_cast<Eigen::Index>(i)) = prism.outline()[i].transpose();
  return py::make_tuple(array_of(Eigen::MatrixXd(prism.axes().transpose())), array_of(outline), prism.low(),
                        prism.high());
}

py::tuple fit_state(const VolumeObject& volume) {
  if (volume.method == nullptr) return py::tuple();
  const EstimationResult& fit = volume.fit;
  return py::make_tuple(py::str(volume.method->name.data(), volume.method->name.size()),
                        static_cast<int>(fit.status), fit.rank, fit.used, fit.dropped,
                        py::str(fit.reason.data(), fit.reason.size()));
}

void set_fit_state(py::handle given, VolumeObject& volume) {
  if (py::isinstance<py::tuple>(given) && py::len(given) == 0) return;
  const py::tuple state = tuple_of_state(given, 6);
  volume.method = method_of(state[0]);
  volume.fit.status = static_cast<EstimationStatus>(whole_number(state[1], "status", {0, 3}));
  volume.fit.rank = static_cast<int>(whole_number(state[2], "rank", {0, 3}));
  volume.fit.used = whole_number(state[3], "used", {0, kNoLimit});
  volume.fit.dropped = whole_number(state[4], "dropped", {0, kNoLimit});
  const std::string reason = text(state[5], "reason");
  constexpr std::size_t longest = 200;  // a limit, because reasons are never freed
  if (reason.size() > longest) raise_value_error("reason", "is longer than 200 bytes");
  volume.fit.reason = interned_text(reason);
}

std::string vector_text(const Eigen::Vector3d& v, int digits) {
  return '[' + general_text(v.x(), digits) + ", " + general_text(v.y(), digits) + ", " +
         general_text(v.z(), digits) + ']';
}

std::string repr_of(const VolumeObject& volume) {
  std::string name(shape_name(volume.value));
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  ReprText repr;
  if (empty(volume.value)) {
    repr.text = "empty";
  } else {
    std::visit(repr, volume.value);
  }
  if (volume.method != nullptr) {
    repr.text.append(", method='").append(volume.method->name).append("'");
    repr.text.append(", used=").append(std::to_string(volume.fit.used));
    if (volume.fit.dropped > 0) repr.text.append(", dropped=").append(std::to_string(volume.fit.dropped));
    if (volume.fit.status != EstimationStatus::ok)
      repr.text.append(", status='").append(status_name(volume.fit.status)).append("'");
  }
  return name + '(' + repr.text + ')';
}

}  // namespace pcl_bv::python
