// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest sphere of a cloud.
#pragma once

#include "pcl_bv/fitting/fit.h"
#include "sphere/distance_scan.h"
#include "sphere/sphere_seed.h"

namespace pcl_bv {

/// Starting from some of the points. Fills the certificate.
Sphere exact_sphere(DistanceScan& scan, const LocalFrame& frame, SeedPoints seeds,
                    SphereCertificate& certificate);

}  // namespace pcl_bv
