// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The module pcl_bv.gpu, in builds with the component gpu.

#include "arguments.h"
#include "arrays.h"
#include "bind.h"
#include "pcl_bv/gpu/gpu_fit.h"
#include "volume_object.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

using namespace py::literals;

// A cloud on a device, and the array that fits read the undecided points from.
struct CloudObject {
  py::object owner;
  GpuCloud cloud;
};

py::list list_devices() {
  std::vector<GpuInfo> found;
  {
    const py::gil_scoped_release unlocked;
    found = gpu_devices();
  }
  py::list devices;
  for (const GpuInfo& device : found)
    devices.append(py::dict("number"_a = device.number, "name"_a = device.name,
                            "kind"_a = std::string(gpu_kind_name(device.kind)), "memory"_a = device.memory));
  return devices;
}

GpuDevice open_device(const py::object& which) {
  const std::string name = py::str(which);
  const py::gil_scoped_release unlocked;
  return GpuDevice(name);
}

CloudObject upload_cloud(py::handle points, const GpuDevice& device, py::handle threads) {
  PointArray array = points_of(points);
  const Execution execution = execution_of(threads, py::none());
  const auto make = [&] {
    const py::gil_scoped_release unlocked;
    return GpuCloud(device, array.view, HostPoints::keep, execution);
  };
  GpuCloud cloud = make();
  return {std::move(array.owner), std::move(cloud)};
}

py::object python_volumes(std::vector<Fitted<AnyVolume>>&& fitted, const std::vector<const Method*>& methods,
                          bool single) {
  py::list list(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m)
    list[m] = to_python(std::move(fitted[m].volume), methods[m], fitted[m]);
  return single ? py::object(list[0]) : list;
}

std::vector<std::size_t> offsets_argument(py::handle offsets) {
  std::vector<std::size_t> all;
  for (const py::handle offset : offsets)
    all.push_back(offset.cast<std::size_t>());
  return all;
}

py::object gpu_fit_clusters(const CloudObject& self, const std::vector<const Method*>& methods, bool single,
                            py::handle offsets, const MethodOptions& options, const Execution& execution) {
  const std::vector<std::size_t> begins = offsets_argument(offsets);
  const auto make = [&] {
    const py::gil_scoped_release unlocked;
    return pcl_bv::fit(self.cloud, begins, methods, options, execution);
  };
  const ClusterFits fits = make();
  py::list clusters(fits.size());
  for (std::size_t c = 0; c < fits.size(); ++c) {
    std::vector<Fitted<AnyVolume>> fitted;
    for (std::size_t m = 0; m < methods.size(); ++m)
      fitted.push_back(fits.fitted(c, m));
    clusters[c] = python_volumes(std::move(fitted), methods, single);
  }
  return clusters;
}

py::object gpu_fit(const CloudObject& self, py::handle method, py::handle offsets, py::handle up,
                   py::handle growth, py::handle concave_length, py::handle threads) {
  const MethodOptions options{parse_text<SphereGrowth>(growth, "growth"), up_argument(up),
                              concave_length_argument(concave_length)};
  const Execution execution = execution_of(threads, py::none());
  bool single = false;
  const std::vector<const Method*> methods = methods_of(method, single);
  if (!offsets.is_none()) return gpu_fit_clusters(self, methods, single, offsets, options, execution);
  std::vector<Fitted<AnyVolume>> fitted;
  {
    const py::gil_scoped_release unlocked;
    fitted = pcl_bv::fit(self.cloud, methods, options, execution);
  }
  return python_volumes(std::move(fitted), methods, single);
}

constexpr const char* gpu_devices_doc = R"(devices()
--

Returns a list of the devices with Vulkan 1.1: dicts with number, name, kind ('discrete', 'integrated',
'virtual', 'other' or 'software') and memory in bytes. Loading the drivers takes up to tenths of a second.
Raises Error without the Vulkan loader.

>>> import pcl_bv.gpu
>>> [sorted(device) for device in pcl_bv.gpu.devices()][:1]
[['kind', 'memory', 'name', 'number']]
)";

constexpr const char* gpu_device_doc = R"(Device(which='auto')

An open device. which: 'auto' for the best graphics card, a number of devices(), or a part of a name in any
case. 'auto' takes no software driver. Raises Error if there is no such device.

>>> import pcl_bv.gpu
>>> device = pcl_bv.gpu.Device(0)
>>> device.number, device.lost
(0, False)
)";

constexpr const char* gpu_cloud_doc = R"(Cloud(points, device, *, threads=1)

A copy of points in the memory of a device. points: as for pcl_bv.fit(). The array is kept, and must not
change: fits read from it the few points that the device cannot decide on. Raises Error for too little memory.

>>> import numpy, pcl_bv.gpu
>>> corners = numpy.array([[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4]], numpy.float32)
>>> len(pcl_bv.gpu.Cloud(corners, pcl_bv.gpu.Device(0)))
4
)";

constexpr const char* gpu_fit_doc =
    "fit(self, method, offsets=None, *, up='z', growth='deferred', concave_length=None, threads=1)\n--\n\n"
    R"(Fits volumes to the points, with the bits of pcl_bv.fit().

method and the other arguments: as for pcl_bv.fit(). offsets: where clusters begin; cluster i has the points
offsets[i] to offsets[i + 1] - 1. Returns a volume, or a list of volumes for a list of methods; with offsets a
list of these, one for each cluster. Raises Error if the device is lost or has too little memory, IndexError
for offsets beyond the cloud and ValueError for offsets that descend.

>>> import numpy, pcl_bv.gpu
>>> corners = numpy.array([[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4]], numpy.float32)
>>> cloud = pcl_bv.gpu.Cloud(corners, pcl_bv.gpu.Device(0))
>>> cloud.fit('aabb')
Aabb(min=[0, 0, 0], max=[2, 3, 4], method='aabb', used=4)
>>> [box.used for box in cloud.fit('dop26', [0, 1, 4])]
[1, 3]
)";

}  // namespace

void bind_gpu(py::module_& module) {
  py::module_ gpu = module.def_submodule("_gpu", "The names of pcl_bv.gpu.");
  py::register_local_exception<GpuError>(gpu, "Error", PyExc_RuntimeError);
  gpu.def("devices", list_devices, gpu_devices_doc);
  py::class_<GpuDevice>(gpu, "Device", gpu_device_doc)
      .def(py::init(&open_device), "which"_a = "auto", init_doc(gpu_device_doc).c_str())
      .def_property_readonly(
          "name", [](const GpuDevice& d) { return d.info().name; }, "The driver's name of the device.")
      .def_property_readonly(
          "number", [](const GpuDevice& d) { return d.info().number; }, "Position in devices().")
      .def_property_readonly("lost", &GpuDevice::lost,
                             "Whether the device was lost, so that all its functions fail.");
  py::class_<CloudObject>(gpu, "Cloud", gpu_cloud_doc)
      .def(py::init(&upload_cloud), "points"_a, "device"_a, py::kw_only(), "threads"_a = 1,
           init_doc(gpu_cloud_doc).c_str())
      .def("__len__", [](const CloudObject& self) { return self.cloud.size(); })
      .def("fit", gpu_fit, "method"_a, "offsets"_a = py::none(), py::kw_only(), "up"_a = "z",
           "growth"_a = "deferred", "concave_length"_a = py::none(), "threads"_a = 1, gpu_fit_doc);
}

}  // namespace pcl_bv::python
