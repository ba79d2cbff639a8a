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

// Point by point; PCL takes the first laser of a VLP-16's second firing for one of its first (it asks for
// more than 16 where it means from 16 on), so that one may be half a block's turn aside.
void expect_the_same(const std::vector<Cloud::ConstPtr>& theirs, const std::string& file, bool vlp) {
  PacketReader reader(file);
  SensorSweep sweep;
  ASSERT_GE(theirs.size(), 3U);
  std::size_t aside = 0, all = 0;
  for (const Cloud::ConstPtr& cloud : theirs) {
    ASSERT_TRUE(reader.next(sweep));
    ASSERT_NEAR(static_cast<double>(sweep.points.size()), static_cast<double>(cloud->size()), vlp ? 2 : 0);
    if (sweep.points.size() != cloud->size()) continue;
    for (std::size_t i = 0; i < cloud->size(); ++i, ++all) {
      const SensorPoint& ours = sweep.points[i];
      const pcl::PointXYZI& p = (*cloud)[i];
      const double apart = std::hypot(ours.x - p.x, ours.y - p.y, ours.z - p.z);
      EXPECT_EQ(ours.intensity, p.intensity);
      if (apart <= 1e-3) continue;
      ++aside;
      ASSERT_TRUE(vlp);
      EXPECT_EQ(ours.ring, 0U);
      EXPECT_LT(apart, 0.005 * std::hypot(p.x, p.y) + 1e-3);
    }
  }
  EXPECT_LE(aside, vlp ? all / 25 : 0);
  EXPECT_GT(all, 50'000U);
}

TEST(VelodyneAgainstPcl, AnHdl32IsReadAsByItsGrabber) {
  const std::string file = sample("sample_velodyne_hdl32.pcap");
  if (file.empty()) GTEST_SKIP() << "PCL_BV_DATA is not set";
  expect_the_same(by_pcl<pcl::HDLGrabber>(file, 3), file, false);
}

TEST(VelodyneAgainstPcl, AVlp16IsReadAsByItsGrabber) {
  const std::string file = sample("sample_velodyne_vlp16_gps.pcap");
  if (file.empty()) GTEST_SKIP() << "PCL_BV_DATA is not set";
  expect_the_same(by_pcl<VlpFile>(file, 4), file, true);
}

}  // namespace
}  // namespace pcl_bv::detail
