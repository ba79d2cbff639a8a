# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fits bounding volumes to point clouds in numpy arrays, without copying the points.

>>> import numpy, pcl_bv
>>> points = numpy.random.default_rng(1).normal(size=(1000, 3))
>>> box = pcl_bv.fit(points, "obb")
>>> bool(box.contains(points).all()), pcl_bv.verify(box, points).outside
(True, 0)
"""

from . import _pcl_bv
from ._pcl_bv import *  # noqa: F401,F403 - all its names are public
from ._pcl_bv import __version__

__all__ = ["__version__"] + [name for name in dir(_pcl_bv) if not name.startswith("_")]
for _name in __all__[1:]:  # so that tracebacks and pickles contain pcl_bv instead of pcl_bv._pcl_bv
    if isinstance(getattr(_pcl_bv, _name), type):
        getattr(_pcl_bv, _name).__module__ = "pcl_bv"
del _name
