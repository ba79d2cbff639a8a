// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Pickling of results. The state includes the frame's points, because the picture of a result shows them.

#include "result_state.h"

#include "config_dict.h"
#include "state.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

template <typename T>
py::array_t<T> array(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}
template <typename T>
std::vector<T> vector(const py::object& values) {
  const auto numbers = py::array_t<T, py::array::c_style>(values);
  return {numbers.data(), numbers.data() + numbers.size()};
}

py::tuple counts(const Counts& c) {
  return py::make_tuple(c.nonfinite, c.range, c.ground, c.small, c.large, c.noise, c.inside, c.dropped_class,
                        c.cut, c.joined);
}
Counts counts(const py::tuple& t) {
  const auto n = [&](std::size_t i) { return t[i].cast<std::size_t>(); };
  return {n(0), n(1), n(2), n(3), n(4), n(5), n(6), n(7), n(8), n(9)};
}

py::array_t<std::uint8_t> refinements(const std::vector<Refinement>& all) {
  std::vector<std::uint8_t> numbers;
  numbers.reserve(all.size());
  for (const Refinement each : all)
    numbers.push_back(static_cast<std::uint8_t>(each));
  return array(numbers);
}
std::vector<Refinement> refinements(const py::object& state) {
  std::vector<Refinement> all;
  for (const std::uint8_t number : vector<std::uint8_t>(state)) {
    if (number > static_cast<std::uint8_t>(Refinement::joined))
      throw py::value_error("a refinement is 0, 1 or 2");
    all.push_back(static_cast<Refinement>(number));
  }
  return all;
}

py::tuple times(const StageTimes& ms) {
  return py::make_tuple(ms.decode, ms.filter, ms.ground, ms.cluster, ms.fit, ms.track, ms.total);
}
StageTimes times(const py::tuple& t) {
  const auto n = [&](std::size_t i) { return t[i].cast<double>(); };
  return {n(0), n(1), n(2), n(3), n(4), n(5), n(6)};
}

py::object track(const std::optional<TrackEntry>& t) {
  if (!t) return py::none();
  return py::make_tuple(t->id, t->age, array_of(t->velocity), t->moving,
                        py::array_t<double>(4, t->pose.data()),
                        py::array_t<double>(21, t->covariance.data()));
}
std::optional<TrackEntry> track(py::handle state) {
  if (state.is_none()) return {};
  const py::tuple t = tuple_of_state(state, 6);
  TrackEntry entry{t[0].cast<std::uint32_t>(), t[1].cast<std::size_t>()};
  entry.velocity = vector3(t[2], "velocity");
  entry.moving = t[3].cast<bool>();
  const std::vector<double> pose = vector<double>(t[4]), covariance = vector<double>(t[5]);
  if (pose.size() != entry.pose.size() || covariance.size() != entry.covariance.size())
    throw py::value_error("a track has a pose of 4 numbers and a covariance of 21");
  std::copy(pose.begin(), pose.end(), entry.pose.begin());
  std::copy(covariance.begin(), covariance.end(), entry.covariance.begin());
  return entry;
}

/// Returns a list with one element for each element of result.volumes. A requested volume becomes an object
/// with the volume and the result of its fit. A volume that was not requested becomes None.
py::list volumes(const FrameResult& result) {
  py::list list(result.volumes.size());
  for (std::size_t i = 0; i < result.volumes.size(); ++i) {
    const std::size_t m = i % result.methods.size();
    if (result.is_requested(i / result.methods.size(), m)) {
      list[i] = to_python(AnyVolume(result.volumes[i]), result.methods[m], result.results[i]);
    } else {
      list[i] = py::none();
    }
  }
  return list;
}

/// Returns how the points were moved, and the moved points; None if they were not moved.
py::object deskew(const ResultObject& self) {
  if (!self.result.deskew.moved()) return py::none();
  const PointView& points = self.result.deskew.points;
  const py::dtype type =
      points.scalar == ScalarType::float32 ? py::dtype::of<float>() : py::dtype::of<double>();
  const auto count = static_cast<py::ssize_t>(points.count);
  return py::make_tuple(self.result.deskew.outcome == DeskewOutcome::by_poses ? "poses" : "tracks",
                        py::array(type, {count, py::ssize_t{3}}, self.deskewed.data()));
}
void take_deskew(py::handle state, ResultObject& self) {
  if (state.is_none()) return;
  const py::tuple t = tuple_of_state(state, 2);
  const std::string how = text(t[0], "deskew");
  if (how != "poses" && how != "tracks") throw py::value_error("deskew is not 'poses' or 'tracks'");
  const PointArray moved = points_of(t[1], "deskewed");
  const bool packed = moved.view.stride == 3 * size_of(moved.view.scalar);
  if (moved.view.count != self.points.view.count || (!packed && moved.view.count > 0) ||
      moved.view.scalar != self.points.view.scalar)
    throw py::value_error("the moved points are not those of the frame");
  static constexpr TimeUnit kSeconds{"s", 1};  // says that points were moved within their sweep
  self.result.deskew.times.unit = &kSeconds;
  self.result.deskew.outcome = how == "poses" ? DeskewOutcome::by_poses : DeskewOutcome::by_tracks;
  self.own_deskewed_points(moved.view);
}

/// Throws if the members of an unpickled result are inconsistent.
void require_consistent(const FrameResult& result, std::size_t points) {
  const Clusters& c = result.clusters;
  const auto in_cloud = [&](const std::vector<std::int32_t>& list) {
    return std::all_of(list.begin(), list.end(),
                       [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < points; });
  };
  const bool consistent =
      result.points == points && !c.offsets.empty() && c.offsets.front() == 0 &&
      (c.size() <= 1 || !c.indices.empty() || c.offsets.back() == 0) &&
      std::is_sorted(c.offsets.begin(), c.offsets.end()) &&
      (c.indices.empty() || c.offsets.back() == c.indices.size()) && c.offsets.back() <= points &&
      in_cloud(c.indices) && in_cloud(result.passed_filter) && in_cloud(result.ground.ground) &&
      in_cloud(result.ground.rest) && (result.tracks.empty() || result.tracks.size() == c.size()) &&
      (result.class_of.empty() || result.class_of.size() == c.size()) &&
      (result.refinements.empty() || result.refinements.size() == c.size()) &&
      result.volumes.size() == c.size() * result.methods.size();
  if (!consistent) throw py::value_error("the state is inconsistent");
}

void take_volumes(const py::list& state, FrameResult& result) {
  for (const py::handle each : state) {
    result.requested.push_back(each.is_none() ? 0 : 1);
    if (each.is_none()) {
      result.volumes.emplace_back();
      result.results.emplace_back();
    } else {
      const VolumeObject& volume = volume_of(each, "volumes");
      result.volumes.push_back(volume.value);
      result.results.push_back(volume.fit);
    }
  }
}

/// Returns the indices of the points that passed the filter. If the pipeline has made no index list, these
/// are the points of cluster 0.
std::vector<std::int32_t> kept(const ResultObject& self) {
  if (!self.result.filtered) return self.result.passed_filter;
  const std::vector<std::uint32_t> labels = labels_of(self.frame(), self.result);
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0) numbers.push_back(static_cast<std::int32_t>(i));
  }
  return numbers;
}

}  // namespace

py::dict state_of_result(const std::shared_ptr<ResultObject>& self) {
  const FrameResult& r = self->result;
  py::dict state;
  state["header"] = py::make_tuple(r.header.seq, r.header.stamp_ns, r.header.frame_id, r.header.number);
  state["config"] = dict_of(*r.config);
  state["points"] = self->points.owner;
  state["pose"] = self->pose ? py::object(array_of(Eigen::MatrixXd(self->pose->matrix()))) : py::none();
  state["deskew"] = deskew(*self);
  state["counts"] = counts(r.counts);
  state["kept"] = array(kept(*self));
  const GroundSplit& g = r.ground;
  state["ground"] = py::make_tuple(g.found, array_of(g.normal), g.offset, array(g.ground), array(g.rest));
  state["clusters"] = py::make_tuple(array(r.clusters.indices), array(r.clusters.offsets), array(r.class_of),
                                     refinements(r.refinements));
  py::list names, tracks;
  for (const Method* method : r.methods)
    names.append(std::string(method->name));
  for (const auto& each : r.tracks)
    tracks.append(track(each));
  state["tracks"] = tracks;
  state["methods"] = names;
  state["volumes"] = volumes(r);
  state["ms"] = times(r.ms);
  return state;
}

std::shared_ptr<ResultObject> result_of_state(py::handle given) {
  if (!py::isinstance<py::dict>(given)) throw py::value_error("the state is not a dict");
  const auto state = py::reinterpret_borrow<py::dict>(given);
  auto self = std::make_shared<ResultObject>();
  FrameResult& r = self->result;
  self->points = points_of(state["points"]);
  if (!state["pose"].is_none()) self->pose = Pose(isometry(state["pose"], "pose").matrix());
  take_deskew(state["deskew"], *self);
  const py::tuple header = tuple_of_state(state["header"], 4), ground = tuple_of_state(state["ground"], 5),
                  clusters = tuple_of_state(state["clusters"], 4);
  r.header = {header[0].cast<std::uint64_t>(), header[1].cast<std::int64_t>(), text(header[2], "frame_id"),
              header[3].cast<std::uint64_t>()};
  if (!py::isinstance<py::dict>(state["config"])) throw py::value_error("the settings are not a dict");
  r.config = std::make_shared<PipelineConfig>(config_of(state["config"], py::none(), {}));
  r.points = self->points.view.count;
  r.counts = counts(tuple_of_state(state["counts"], 10));
  r.passed_filter = vector<std::int32_t>(state["kept"]);
  r.ground.found = ground[0].cast<bool>();
  r.ground.normal = vector3(ground[1], "normal");
  r.ground.offset = ground[2].cast<double>();
  r.ground.ground = vector<std::int32_t>(ground[3]);
  r.ground.rest = vector<std::int32_t>(ground[4]);
  r.clusters.indices = vector<std::int32_t>(clusters[0]);
  r.clusters.offsets = vector<std::size_t>(clusters[1]);
  r.class_of = vector<std::int64_t>(clusters[2]);
  r.refinements = refinements(clusters[3]);
  for (const py::handle each : py::list(state["tracks"]))
    r.tracks.push_back(track(each));
  for (const py::handle name : py::list(state["methods"]))
    r.methods.push_back(method_of(name));
  take_volumes(state["volumes"], r);
  r.ms = times(tuple_of_state(state["ms"], 7));
  require_consistent(r, self->points.view.count);
  return self;
}

}  // namespace pcl_bv::python
