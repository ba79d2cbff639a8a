// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <mutex>
#include <optional>

#include "bind.h"
#include "config_dict.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/frame_result.h"
#include "result_object.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

/// A pipeline that several threads may call. Frames are processed one after another.
class PipelineObject {
 public:
  explicit PipelineObject(PipelineConfig config) : pipeline_(std::move(config)) {}

  /// Processes a frame with the number `seq` or, without it, the next number. Returns the warnings that this
  /// pipeline has not given before.
  std::vector<std::string> process(Frame& frame, std::optional<std::uint64_t> seq, ResultObject& object) {
    const std::lock_guard lock(mutex_);
    FrameResult& result = object.result;
    frame.header.seq = seq.value_or(next_);
    next_ = frame.header.seq + 1;
    pipeline_.process(frame, result);
    object.own_deskewed_points();
    std::vector<std::string> warnings = result.warnings;
    if (frame.times && result.config->deskew == Deskew::off && !std::exchange(warned_of_times_, true))
      warnings.emplace_back("times have no effect, because the setting deskew is 'off'");
    return warnings;
  }
  PipelineConfig config() const { return pipeline_.config(); }
  void set_config(PipelineConfig config) { pipeline_.set_config(std::move(config)); }

 private:
  std::mutex mutex_;
  FramePipeline pipeline_;
  std::uint64_t next_ = 0;
  bool warned_of_times_ = false;
};

void warn_about_ineffective_settings(const PipelineConfig& config) {
  for (const std::string& line : config.ineffective_settings())
    warn(line);
}

std::unique_ptr<PipelineObject> make_pipeline(py::handle config, py::handle preset,
                                              const py::kwargs& settings) {
  PipelineConfig read = config_of(config, preset, settings);
  warn_about_ineffective_settings(read);
  return std::make_unique<PipelineObject>(std::move(read));
}

std::shared_ptr<ResultObject> process_frame(PipelineObject& self, py::handle points, py::handle stamp_ns,
                                            py::handle frame_id, py::handle seq, py::handle pose,
                                            py::handle times, py::handle classes, py::handle recorded_ns) {
  auto result = std::make_shared<ResultObject>();
  result->points = points_of(points);
  if (!pose.is_none()) result->pose = Pose(isometry(pose, "pose").matrix());
  Frame frame = result->frame();
  frame.header.stamp_ns = signed_number(stamp_ns, "stamp_ns");
  frame.recorded_ns = signed_number(recorded_ns, "recorded_ns");
  frame.header.frame_id = text(frame_id, "frame_id");
  std::optional<std::uint64_t> number;
  if (!seq.is_none()) number = whole_number(seq, "seq", {0, kNoLimit});
  if (!classes.is_none())
    frame.classes =
        std::make_shared<std::vector<std::int64_t>>(integers(classes, "classes", result->points.view.count));
  py::array_t<double> seconds;  // outlives the call without the GIL
  if (!times.is_none()) {
    seconds = point_times(times, "times", result->points.view);
    frame.times = FieldView{reinterpret_cast<const std::byte*>(seconds.data()), sizeof(double), 'F',
                            static_cast<std::uint32_t>(sizeof(double))};
  }
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release unlocked;
    warnings = self.process(frame, number, *result);
  }
  for (const std::string& text : warnings)
    warn(text);
  return result;
}

void set_config(PipelineObject& self, py::handle config) {
  PipelineConfig read = config_of(config, py::none(), {});
  warn_about_ineffective_settings(read);
  const py::gil_scoped_release unlocked;
  self.set_config(std::move(read));
}

std::string repr_of_pipeline(const PipelineObject& self) {
  const PipelineConfig config = self.config();
  std::string methods;
  for (const Method* method : config.methods())
    methods.append(methods.empty() ? "" : ", ").append(method->name);
  return "Pipeline(ground " + to_text(config.ground.method) + ", cluster " +
         to_text(config.cluster.tolerance) + ", volumes " + methods +
         (config.track.enabled ? ", tracked)" : ")");
}

const std::string& pipeline_doc() {
  static const std::string* const doc = new std::string(
      R"(Pipeline(config=None, *, preset=None, **settings)
--

Detects objects frame by frame, as bv_stream and pcd_bv do: filter, ground, clusters, volumes, tracks.

config: a dict, the text of a configuration file, or the path of a configuration file. The keys are those
    below, nested by stage. In a dict, a region may have 'volumes' (a list of volumes) instead of a 'file'.
preset: 'road' (the defaults), 'indoor' or 'table'. config overrides it.
settings: stages as keyword arguments, which override config: cluster={'tolerance': 0.3}, volumes=['obb-yaw'],
    threads=0.

Raises ValueError with key, value and range for an unknown key or a value that is not allowed, and OSError
for a file that cannot be read. Warns (UserWarning) about a setting that has no effect. Threads may share a
pipeline. It processes one frame at a time.

Settings, with defaults, [units] and ranges:
)" + settings_text() +
      R"(
>>> import pcl_bv
>>> pipeline = pcl_bv.Pipeline(cluster={'tolerance': 0.5, 'min_size': 30}, volumes=['obb-yaw'])
>>> pipeline.process(pcl_bv.read('synth:street:20000:1')).clusters[0].volumes[0].method
'obb-yaw'
>>> pcl_bv.Pipeline(cluster={'tolerance': -1})
Traceback (most recent call last):
ValueError: cluster.tolerance: -1 is not at least 0 and at most 1e+06
)");
  return *doc;
}

constexpr const char* process_doc =
    R"(process(self, points, *, stamp_ns=0, frame_id='', seq=None, pose=None, times=None, classes=None, recorded_ns=0)
--

Processes one frame. Frames of a stream must be passed in the order of their stamps. Releases the GIL.

points: as for fit(), in the sensor's frame, metres. They are not copied. The result keeps the array alive.
    Later changes of the array appear in the result's pictures.
stamp_ns: time at which the sensor took the frame, nanoseconds. Tracking needs it: without it, speeds are 0. If
    it goes back by more than a second, tracks begin anew. Their ids are not reused.
frame_id, seq: stored in the result. Without seq, the pipeline counts the frames.
pose: pose of the sensor in a fixed frame, 4 x 4, for tracks over the ground.
times: time at which each point was measured, for the setting deskew. Seconds, milliseconds, microseconds or
    nanoseconds (the unit is found from the span, a sweep of 1 ms to 1 s), after stamp_ns or since 1970. Floats
    or integers, any shape. Only points that are not finite may have a time that is not finite.
classes: an integer for each point, for cluster.class_field and cluster.classes.
recorded_ns: time at which the frame was recorded or received, nanoseconds; 0 if unknown. Tracking uses it if
    the stamps do not advance.

Returns a Result. Raises errors as fit() does. Raises ValueError if the number of times is not that of the
points. Warns (UserWarning, each kind once per pipeline and setting) if no ground is found, if everything is
ground, if the points do not lie around the sensor, if stamps of tracked frames do not advance, go back or advance
by more than a second, and if deskew is 'on' but points could not be moved.

>>> import pcl_bv
>>> pipeline = pcl_bv.Pipeline(track={'enabled': True, 'birth': 1})
>>> frame = pipeline.process(pcl_bv.read('synth:street:20000:1'), stamp_ns=100_000_000)
>>> frame.stamp_ns, frame.clusters[0].track.age
(100000000, 1)

Points of a sensor that moves at 10 m/s, as they would have been measured at the stamp:

>>> import numpy
>>> points = numpy.tile([[5.0, 0, 0]], (1000, 1))
>>> pipeline = pcl_bv.Pipeline(deskew='on', ground={'method': 'none'})
>>> for frame in range(2):
...     pose = numpy.eye(4)
...     pose[0, 3] = frame
...     result = pipeline.process(points, stamp_ns=frame * 100_000_000, pose=pose,
...                               times=numpy.linspace(0, 0.1, 1000))
>>> result.deskew, float(result.deskewed[-1, 0].round(6))
('poses', 6.0)
)";

}  // namespace

void bind_pipeline(py::module_& module) {
  py::class_<PipelineObject>(module, "Pipeline", pipeline_doc().c_str())
      .def(py::init(&make_pipeline), "config"_a = py::none(), py::kw_only(), "preset"_a = py::none(),
           init_doc(pipeline_doc()).c_str())
      .def("process", process_frame, "points"_a, py::kw_only(), "stamp_ns"_a = 0, "frame_id"_a = "",
           "seq"_a = py::none(), "pose"_a = py::none(), "times"_a = py::none(), "classes"_a = py::none(),
           "recorded_ns"_a = 0, process_doc)
      .def_property(
          "config", [](const PipelineObject& p) { return dict_of(p.config()); }, set_config,
          "All settings as a dict that Pipeline() accepts. Assigning a dict takes effect with the next "
          "frame.")
      .def("__repr__", repr_of_pipeline);
}

}  // namespace pcl_bv::python
