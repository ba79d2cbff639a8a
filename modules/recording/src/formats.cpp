// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "formats.h"

namespace pcl_bv {

const std::vector<RecordingFormat>& recording_formats() {
  static const std::vector<RecordingFormat> formats{};
  return formats;
}

}  // namespace pcl_bv
