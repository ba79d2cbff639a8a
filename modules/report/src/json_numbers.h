// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Takes numbers from untrusted JSON. Errors name the key, the allowed kind of value and the value.
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include "pcl_bv/io/read_json.h"

namespace pcl_bv::detail {

[[noreturn]] inline void refuse(const std::string& what) {
  throw std::invalid_argument(what);
}

// Throws an error such as "center: three numbers are wanted, not [1,2]".
[[noreturn]] inline void refuse(const char* key, const char* wanted, const UntrustedJson& value) {
  refuse(std::string(key) + ": " + wanted + ", not " + abbreviated(value));
}

inline double number_of(const char* key, const UntrustedJson& value) {
  if (!value.is_number()) refuse(key, "a number is wanted", value);
  return value.get<double>();
}

inline const UntrustedJson& list_of(const char* key, const UntrustedJson& value) {
  if (!value.is_array()) refuse(key, "a list is wanted", value);
  return value;
}

inline Eigen::Vector3d vector_of(const char* key, const UntrustedJson& value) {
  if (!value.is_array() || value.size() != 3) refuse(key, "three numbers are wanted", value);
  return {number_of(key, value[0]), number_of(key, value[1]), number_of(key, value[2])};
}

}  // namespace pcl_bv::detail
