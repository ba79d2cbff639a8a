// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

/// Calls function with a value of the C++ type that the field's letter and size mean. Floating point of 1 and
/// 2 bytes has no type: that is for the caller to refuse.
template <typename Function>
auto with_element_type(const PointField& field, const Function& function) {
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? function(std::int8_t{}) : function(std::uint8_t{});
    case 2:
      return is_signed ? function(std::int16_t{}) : function(std::uint16_t{});
    case 4:
      if (field.type == 'F') return function(float{});
      return is_signed ? function(std::int32_t{}) : function(std::uint32_t{});
    default:
      if (field.type == 'F') return function(double{});
      return is_signed ? function(std::int64_t{}) : function(std::uint64_t{});
  }
}

}  // namespace pcl_bv
