// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Devices for tests of outputs. Code with a fault that replaces its output would replace the machine's
// /dev/null if root runs it.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace pcl_bv::test {

/// The minor numbers of Linux' memory devices, whose major number is 1.
enum class Device : unsigned { null = 3, full = 7 };

/// A device that root may lose: a node made in `folder`. Users without the rights of root cannot replace a
/// device, and get the machine's. Empty if there is none: the test should be skipped.
inline std::filesystem::path device_in(const std::filesystem::path& folder, Device device) {
  const char* const name = device == Device::null ? "null" : "full";
  std::filesystem::path path = std::filesystem::path("/dev") / name;
  if (::geteuid() == 0) {
    path = folder / name;
    if (::mknod(path.c_str(), S_IFCHR | 0600, makedev(1, static_cast<unsigned>(device))) != 0) return {};
  }
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);  // refused by mounts with nodev
  if (descriptor < 0) return {};
  ::close(descriptor);
  return path;
}

}  // namespace pcl_bv::test
