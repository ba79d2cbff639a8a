// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "qhull_triangles.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

namespace pcl_bv::bench {
namespace {

// A stream that keeps what is written to it away from everybody: Qhull stops the process without one.
class Silence {
 public:
  Silence() : stream_(open_memstream(&text_, &size_)) {}
  ~Silence() {
    if (stream_ != nullptr) std::fclose(stream_);
    std::free(text_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

  FILE* stream() { return stream_; }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  FILE* stream_;
};

class Qhull {
 public:
  // Never points to nothing: qh_zero() comes first in every use.
  explicit Qhull(FILE* errors) : qh_(std::make_unique<qhT>()) { qh_zero(qh_.get(), errors); }
  ~Qhull() {
    int kept_long = 0, total_long = 0;
    qh_freeqhull(qh_.get(), !qh_ALL);
    qh_memfreeshort(qh_.get(), &kept_long, &total_long);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  bool run(std::vector<Eigen::Vector3d>& points, const char* options, FILE* errors) {
    // It writes to neither the points nor the options.
    return qh_new_qhull(qh_.get(), 3, static_cast<int>(points.size()), points.data()->data(), False,
                        const_cast<char*>(options), nullptr, errors) == 0;
  }

  std::vector<Triangle> triangles() {
    std::vector<Triangle> result;
    for (facetT* facet = qh_->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
      if (!facet->simplicial) return {};
      Triangle t;
      std::size_t corner = 0;
      for (void** vertex = &facet->vertices->e[0].p; *vertex != nullptr && corner < 3; ++vertex)
        t[corner++] = qh_pointid(qh_.get(), static_cast<vertexT*>(*vertex)->point);
      if (facet->toporient ^ qh_ORIENTclock) std::swap(t[0], t[1]);
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      result.push_back(t);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  std::unique_ptr<qhT> qh_;
};

std::vector<Triangle> triangles_of(std::vector<Eigen::Vector3d>& points, const char* options) {
  Silence silence;
  if (silence.stream() == nullptr) return {};
  Qhull qhull(silence.stream());
  if (!qhull.run(points, options, silence.stream())) return {};
  return qhull.triangles();
}

}  // namespace

std::vector<Triangle> qhull_triangles(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> copy = points;
  // Where merging facets fails, joggled input (with Qhull's fixed seed) does not; planes are measured anew
  // anyway. A merged facet with k corners costs k^2: the rims of a cylinder of 8000 points took 1.5 s. So
  // many points are joggled at once, by some 1e-11 of their extent.
  constexpr std::size_t many_points = 1500;
  const char *merged = "qhull Qt Pp", *joggled = "qhull QJ Pp";
  const bool many = points.size() > many_points;
  for (const char* options : {many ? joggled : merged, many ? merged : joggled}) {
    std::vector<Triangle> triangles = triangles_of(copy, options);
    if (!triangles.empty()) return triangles;
  }
  return {};
}

}  // namespace pcl_bv::bench
