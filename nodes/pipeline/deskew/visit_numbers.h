// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

// Calls visit(i, number) for each record of the field. Drivers write three types; a loop for each of them is
// five times as fast as FieldView::number().
template <typename Visit>
void visit_numbers(const FieldView& field, std::size_t count, const Visit& visit) {
  const auto loop = [&](auto zero) {
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(&zero, field.data + i * field.stride, sizeof zero);
      visit(i, static_cast<double>(zero));
    }
  };
  if (field.type == 'F' && field.size == 4) return loop(0.F);
  if (field.type == 'F' && field.size == 8) return loop(0.0);
  if (field.type == 'U' && field.size == 4) return loop(std::uint32_t{0});
  for (std::size_t i = 0; i < count; ++i)
    visit(i, field.number(i));
}

}  // namespace pcl_bv::detail
