// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// bv_stream in a domain of the test's own on the loopback.
#pragma once

#include <cstdlib>

#include "background.h"
#include "temporary_folder.h"

namespace pcl_bv::test {

/// Tests that run at the same time do not see one another.
inline unsigned own_domain() {
  static const unsigned domain = [] {
    const unsigned id = 1 + static_cast<unsigned>(getpid()) % 200;
    setenv("ROS_DOMAIN_ID", std::to_string(id).c_str(), 1);
    setenv("ROS_LOCALHOST_ONLY", "1", 1);
    return id;
  }();
  return domain;
}

class BvStream : public Background {
 public:
  BvStream(const std::filesystem::path& errors, std::vector<std::string> arguments)
      : Background(errors, command(std::move(arguments))) {}

  /// Removes the warning about the kernel's limit of receive buffers, which most machines cause.
  std::string errors() const {
    std::string text = Background::errors();
    const std::size_t at = text.find("net.core.rmem_max");
    if (at == std::string::npos) return text;
    const std::size_t begin = text.rfind('\n', at) + 1;  // npos + 1 is 0: the first line
    return text.erase(begin, text.find('\n', at) + 1 - begin);
  }

 private:
  static std::vector<std::string> command(std::vector<std::string> arguments) {
    own_domain();
    arguments.insert(arguments.begin(), PCL_BV_BIN_DIR "/bv_stream");
    return arguments;
  }
};

class DdsTest : public testing::Test {
 protected:
  DdsTest() { own_domain(); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

 private:
  const TemporaryFolder folder_;
};

}  // namespace pcl_bv::test
