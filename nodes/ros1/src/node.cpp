// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <ros/init.h>

#include <exception>
#include <iostream>

#include "cluster_volumes.h"
#include "pcl_bv/io/untrusted_text.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "cluster_volumes");
  int status = 0;
  try {
    const pcl_bv::ClusterVolumes node(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const pcl_bv::ConfigError& error) {
    std::cerr << "cluster_volumes: " << pcl_bv::detail::message_line(error.what()) << '\n';
    status = 2;
  } catch (const std::exception& error) {
    std::cerr << "cluster_volumes: " << pcl_bv::detail::message_line(pcl_bv::detail::reason_of(error))
              << '\n';
    status = 1;
  }
  return status;
}
