// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits whose volume and result a test wants apart.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "pcl_bv/fitting/fit.h"

namespace pcl_bv::test {

/// Moves the volume of a fit to `volume` and returns the result of the fit.
template <typename VolumeT>
EstimationResult take(Fitted<VolumeT>&& fitted, VolumeT& volume) {
  volume = std::move(fitted.volume);
  return fitted;
}

/// Moves the proof to `certificate`, too.
template <typename VolumeT, typename CertificateT>
EstimationResult take(Certified<VolumeT, CertificateT>&& fitted, VolumeT& volume, CertificateT& certificate) {
  certificate = std::move(fitted.certificate);
  return take(static_cast<Fitted<VolumeT>&&>(fitted), volume);
}

/// Moves the points that touch the k-DOP to `contacts`, too.
inline EstimationResult take(KdopWithContacts&& fitted, Kdop& kdop, SlabPoints& contacts) {
  contacts = std::move(fitted.contacts);
  return take(static_cast<Fitted<Kdop>&&>(fitted), kdop);
}

/// Expects the status, the rank and the counts of `expected`.
inline void expect_same_result(const EstimationResult& result, const EstimationResult& expected) {
  EXPECT_EQ(result.status, expected.status);
  EXPECT_EQ(result.rank, expected.rank);
  EXPECT_EQ(result.used, expected.used);
  EXPECT_EQ(result.dropped, expected.dropped);
}

}  // namespace pcl_bv::test
