// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Includes the public headers for which a program links pcl_bv::core. They need no PCL: point views and
// sources, ground and clusters, volumes, fits with their proofs, and trees.
#pragma once

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_groups.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/cloud_statistics.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/trees/collision.h"
#include "pcl_bv/trees/point_tree.h"
#include "pcl_bv/trees/region_mask.h"
#include "pcl_bv/trees/volume_tree.h"
#include "pcl_bv/volumes/any_volume.h"
#include "pcl_bv/volumes/pair_queries.h"
