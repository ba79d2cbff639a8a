// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Everything of core.h, and the classes and functions for pcl::PointCloud. Link pcl_bv::estimation.
#pragma once

#include "pcl_bv/core.h"
#include "pcl_bv/estimation/bounding_volume_estimation.h"
#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/estimation/model_coefficients.h"
#include "pcl_bv/segmentation/extract_clusters.h"
