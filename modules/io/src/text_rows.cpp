// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "text_rows.h"

#include <cstring>
#include <limits>
#include <type_traits>

#include "fields.h"
#include "text.h"

namespace pcl_bv {
namespace {

// "nan" as PCL writes it, of which organised clouds have many; std::from_chars reads all other forms.
template <typename T>
const char* read_nan(const char* at, T& value) {
  if (std::memcmp(at, "nan", 3) != 0 || !ends_value(at[3])) return nullptr;
  value = std::numeric_limits<T>::quiet_NaN();
  return at + 3;
}

template <typename T>
const char* read_number(const char* at, const char* end, T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    if (const char* after = read_short_decimal(at, value)) return after;
    if (const char* after = read_nan(at, value)) return after;
  }
  const char* after = parse_number(at, end, value);
  return after && ends_value(*after) ? after : nullptr;
}

}  // namespace

std::uint32_t TextRows::read(const PointField& field, std::byte* to) {
  return with_element_type(field, [&, count = field.count](auto value) {
    const char* at = at_;
    std::uint32_t read = 0;
    for (; read < count; ++read) {
      while (is_blank(*at))
        ++at;
      const char* after = *at == '\n' ? nullptr : read_number(at, end_, value);
      if (!after) break;
      std::memcpy(to + read * sizeof value, &value, sizeof value);
      at = after;
    }
    at_ = at;
    return read;
  });
}

std::string_view TextRows::value() const {
  const char* stop = at_;
  while (!ends_value(*stop))
    ++stop;
  return {at_, static_cast<std::size_t>(stop - at_)};
}

bool extend_run(PointField& run, const PointField& next) {
  const bool fits = run.count <= std::numeric_limits<std::uint32_t>::max() - next.count;
  if (run.type != next.type || run.size != next.size || !fits) return false;
  run.count += next.count;
  return true;
}

}  // namespace pcl_bv
