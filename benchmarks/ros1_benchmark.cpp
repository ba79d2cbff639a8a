// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Two nodelets in one manager, this process, get the same clouds in turns, as from a driver in the manager:
// ours, and pcl_ros' EuclideanClusterExtraction (packages libpcl-ros-dev and libpcl-ros-segmentation0d;
// without them there is no row). Timed is from sending a cloud, a street without its ground, to the first
// message of the answer: ours is one message with volumes, pcl_ros sends a cloud for each cluster. `ratio` is
// the median of the pairs.

#include <benchmark/benchmark.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <unistd.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "child_process.h"
#include "pcl_bv/synth/street.h"
#include "program.h"

namespace pcl_bv::bench {
using namespace detail;
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr const char* kTheirLibrary = "libpcl_ros_segmentation.so";

sensor_msgs::PointCloud2ConstPtr objects_of_street(std::size_t number) {
  StreetOptions street;
  street.points = points_in_this_run(130'000);
  const SynthCloud made = make_street_frame(street, number).cloud;
  std::vector<float> xyz;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const float* point = &made.xyz[3 * i];
    const float squared = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    if (made.ground[i] == 0 && squared > 1) xyz.insert(xyz.end(), point, point + 3);
  }
  const auto made_cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  sensor_msgs::PointCloud2& cloud = *made_cloud;
  cloud.header.frame_id = "lidar";
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(xyz.size() / 3);
  cloud.point_step = 12;
  cloud.row_step = 12 * cloud.width;
  cloud.is_dense = 1;
  cloud.fields.resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    cloud.fields[i].name = std::string(1, static_cast<char>('x' + i));
    cloud.fields[i].offset = 4 * i;
    cloud.fields[i].datatype = sensor_msgs::PointField::FLOAT32;
    cloud.fields[i].count = 1;
  }
  cloud.data.resize(4 * xyz.size());
  std::memcpy(cloud.data.data(), xyz.data(), cloud.data.size());
  return made_cloud;
}

template <class Holds>
void wait_for(Holds holds, const char* what) {
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (!holds()) {
    if (Clock::now() > end) throw std::runtime_error(what);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// Between a publisher and a subscriber of ours.
template <class Answer>
class Nodelet {
 public:
  Nodelet(ros::NodeHandle& ros, nodelet::Loader& manager, const std::string& name, const std::string& type,
          const std::string& in, const std::string& out)
      : clouds_(ros.advertise<sensor_msgs::PointCloud2>(in, 1)) {
    answers_ = ros.subscribe<Answer>(out, 1000, [this](const boost::shared_ptr<const Answer>&) {
      Clock::rep none = 0;
      first_.compare_exchange_strong(none, Clock::now().time_since_epoch().count());
      ++messages_;
    });
    const nodelet::M_string remappings{{ros::names::resolve("points"), "/" + in}};
    if (!manager.load("/" + name, type, remappings, {})) throw std::runtime_error("cannot load " + type);
    wait_for([&] { return clouds_.getNumSubscribers() > 0 && answers_.getNumPublishers() > 0; },
             "a nodelet does not come");
  }

  double seconds_of(const sensor_msgs::PointCloud2ConstPtr& cloud) {
    first_ = 0;
    const auto begin = Clock::now();
    clouds_.publish(cloud);
    wait_for([&] { return first_ != 0; }, "a nodelet does not answer");
    const Clock::duration took(first_ - begin.time_since_epoch().count());
    for (std::size_t before = 0; before != messages_;) {  // until no more come
      before = messages_;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return std::chrono::duration<double>(took).count();
  }
  std::size_t messages() const { return messages_; }

 private:
  ros::Publisher clouds_;
  ros::Subscriber answers_;
  std::atomic<Clock::rep> first_{0};
  std::atomic<std::size_t> messages_{0};
};

fs::path their_library() {
  for (const char* folder : {"/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib"})
    if (const fs::path library = fs::path(folder) / kTheirLibrary; fs::exists(library)) return library;
  return {};
}

// A master, and a folder where Debian's pluginlib looks for "lib/libpcl_ros_segmentation".
class Surroundings {
 public:
  Surroundings() {
    fs::create_directories(folder_ / "lib/lib");
    if (!their_library().empty()) fs::create_symlink(their_library(), folder_ / "lib/lib" / kTheirLibrary);
    std::ofstream(folder_ / ".catkin") << "";
    const std::string port = std::to_string(20'000 + getpid() % 10'000);
    setenv("ROS_MASTER_URI", ("http://localhost:" + port).c_str(), 1);
    setenv("ROS_HOSTNAME", "localhost", 1);
    setenv("ROS_HOME", folder_.c_str(), 1);
    setenv("ROS_PACKAGE_PATH", ROS1_TREE "/share:/usr/share", 1);
    setenv("CMAKE_PREFIX_PATH", (ROS1_TREE ":" + folder_.string()).c_str(), 1);
    core_ = std::make_unique<RunningProcess>(std::vector<std::string>{"roscore", "-p", port});
    ros::init(ros::M_string(), "bench", ros::init_options::NoSigintHandler);
    wait_for([] { return ros::master::check(); }, "roscore does not come");
  }
  ~Surroundings() {
    core_.reset();
    fs::remove_all(folder_);
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("pcl_bv_bench_" + std::to_string(getpid()));
  std::unique_ptr<RunningProcess> core_;
};

void over_pcl_ros(benchmark::State& state, const std::string& volume) {
  ros::NodeHandle ros;
  ros.setParam("/theirs/cluster_tolerance", 0.5);
  ros.setParam("/theirs/cluster_min_size", 10);
  ros.setParam("/theirs/spatial_locator", 0);
  ros.setParam("/ours/ground/method", "none");
  ros.setParam("/ours/volumes", volume);
  ros.setParam("/ours/threads", static_cast<int>(state.range(0)));
  nodelet::Loader manager;
  Nodelet<sensor_msgs::PointCloud2> theirs(ros, manager, "theirs", "pcl/EuclideanClusterExtraction",
                                           "theirs/input", "theirs/output");
  Nodelet<visualization_msgs::MarkerArray> ours(ros, manager, "ours", "pcl_bv/ClusterVolumes", "clouds",
                                                "markers");
  std::vector<sensor_msgs::PointCloud2ConstPtr> clouds;
  for (std::size_t i = 0; i < (tiny() ? 1U : 10U); ++i)
    clouds.push_back(objects_of_street(i));
  ours.seconds_of(clouds.front());
  theirs.seconds_of(clouds.front());
  std::vector<double> ratios, their_ms, our_ms;
  for (auto _ : state) {
    for (const sensor_msgs::PointCloud2ConstPtr& cloud : clouds) {
      our_ms.push_back(1e3 * ours.seconds_of(cloud));
      their_ms.push_back(1e3 * theirs.seconds_of(cloud));
      ratios.push_back(their_ms.back() / our_ms.back());
    }
  }
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  state.counters["ratio"] = median(ratios);
  state.counters["theirs_ms"] = median(their_ms);
  state.counters["ours_ms"] = median(our_ms);
  state.counters["their_messages"] = static_cast<double>(theirs.messages());
  state.counters["points"] = clouds.front()->width;
}

}  // namespace
}  // namespace pcl_bv::bench

int main(int argc, char** argv) {
  using namespace pcl_bv::bench;
  if (their_library().empty()) return 0;
  const Surroundings surroundings;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  for (const char* volume : {"aabb", "obb-lshape"})
    benchmark::RegisterBenchmark((std::string("ros1/over-pcl_ros/") + volume).c_str(), over_pcl_ros, volume)
        ->ArgName("threads")
        ->Arg(1)
        ->Arg(2)
        ->Iterations(tiny() ? 1 : 3)
        ->UseRealTime();
  const int status = run_program(argc, argv);
  ros::shutdown();
  return status;
}
