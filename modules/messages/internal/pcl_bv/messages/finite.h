// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cmath>
#include <type_traits>

#include "pcl_bv/messages/types.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Finds out whether all floating-point fields of a message are finite.
class FiniteCheck {
 public:
  static constexpr bool ros1 = false;

  template <class... Fields>
  void operator()(const Fields&... fields) {
    (check(fields), ...);
  }
  bool finite() const { return finite_; }

 private:
  template <class T>
  void check(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      finite_ = finite_ && std::isfinite(value);
    } else if constexpr (!std::is_arithmetic_v<T>) {
      T::each_field(value, *this);
    }
  }
  void check(const std::string&) {}
  void check(const msg::Bytes&) {}
  template <class T>
  void check(const std::vector<T>& list) {
    for (const T& element : list)
      check(element);
  }
  template <class T, std::size_t n>
  void check(const std::array<T, n>& list) {
    for (const T& element : list)
      check(element);
  }

  bool finite_ = true;
};

/// Returns whether all numbers of a message are finite. True without numbers. Does not look into msg::Bytes.
template <class Message>
bool is_finite(const Message& message) {
  FiniteCheck check;
  check(message);
  return check.finite();
}

}  // namespace pcl_bv
