// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clouds of the benchmarks, by name. Made when first asked for and kept until another one is, so that
// rows on the same cloud share it and memory holds one.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::bench {
using namespace detail;

/// Sizes that, at 16 bytes a point, fit the first, second and third level of cache, and none.
inline constexpr std::size_t kL1 = 2048, kL2 = 32'768, kL3 = 1'000'000, kMemory = 16'000'000;

/// Vertices of the meshes in Table 1 of the paper, in its order.
inline constexpr std::size_t kPaperSizes[] = {4010, 7260, 30'892, 32'875, 48'485, 100'722, 327'323};

struct CloudName {
  /// "gauss", "cube", "street" (a LiDAR sweep), "paper" (kPaperSizes only), a shape of shapes.h, a mesh of
  /// meshes.h.
  std::string scene;
  std::size_t points = 0;      ///< A multiple of 64 for the street.
  std::string layout = "xyz";  ///< One of layouts().
  std::string bad = "no-nan";  ///< Or "one-nan" (the middle point), "1pc-nan" (every hundredth).

  /// "gauss/xyz/no-nan/n:32768", as it stands in the names of rows.
  std::string text() const;
  bool operator==(const CloudName&) const = default;
};

/// "xyz" (pcl::PointXYZ), "packed" (12 bytes), "xyzi" (pcl::PointXYZI, 32 bytes), "indices" (all of a
/// pcl::PointXYZ cloud by an index list), "double" (24 bytes), "groups" (PointGroups: 12 bytes, by
/// coordinate).
const std::vector<std::string>& layouts();

struct Cloud {
  CloudName name;
  PointView view;
  std::size_t bytes = 0;  ///< That a pass reads: all of the records, and the indices.
  std::shared_ptr<const pcl::PointCloud<pcl::PointXYZ>> pcl;  ///< Layout "xyz" only; is_dense is true.
  std::shared_ptr<const void> memory;                         ///< What `view` looks at.
  /// The scalar reference's answers, by work: what fits.cpp compares with.
  std::map<std::string, AnyVolume> proven;
  std::optional<detail::Supports> supports;
  std::map<std::string_view, std::size_t> outside;  ///< By peer: points outside its answer.
};

/// As it is in this run: tiny ones (program.h) have fewer points.
Cloud& cloud(const CloudName& name);

}  // namespace pcl_bv::bench
