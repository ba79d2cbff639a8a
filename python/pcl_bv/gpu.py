# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fits to clouds in the memory of a graphics card, by Vulkan, with the bits of pcl_bv.fit().

>>> import numpy, pcl_bv.gpu
>>> points = numpy.random.default_rng(1).normal(size=(10000, 3)).astype(numpy.float32)
>>> cloud = pcl_bv.gpu.Cloud(points, pcl_bv.gpu.Device(0))
>>> cloud.fit('dop26') == pcl_bv.fit(points, 'dop26')
True
"""

from . import _pcl_bv

if not hasattr(_pcl_bv, "_gpu"):
    raise ImportError("this build of pcl_bv has no support for graphics cards (it needs glslc and libvulkan-dev)")

Cloud, Device, Error, devices = (getattr(_pcl_bv._gpu, _name) for _name in ("Cloud", "Device", "Error", "devices"))
__all__ = ["Cloud", "Device", "Error", "devices"]
for _name in ("Cloud", "Device", "Error"):  # so that tracebacks contain pcl_bv.gpu
    globals()[_name].__module__ = "pcl_bv.gpu"
del _name
