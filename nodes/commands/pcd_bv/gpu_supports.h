// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The option --gpu. Builds without the component gpu refuse it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "pcl_bv/fitting/fit_into.h"

namespace pcl_bv::detail {

/// Returns the lines of --version that list the devices.
std::string gpu_list();

/// Makes a finder of supports for each thread that processes inputs. All finders use one device.
using MakeSupportFinder = std::function<std::shared_ptr<SupportFinder>()>;

/// Opens the device that `which` names, as GpuDevice does. If "auto" finds no graphics card, reports this and
/// returns a function that returns null. Throws IoError for any other device that cannot be opened.
MakeSupportFinder open_gpu(const std::string& which);

}  // namespace pcl_bv::detail
