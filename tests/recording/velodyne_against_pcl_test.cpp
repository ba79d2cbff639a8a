// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>
#include <pcl/io/hdl_grabber.h>
#include <pcl/io/vlp_grabber.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "pcl_bv/recording/packet_reader.h"

namespace pcl_bv::detail {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZI>;

std::string sample(const char* name) {
  const char* const data = std::getenv("PCL_BV_DATA");
  return data == nullptr ? "" : std::string(data) + "/sensors/" + name;
}

// PCL replays at the pace of the recording and does not say when it ends.
template <class Grabber>
std::vector<Cloud::ConstPtr> by_pcl(const std::string& file, std::size_t sweeps) {
  std::vector<Cloud::ConstPtr> clouds;
  std::mutex mutex;
  Grabber grabber("", file);
  const std::function<void(const Cloud::ConstPtr&)> keep = [&](const Cloud::ConstPtr& cloud) {
    const std::lock_guard lock(mutex);
    clouds.push_back(cloud);
  };
  grabber.registerCallback(keep);
  grabber.start();
  for (int i = 0; i < 100; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::lock_guard lock(mutex);
    if (clouds.size() >= sweeps) break;
  }
  grabber.stop();
  return clouds;
}

struct VlpFile : pcl::VLPGrabber {
  VlpFile(const std::string&, const std::string& file) : pcl::VLPGrabber(file) {}
};

// Point by point. PCL gives all lasers of a firing the same azimuth, although the sensor turns meanwhile: by
// up to `turn` degrees. PCL also takes the first laser of a VLP-16's second firing for one of its first (it
// asks for more than 16 where it means from 16 on).
void expect_the_same(const std::vector<Cloud::ConstPtr>& theirs, const std::string& file, bool vlp,
                     double turn) {
  PacketReader reader(file);
  SensorSweep sweep;
  ASSERT_GE(theirs.size(), 3U);
  std::size_t all = 0, at_the_same_place = 0;
  for (const Cloud::ConstPtr& cloud : theirs) {
    ASSERT_TRUE(reader.next(sweep));
    ASSERT_NEAR(static_cast<double>(sweep.points.size()), static_cast<double>(cloud->size()), vlp ? 2 : 0);
    if (sweep.points.size() != cloud->size()) continue;
    for (std::size_t i = 0; i < cloud->size(); ++i, ++all) {
      const SensorPoint& ours = sweep.points[i];
      const pcl::PointXYZI& p = (*cloud)[i];
      EXPECT_EQ(ours.intensity, p.intensity);
      EXPECT_NEAR(ours.z, p.z, 1e-3);
      EXPECT_NEAR(std::hypot(ours.x, ours.y), std::hypot(p.x, p.y), 1e-3);
      // Azimuths increase from y to x.
      const double turned = std::atan2(ours.x * p.y - ours.y * p.x, ours.x * p.x + ours.y * p.y) * 180 / M_PI;
      const double rounding = 0.1 / std::hypot(p.x, p.y);
      EXPECT_GE(turned, -rounding);
      EXPECT_LE(turned, turn + rounding);
      at_the_same_place += std::abs(turned) <= rounding ? 1 : 0;
    }
  }
  EXPECT_GE(at_the_same_place, all / 40);  // the first laser of each firing
  EXPECT_GT(all, 50'000U);
}

TEST(VelodyneAgainstPcl, AnHdl32IsReadAsByItsGrabberButForTheFiringTimes) {
  const std::string file = sample("sample_velodyne_hdl32.pcap");
  if (file.empty()) GTEST_SKIP() << "PCL_BV_DATA is not set";
  expect_the_same(by_pcl<pcl::HDLGrabber>(file, 3), file, false, 0.15);
}

TEST(VelodyneAgainstPcl, AVlp16IsReadAsByItsGrabberButForTheFiringTimes) {
  const std::string file = sample("sample_velodyne_vlp16_gps.pcap");
  if (file.empty()) GTEST_SKIP() << "PCL_BV_DATA is not set";
  expect_the_same(by_pcl<VlpFile>(file, 4), file, true, 0.21);
}

}  // namespace
}  // namespace pcl_bv::detail
