// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "count_linked.h"

#include <type_traits>

#include "vector_clones.h"

namespace pcl_bv::detail {
namespace {

// Most runs are shorter than a register, so each step masks the points after the end of its run. The runs
// have fewer than 2^31 points in all.
template <typename T>
[[gnu::always_inline]] inline std::size_t count(const T* x, const T* y, const T* z, const PositionRange* runs,
                                                std::size_t run_count, const Point<T>& p, T r2,
                                                std::size_t needed) {
  constexpr int lanes = PointColumns<T>::kLanes;
  constexpr std::size_t steps_between_sums = 8;
  using Count = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  std::size_t steps = 0, found = 0;
  Count linked[lanes] = {};
  const auto sum = [&] {
    Count all = 0;
    for (int k = 0; k < lanes; ++k)
      all += linked[k];
    return static_cast<std::size_t>(all);
  };
  for (std::size_t r = 0; r < run_count; ++r) {
    for (std::size_t i = runs[r].begin; i < runs[r].end; i += lanes) {
      const T *px = x + i, *py = y + i, *pz = z + i;
      const auto remaining = static_cast<Count>(runs[r].end - i);
      for (Count k = 0; k < lanes; ++k) {
        const bool is_linked = squared_norm(px[k] - p.x, py[k] - p.y, pz[k] - p.z) < r2;
        linked[k] += static_cast<Count>(is_linked & (k < remaining));
      }
      if (++steps % steps_between_sums == 0 && (found = sum()) >= needed) return found;
    }
  }
  return sum();
}

PCL_BV_VECTOR_CLONES std::size_t count_floats(const float* x, const float* y, const float* z,
                                              const PositionRange* runs, std::size_t run_count,
                                              const Point<float>& p, float r2, std::size_t needed) {
  return count(x, y, z, runs, run_count, p, r2, needed);
}

PCL_BV_VECTOR_CLONES std::size_t count_doubles(const double* x, const double* y, const double* z,
                                               const PositionRange* runs, std::size_t run_count,
                                               const Point<double>& p, double r2, std::size_t needed) {
  return count(x, y, z, runs, run_count, p, r2, needed);
}

}  // namespace

template <typename T>
void PointColumns<T>::assign(const std::vector<Point<T>>& points) {
  for (std::vector<T>* column : {&x_, &y_, &z_})
    column->resize(points.size() + kLanes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    x_[i] = points[i].x;
    y_[i] = points[i].y;
    z_[i] = points[i].z;
  }
}

template <typename T>
std::size_t PointColumns<T>::count_linked(const PositionRange* runs, std::size_t run_count, const Point<T>& p,
                                          T r2, std::size_t needed) const {
  if constexpr (std::is_same_v<T, float>) {
    return count_floats(x_.data(), y_.data(), z_.data(), runs, run_count, p, r2, needed);
  } else {
    return count_doubles(x_.data(), y_.data(), z_.data(), runs, run_count, p, r2, needed);
  }
}

template class PointColumns<float>;
template class PointColumns<double>;

}  // namespace pcl_bv::detail
