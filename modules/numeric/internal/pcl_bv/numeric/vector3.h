// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Vector operations with a fixed order of additions, (x + y) + z. Eigen's order differs and may depend on the
// processor.
#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

// The functions below take any type with elements v[0], v[1], v[2]: Coordinates, std::array, Eigen's vectors
// and expressions.
namespace numeric_internal {

template <typename Vector>
using ScalarOf = std::decay_t<decltype(std::declval<Vector>()[0])>;

// The type in which functions return a vector computed from a Vector. For an Eigen expression, this is the
// plain matrix type; for any other type, Vector itself.
template <typename Vector, typename = void>
struct Plain {
  using Type = Vector;
};
template <typename Vector>
struct Plain<Vector, std::void_t<typename Vector::PlainObject>> {
  using Type = typename Vector::PlainObject;
};
template <typename Vector>
using PlainOf = typename Plain<Vector>::Type;

}  // namespace numeric_internal

/// Returns the dot product a . b.
template <typename A, typename B>
inline auto dot3(const A& a, const B& b) {
  using Scalar = std::common_type_t<numeric_internal::ScalarOf<A>, numeric_internal::ScalarOf<B>>;
  return Scalar((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]);
}

/// Returns the Euclidean length |v|.
template <typename Vector>
inline auto norm3(const Vector& v) {
  return std::sqrt(dot3(v, v));
}

/// Returns |v|_1, the sum of the magnitudes of the components. Error bounds are multiples of this norm.
template <typename Vector>
inline auto taxicab3(const Vector& v) {
  return (std::abs(v[0]) + std::abs(v[1])) + std::abs(v[2]);
}

/// Returns the cross product a x b.
template <typename A, typename B>
inline numeric_internal::PlainOf<A> cross3(const A& a, const B& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns v / |v|. The length should be about 1 or more, because squares of small components may underflow.
template <typename Vector>
inline numeric_internal::PlainOf<Vector> unit3(const Vector& v) {
  const auto length = norm3(v);
  return {v[0] / length, v[1] / length, v[2] / length};
}

}  // namespace detail
}  // namespace pcl_bv
