// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A fixture that reads volumes from a file with a given text.
#pragma once

#include <string>
#include <vector>

#include "files.h"
#include "pcl_bv/report/read_volumes.h"

namespace pcl_bv::detail {

class VolumeFileTest : public FileTest {
 protected:
  std::vector<AnyVolume> read(const std::string& text) const {
    write_text(file("volumes.json"), text);
    return read_volumes(file("volumes.json"));
  }
  std::string error_of(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  }
};

}  // namespace pcl_bv::detail
