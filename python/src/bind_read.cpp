// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Input of clouds from files, recordings and generators.

#include <chrono>
#include <mutex>

#include "bind.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/report/read_volumes.h"
#include "pcl_bv/synth/synth.h"
#include "raw_cloud_array.h"
#include "read_docs.h"
#include "stream/sources/recorded_clouds.h"
#include "stream/sources/sources.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

/// Calls read(). If read() throws IoError because the file does not exist, raises FileNotFoundError. Throws
/// other IoErrors with the file's name in the message.
template <typename Read>
auto with_read_errors(const std::string& name, const Read& read) {
  try {
    return read();
  } catch (const IoError& error) {
    std::error_code unknown;
    const bool file = name.rfind("synth:", 0) != 0 && name.rfind("dds:", 0) != 0;
    if (file && !std::filesystem::exists(name, unknown)) {
      errno = ENOENT;
      PyErr_SetFromErrnoWithFilename(PyExc_FileNotFoundError, name.c_str());
      throw py::error_already_set();
    }
    throw IoError(std::string(error.what()).find(name) == std::string::npos ? name + ": " + error.what()
                                                                            : error.what());
  }
}

/// Issues a note about an input as a UserWarning. An empty note is ignored.
void warn_about_note(const std::string& name, const std::string& note) {
  if (!note.empty()) warn(name + ": " + note);
}

RawCloud load_recorded(const std::string& name, const std::string& topic, std::size_t number,
                       std::vector<std::string>& warnings) {
  RecordedClouds clouds(name, topic);
  try {
    RawCloud cloud = clouds.load(number);
    warnings = clouds.warnings();
    return cloud;
  } catch (const IoError& error) {
    // Adds the warnings: the damage that they report may be the reason of the error.
    std::string text = error.what();
    for (const std::string& warning : clouds.warnings())
      text.append("; ").append(warning);
    throw IoError(text);
  }
}

/// Loads a cloud. Sets `warnings` to the warnings about the recording.
RawCloud load_cloud(const std::string& name, const std::string& topic, std::size_t number,
                    std::size_t bin_fields, const Execution& execution, std::vector<std::string>& warnings) {
  if (name.rfind("synth:", 0) == 0) return to_raw_cloud(make_synth(parse_synth(name.substr(6))));
  if (has_recorded_clouds(name)) return load_recorded(name, topic, number, warnings);
  check_recording_content(name);
  return read_cloud(name, {bin_fields}, execution);
}

py::array read_points(py::handle file, py::handle topic, py::handle number, py::handle bin_fields,
                      py::handle threads) {
  const std::string name = path(file, "path").string();
  const std::string topic_name = topic.is_none() ? "" : text(topic, "topic");
  const std::size_t which = whole_number(number, "number", {0, kNoLimit});
  const std::size_t fields = whole_number(bin_fields, "bin_fields", {0, 32});
  const Execution execution(policy_of(threads), Isa::scalar);  // no kernel is used
  std::optional<RawCloud> cloud;
  std::vector<std::string> warnings;
  with_read_errors(name, [&] {
    const py::gil_scoped_release unlocked;
    cloud = load_cloud(name, topic_name, which, fields, execution, warnings);
  });
  for (const std::string& warning : warnings)
    warn_about_note(name, warning);
  warn_about_note(name, cloud->note);
  return array_of_cloud(std::move(*cloud));
}

py::list volumes_in(py::handle file) {
  const std::string name = path(file, "path").string();
  std::vector<AnyVolume> volumes;
  with_read_errors(name, [&] {
    const py::gil_scoped_release unlocked;
    volumes = read_volumes(name);
  });
  py::list list;
  for (AnyVolume& volume : volumes)
    list.append(to_python(std::move(volume)));
  return list;
}

/// A frame of a source. It owns its points.
struct FrameObject {
  Frame frame;
};

py::array points_of_frame(const FrameObject& object) {
  const PointView& view = object.frame.points;
  auto* const held = new std::shared_ptr<const void>(object.frame.owner);
  const py::capsule owner(held, [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  const auto size = static_cast<py::ssize_t>(size_of(view.scalar));
  return read_only(py::array(size == 8 ? py::dtype::of<double>() : py::dtype::of<float>(),
                             {static_cast<py::ssize_t>(view.count), py::ssize_t{3}},
                             {static_cast<py::ssize_t>(view.stride), size}, view.data, owner));
}

class FramesObject {
 public:
  FramesObject(const std::string& name, const ReplayOptions& options)
      : name_(name), source_(open_source(name, options)) {}

  /// Returns the next frame, or nothing at the end. While waiting for a frame, checks for Ctrl-C every 100
  /// ms. Issues the source's warnings as UserWarnings.
  std::optional<Frame> next() {
    for (;;) {
      Frame frame;
      Next what = Next::end;
      std::vector<std::string> warnings;
      {
        const py::gil_scoped_release unlocked;
        const std::lock_guard lock(mutex_);
        if (source_) what = source_->next(frame, std::chrono::milliseconds(100));
        if (source_) warnings = source_->take_warnings();
        if (what == Next::end) source_.reset();
      }
      for (const std::string& warning : warnings)
        warn_about_note(name_, warning);
      if (what == Next::frame) return frame;
      if (what == Next::end) return {};
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
  }

 private:
  std::mutex mutex_;
  std::string name_;
  std::unique_ptr<FrameSource> source_;
};

std::unique_ptr<FramesObject> open_frames(py::handle source, py::handle topic, py::handle rate,
                                          py::handle poses, py::handle class_field, py::handle frame_id,
                                          py::handle stamps, py::handle bin_fields) {
  const std::string name = path(source, "source").string();
  ReplayOptions options;
  if (!topic.is_none()) options.topic = text(topic, "topic");
  if (!rate.is_none()) options.rate_hz = number(rate, "rate", {kMinRate, kMaxRate});
  if (!poses.is_none()) options.poses = path(poses, "poses");
  if (!class_field.is_none()) options.class_field = text(class_field, "class_field");
  if (!frame_id.is_none()) options.frame_id = text(frame_id, "frame_id");
  options.bin_fields = whole_number(bin_fields, "bin_fields", {0, 32});
  const std::string times = text(stamps, "stamps");
  if (times != "auto" && times != "rate" && times != "name")
    raise_value_error("stamps", "'" + times + "' is not one of auto, rate, name");
  const bool recorded = source_kind(name).times == FrameTimes::messages;
  options.own_stamps = times == "name" || (times == "auto" && recorded && rate.is_none());
  std::unique_ptr<FramesObject> frames;
  with_read_errors(name, [&] {
    const py::gil_scoped_release unlocked;
    frames = std::make_unique<FramesObject>(name, options);
  });
  return frames;
}

py::object classes_of(const FrameObject& f) {
  if (!f.frame.classes) return py::none();
  const std::vector<std::int64_t>& classes = *f.frame.classes;
  return py::array_t<std::int64_t>(static_cast<py::ssize_t>(classes.size()), classes.data());
}

std::string repr_of_frame(const FrameObject& f) {
  return "Frame(seq=" + std::to_string(f.frame.header.seq) +
         ", stamp_ns=" + std::to_string(f.frame.header.stamp_ns) + ", " +
         std::to_string(f.frame.points.count) + " points)";
}

}  // namespace

void bind_read(py::module_& module) {
  using F = FrameObject;
  py::class_<F>(module, "Frame", frame_doc)
      .def_property_readonly("points", points_of_frame, "(N, 3), float32 or float64, not copied.")
      .def_property_readonly(
          "stamp_ns", [](const F& f) { return f.frame.header.stamp_ns; }, "Nanoseconds.")
      .def_property_readonly(
          "recorded_ns", [](const F& f) { return f.frame.recorded_ns; },
          "When it was recorded or sent, nanoseconds; 0 if unknown.")
      .def_property_readonly(
          "seq", [](const F& f) { return f.frame.header.seq; }, "Its index in the source.")
      .def_property_readonly(
          "frame_id", [](const F& f) { return f.frame.header.frame_id; },
          "The coordinate frame of its points.")
      .def_property_readonly(
          "file", [](const F& f) { return f.frame.file; },
          "The file of the frame; '' if it is not from a file.")
      .def_property_readonly("classes", classes_of,
                             "int64, one a point, if class_field was given; else None.")
      .def_property_readonly(
          "pose",
          [](const F& f) {
            return f.frame.pose ? py::object(array_of(Eigen::MatrixXd(f.frame.pose->matrix()))) : py::none();
          },
          "(4, 4), pose of the sensor in a fixed frame; None if unknown.")
      .def("__repr__", repr_of_frame);
  py::class_<FramesObject>(module, "Frames", frames_class_doc)
      .def("__iter__", [](FramesObject& self) { return py::cast(&self); })
      .def("__next__", [](FramesObject& self) {
        std::optional<Frame> frame = self.next();
        if (!frame) throw py::stop_iteration();
        warn_about_note(frame->file, frame->note);
        return FrameObject{std::move(*frame)};
      });
  module.def("read", read_points, "path"_a, py::kw_only(), "topic"_a = py::none(), "number"_a = 0,
             "bin_fields"_a = 0, "threads"_a = 1, read_doc);
  module.def("frames", open_frames, "source"_a, py::kw_only(), "topic"_a = py::none(), "rate"_a = py::none(),
             "poses"_a = py::none(), "class_field"_a = py::none(), "frame_id"_a = py::none(),
             "stamps"_a = "auto", "bin_fields"_a = 0, frames_doc);
  module.def("read_volumes", volumes_in, "path"_a, read_volumes_doc);
}

}  // namespace pcl_bv::python
