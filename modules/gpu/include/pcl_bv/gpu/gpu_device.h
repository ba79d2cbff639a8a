// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Graphics cards and software drivers that run Vulkan 1.1 compute shaders. The Vulkan loader (libvulkan.so.1)
// is opened by the first function that needs it, so programs start and run without it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
class GpuContext;
}

/// Why a function of a device failed.
enum class GpuFailure : std::uint8_t {
  no_loader,      ///< libvulkan.so.1 is not installed or older than Vulkan 1.1.
  no_device,      ///< No device, or none that matches the request.
  out_of_memory,  ///< The device or the host has too little memory. The device stays usable.
  lost,           ///< The device was lost (reset, removed or hung). It and its clouds stay unusable.
  other           ///< Any other failure of the driver.
};

/// Failure of a device. what() is one line.
class GpuError : public std::runtime_error {
 public:
  GpuError(GpuFailure failure, const std::string& what) : std::runtime_error(what), failure_(failure) {}

  GpuFailure failure() const { return failure_; }

 private:
  GpuFailure failure_;
};

/// Kinds of devices, in the order in which "auto" prefers them. It never chooses `software`, whose compute
/// shaders run on the processor and are slower than the functions for the processor.
enum class GpuKind : std::uint8_t { discrete, integrated, virtual_machine, other, software };

/// Returns "discrete", "integrated", "virtual", "other" or "software".
std::string_view gpu_kind_name(GpuKind kind);

/// Description of a device.
struct GpuInfo {
  std::size_t number = 0;  ///< Position in gpu_devices().
  std::string name;        ///< Name that the driver gives, e.g. "NVIDIA H100 PCIe".
  GpuKind kind = GpuKind::other;
  std::size_t memory = 0;       ///< Bytes of the largest memory heap of the device.
  std::size_t max_binding = 0;  ///< Largest number of bytes that a shader sees of one buffer.
  bool imports = false;         ///< Whether GpuCloud can use memory of other programs (external memory).
};

/// Returns the devices that have Vulkan 1.1 and compute shaders, in the order of the loader. Loads all
/// drivers, which can take tenths of a second. Throws GpuError (no_loader).
std::vector<GpuInfo> gpu_devices();

/// Options of a device.
struct GpuOptions {
  /// Loads the validation layer (VK_LAYER_KHRONOS_validation), which checks each call and is slow. For tests.
  bool validation = false;
  /// Bytes of a cloud in one buffer. Larger clouds are divided. The device's limit and 128 MiB hold anyway.
  std::size_t max_binding = std::size_t{128} << 20;
};

/// An open device. Copies refer to the same device, and clouds keep it open. Functions of one device may be
/// called by several threads; submissions to the device take turns.
class GpuDevice {
 public:
  /// Opens a device. `which` is "auto", a number of gpu_devices(), or a part of a name (not case-sensitive)
  /// that matches one device or more; of several, the first. "auto" takes the first device of the best
  /// GpuKind, and no software driver.
  ///
  /// Throws GpuError: no_loader; no_device if none matches, with the devices there are; out_of_memory or
  /// other if the driver refuses. Throws std::invalid_argument if options.max_binding is below 1 MiB.
  explicit GpuDevice(std::string_view which = "auto", const GpuOptions& options = {});

  const GpuInfo& info() const;

  /// Whether the device was lost. If so, all functions that use it throw GpuError (lost).
  bool lost() const;

  /// Returns the errors and warnings of the validation layer so far; none without GpuOptions::validation.
  std::vector<std::string> validation_messages() const;

  const std::shared_ptr<detail::GpuContext>& context() const { return context_; }  ///< Private.

 private:
  std::shared_ptr<detail::GpuContext> context_;
};

}  // namespace pcl_bv
