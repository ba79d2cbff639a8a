// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

namespace pcl_bv {

struct StreamConfig;

namespace [[gnu::visibility("default")]] detail {

/// The settings of a running pipeline as JSON, for another process that shows and changes them. All member
/// functions may be called from any thread.
class RemoteParameters {
 public:
  virtual ~RemoteParameters() = default;

  /// Returns a JSON array with one object per setting. The array never changes. Each object has "key", "kind"
  /// (number, count, bool, choice or text), "unit" and "about". Some objects have more members:
  /// - "least" and "most": the allowed range; with "closed": false, "least" itself is not allowed;
  /// - "choices": the allowed values;
  /// - "unset": the meaning of "null";
  /// - "fixed": true if the setting cannot be changed while frames are processed.
  virtual std::string description() const = 0;

  /// Returns a JSON object with the current value of each key. A value is a number, true, false, or a text as
  /// in the configuration file ("null", "unlimited", "aabb, obb-lshape").
  virtual std::string values() const = 0;

  /// Changes the settings that the JSON `object` names, from the next frame on. If one of them cannot be
  /// changed, changes none of them. Returns an empty text on success, otherwise a line that names, for each
  /// setting that cannot be changed, the key, the value and the allowed values.
  virtual std::string change(const std::string& object) = 0;

  /// Returns the settings of the stream's runner and rig, which never change. `pipeline` is not set.
  virtual const StreamConfig& stream() const = 0;
};

}  // namespace detail
}  // namespace pcl_bv
