// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A window that shows the volumes of the last frame.
#pragma once

#include <pcl/visualization/pcl_visualizer.h>

#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"

namespace pcl_bv {

/// A PCLVisualizer that shows the volumes of the last frame as wireframes, coloured by track or cluster.
///
/// The window needs a display. Without a display, Debian's build of VTK ends the process.
class LiveWindow {
 public:
  explicit LiveWindow(const std::string& title = "pcl_bv") : window_(title) {
    window_.setBackgroundColor(0.05, 0.06, 0.09);
    window_.addCoordinateSystem(1);
  }

  /// Stores a copy of the volumes for the next spin_once(). Any thread may call show().
  void show(const FrameResult& result) {
    const std::lock_guard lock(mutex_);
    volumes_ = result.volumes;
    colours_.clear();
    for (std::size_t i = 0; i < result.volumes.size(); ++i) {
      const std::size_t cluster = i / result.methods.size();
      const bool tracked = cluster < result.tracks.size() && result.tracks[cluster].has_value();
      colours_.push_back(tracked ? result.tracks[cluster]->id : cluster);
    }
    has_new_volumes_ = true;
  }

  /// Draws the volumes and handles the window's events for `milliseconds`. Must be called repeatedly from the
  /// thread that has created the window. Returns false once the user has closed the window.
  bool spin_once(int milliseconds = 10) {
    draw();
    window_.spinOnce(milliseconds);
    return !window_.wasStopped();
  }

  /// Returns the PCLVisualizer, for further settings.
  pcl::visualization::PCLVisualizer& window() { return window_; }

 private:
  void draw() {
    const std::lock_guard lock(mutex_);
    if (!has_new_volumes_) return;
    has_new_volumes_ = false;
    window_.removeAllShapes();
    for (std::size_t i = 0; i < volumes_.size(); ++i)
      add(mesh(volumes_[i]), colours_[i], std::to_string(i) + '/');
  }

  void add(const Mesh& mesh, std::size_t colour, const std::string& name) {
    const double hue = 6 * (0.618033988749895 * static_cast<double>(colour % 1000));
    const auto channel = [hue](double shift) { return 0.6 + 0.4 * std::cos(hue + shift); };
    std::size_t n = 0;
    for (const auto& face : mesh.faces) {
      pcl::PointCloud<pcl::PointXYZ>::Ptr polygon(new pcl::PointCloud<pcl::PointXYZ>);
      for (const auto corner : face) {
        const Eigen::Vector3f p = mesh.vertices[static_cast<std::size_t>(corner)].template cast<float>();
        polygon->emplace_back(p.x(), p.y(), p.z());
      }
      window_.addPolygon<pcl::PointXYZ>(polygon, channel(0), channel(2.1), channel(4.2),
                                        name + std::to_string(n++));
    }
  }

  std::mutex mutex_;
  pcl::visualization::PCLVisualizer window_;
  std::vector<AnyVolume> volumes_;
  std::vector<std::size_t> colours_;
  bool has_new_volumes_ = false;
};

}  // namespace pcl_bv
