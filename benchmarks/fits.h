// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is measured: our fits by the names of the method table, each checked before it is timed.
#pragma once

#include <string>

#include "clouds.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::bench {
using namespace detail;

/// A method of fitting/methods.h, with "+sequential", "+stationary" or "+deferred" after it grown that way;
/// or "dop26-points": the extremes of a 26-DOP and the points that reach them.
class Fit {
 public:
  explicit Fit(const std::string& work);
  const std::string& name() const { return name_; }

  /// Throws std::logic_error unless this execution gives what the scalar reference gives, bit for bit, and
  /// exact arithmetic finds no point of the cloud outside.
  void check(Cloud& cloud, const Execution& execution) const;

  /// What is timed.
  void operator()(const Cloud& cloud, const Execution& execution) const;

  AnyVolume volume(const Cloud& cloud, const Execution& execution) const;

 private:
  std::string name_;
  const Method* method_;
  MethodOptions options_;
  bool with_points_;
};

void require(bool holds, const std::string& what);

}  // namespace pcl_bv::bench
