// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>

namespace [[gnu::visibility("default")]] pcl_bv {

class FramePipeline;

/// The settings of a running pipeline as JSON, for those who see and change them from another process. All
/// calls are allowed from any thread.
class RemoteSettings {
 public:
  virtual ~RemoteSettings() = default;

  /// An array with an object for each setting, which never changes: "key", "kind" (number, count, bool,
  /// choice or text), "unit", "about", and as far as they say something "least" and "most" (allowed values;
  /// "closed": false where `least` itself is not), "choices", "unset" (what "null" means) and "fixed": true
  /// where it cannot be changed while frames come.
  virtual std::string description() const = 0;

  /// An object with the value in force of each key: a number, true or false, or a text as the configuration
  /// file has it
  /// ("null", "unlimited", "aabb, obb-lshape").
  virtual std::string values() const = 0;

  /// Changes what `object` names, all or nothing, from the next frame on. Returns a line that names the key,
  /// the value and what is allowed where something cannot be so, else nothing.
  virtual std::string change(const std::string& object) = 0;
};

/// Of a pipeline, which must outlive it. What reads files or needs other input stays as it was at the start
/// (filter.regions, cluster.class_field, cluster.classes).
std::unique_ptr<RemoteSettings> remote_settings(FramePipeline& pipeline);

}  // namespace pcl_bv
