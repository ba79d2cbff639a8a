// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/pair_queries.h"

#include <algorithm>
#include <cmath>

#include "bounds.h"
#include "gjk.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/float_environment.h"
#include "shape.h"

namespace pcl_bv {

using namespace detail;

namespace {

// The rounded product `matrix` of two matrices a and b, and an upper bound `error` of |(matrix - a b) v| for
// |v| = 1.
struct Product {
  Eigen::Matrix3d matrix;
  double error;
};

Product multiply(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  Product product{Eigen::Matrix3d::Zero(), 0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Expansion exact;
      exact.add_dot(a.row(i), b.col(j));
      product.matrix(i, j) = exact.value();
      product.error = add_up(product.error, exact.add(-product.matrix(i, j)).magnitude_up());
    }
  }
  return product;
}

}  // namespace

ConvexBody::ConvexBody()
    : rotation_(Eigen::Matrix3d::Identity()),
      origin_(Eigen::Vector3d::Constant(kNan)),
      radius_(-1),
      size_(0),
      is_rotated_(false) {}

ConvexBody::ConvexBody(const AnyVolume& volume) : ConvexBody() {
  const FloatEnvironment environment;
  shape_ = make_shape(volume);
  if (!shape_) return;
  origin_ = shape_->origin;
  radius_ = shape_->radius;
  size_ = shape_->size;
}

// A point origin + rotation q + e, with |e| <= radius, moves to M (origin + rotation q + e) + t. This is the
// new origin plus (M rotation) q plus M e, up to the rounding errors of the new origin and of M rotation. The
// length of M e is at most stretch * radius.
ConvexBody ConvexBody::transformed(const Eigen::Isometry3d& transform) const {
  const FloatEnvironment environment;
  if (empty()) return *this;
  ConvexBody result = *this;
  const Eigen::Matrix3d m = transform.linear();
  const PointWithError origin = transform_point(transform, origin_);
  const double stretch = matrix_norm_up(m);
  double lost = origin.error;
  result.rotation_ = m;
  if (is_rotated_) {
    const Product product = multiply(m, rotation_);
    result.rotation_ = product.matrix;
    lost = add_up(lost, multiply_up(product.error, shape_->size));
  }
  result.origin_ = origin.point;
  result.radius_ = add_up(multiply_up(radius_, stretch), lost);
  result.size_ = add_up(multiply_up(size_, stretch), lost);
  result.is_rotated_ = true;
  return result;
}

bool overlaps(const ConvexBody& a, const ConvexBody& b) {
  const FloatEnvironment environment;
  return !a.empty() && !b.empty() && !(lower_bound(PosedShape(a), PosedShape(b), Goal::exceeds_bound, 0) > 0);
}

double distance(const ConvexBody& a, const ConvexBody& b) {
  const FloatEnvironment environment;
  if (a.empty() || b.empty()) return kInfinity;
  return lower_bound(PosedShape(a), PosedShape(b), Goal::distance, 0);
}

double distance(const ConvexBody& body, const Eigen::Vector3d& point) {
  const FloatEnvironment environment;
  if (point.hasNaN()) return kNan;
  if (body.empty() || !point.allFinite()) return kInfinity;
  static const std::shared_ptr<const SupportShape> shape = make_shape(Sphere(Eigen::Vector3d::Zero(), 0));
  return lower_bound(PosedShape(body), PosedShape(*shape, point), Goal::distance, 0);
}

bool within(const ConvexBody& a, const ConvexBody& b, double margin) {
  const FloatEnvironment environment;
  if (a.empty() || b.empty()) return margin == kInfinity;
  if (margin < 0) return false;
  return !(lower_bound(PosedShape(a), PosedShape(b), Goal::exceeds_bound, margin) > margin);
}

bool overlaps(const AnyVolume& a, const AnyVolume& b) {
  return overlaps(ConvexBody(a), ConvexBody(b));
}

double distance(const AnyVolume& a, const AnyVolume& b) {
  return distance(ConvexBody(a), ConvexBody(b));
}

}  // namespace pcl_bv
