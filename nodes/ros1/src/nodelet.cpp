// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <exception>
#include <memory>

#include "cluster_volumes.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv {
using namespace detail;

class ClusterVolumesNodelet : public nodelet::Nodelet {
 private:
  // Logs the reason of an exception, because the manager reports only that the nodelet is not loaded.
  void onInit() override {
    try {
      work_ = std::make_unique<ClusterVolumes>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(detail::message_line(detail::reason_of(error)));
      throw;
    }
  }

  std::unique_ptr<ClusterVolumes> work_;
};

}  // namespace pcl_bv

PLUGINLIB_EXPORT_CLASS(pcl_bv::ClusterVolumesNodelet, nodelet::Nodelet)
