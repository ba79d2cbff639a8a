// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points that come part by part from a cloud in memory.
#pragma once

#include <algorithm>
#include <atomic>
#include <optional>
#include <stdexcept>

#include "clouds.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::test {
using namespace detail;

/// Copies what is asked for into the buffer, and spoils whatever else is in there.
template <typename T>
class CopyingSource : public PointSource {
 public:
  explicit CopyingSource(const TestCloud<T>& cloud) : cloud_(cloud) {}

  PointView view() const {
    return view_of(*this, cloud_.size(), sizeof(T) == 4 ? ScalarType::float32 : ScalarType::float64);
  }

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override {
    if (count > kChunkPoints || first + count > cloud_.size()) throw std::logic_error("asked for too much");
    ++loads;
    if (fail_at && first <= *fail_at && *fail_at < first + count) throw std::runtime_error("cut");
    buffer.assign(std::max(buffer.size(), count * 3 * sizeof(T) + 64), std::byte{0x7f});
    const TestCloud<T>& now = later != nullptr && loads > loads_before ? *later : cloud_;
    std::copy_n(reinterpret_cast<const std::byte*>(now.xyz.data() + 3 * first), count * 3 * sizeof(T),
                buffer.data());
    PointView view = PointView::of(reinterpret_cast<const T*>(buffer.data()), 3 * sizeof(T), count);
    view.first = first;
    return view;
  }

  mutable std::atomic<std::size_t> loads = 0;
  std::optional<std::size_t> fail_at;
  const TestCloud<T>* later = nullptr;  ///< Of as many points: what is there after so many loads.
  std::size_t loads_before = 0;

 private:
  const TestCloud<T>& cloud_;
};

}  // namespace pcl_bv::test
