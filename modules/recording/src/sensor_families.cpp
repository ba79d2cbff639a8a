// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "sensor_family.h"

namespace pcl_bv::detail {

const std::vector<SensorFamilyRow>& sensor_families() {
  static const std::vector<SensorFamilyRow> families{
      {"VLP-16, HDL-32E, VLP-32C", open_velodyne},
      {"Hesai PandarXT-32, PandarXT-16, PandarXT-32M2X, PandarQT, QT128, Pandar128, OT128, AT128, Pandar64, "
       "Pandar40P, Pandar40M",
       open_hesai},
      {"Livox Mid-360, HAP", open_livox},
      {"Ouster OS-0, OS-1, OS-2", open_ouster}};
  return families;
}

}  // namespace pcl_bv::detail
