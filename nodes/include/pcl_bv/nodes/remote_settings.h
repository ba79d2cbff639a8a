// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>

namespace [[gnu::visibility("default")]] pcl_bv {

class FramePipeline;

/// The settings of a running pipeline as JSON, to be shown and changed by another process. All member
/// functions may be called from any thread.
class RemoteSettings {
 public:
  virtual ~RemoteSettings() = default;

  /// Returns a JSON array with one object per setting; it never changes. Each object has "key", "kind"
  /// (number, count, bool, choice or text), "unit" and "about". Where they apply, it also has "least" and
  /// "most" (the allowed range; "closed": false if `least` itself is not allowed), "choices", "unset" (the
  /// meaning of "null") and "fixed": true if the setting cannot be changed while frames are processed.
  virtual std::string description() const = 0;

  /// Returns a JSON object with the current value of each key: a number, true or false, or a text as in the
  /// configuration file ("null", "unlimited", "aabb, obb-lshape").
  virtual std::string values() const = 0;

  /// Changes the settings that the JSON `object` names, all of them or none, from the next frame on. Returns
  /// an empty text on success, otherwise a line that names the key, the value and the allowed values.
  virtual std::string change(const std::string& object) = 0;
};

/// Returns the settings of a pipeline, which must outlive them. Settings that read files or need other input
/// cannot be changed: filter.regions, cluster.class_field and cluster.classes.
std::unique_ptr<RemoteSettings> remote_settings(FramePipeline& pipeline);

}  // namespace pcl_bv
