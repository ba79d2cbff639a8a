// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// CGAL, where it is installed (libcgal-dev). Its headers are GPL: only programs that measure include them.
#pragma once

#include "peers.h"

namespace pcl_bv::bench {
using namespace detail;

/// "cgal-min-sphere" (CGAL::Min_sphere_d in double) and "cgal-min-sphere-of-spheres"
/// (CGAL::Min_sphere_of_spheres_d in double, radii of 0), which solve what sphere-exact solves. Their
/// `outside` throws if the radius is off the proven bounds of the smallest one by more than 1e-9 of it (it is
/// off by up to 1e-11 on smooth meshes). Empty if CGAL is not installed.
const std::vector<Peer>& cgal_spheres();

/// "cgal-bounding-box" (CGAL::bounding_box in double), or nothing.
const std::vector<Peer>& cgal_boxes();

}  // namespace pcl_bv::bench
