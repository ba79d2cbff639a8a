// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A master of the test's own, nodes beside it, and what they say.
#pragma once

#include <arpa/inet.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <sys/socket.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "background.h"
#include "temporary_folder.h"

namespace pcl_bv::test {

/// A port that nobody has at the moment.
inline int free_port() {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(descriptor);
  return ntohs(address.sin_port);
}

inline sensor_msgs::PointCloud2 cloud_of(const std::vector<float>& xyz, std::uint32_t seconds = 17) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "lidar";
  cloud.header.stamp = ros::Time(seconds, 5);
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(xyz.size() / 3);
  cloud.point_step = 12;
  cloud.row_step = 12 * cloud.width;
  for (const char* name : {"x", "y", "z"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(4 * cloud.fields.size());
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(xyz.data());
  cloud.data.assign(bytes, bytes + 4 * xyz.size());
  return cloud;
}

/// A cube of 1000 points, 0.9 m wide, 10 m ahead.
inline sensor_msgs::PointCloud2 cube(std::uint32_t seconds = 17) {
  std::vector<float> xyz;
  for (int i = 0; i < 1000; ++i)
    for (const float value : {10 + 0.1F * static_cast<float>(i % 10), 0.1F * static_cast<float>(i / 10 % 10),
                              0.1F * static_cast<float>(i / 100)})
      xyz.push_back(value);
  return cloud_of(xyz, seconds);
}

/// A master, this process's node, and a folder, as long as the process lives: a process has one master only.
class Surroundings {
 public:
  static Surroundings& get() {
    static Surroundings only;
    return only;
  }
  const TemporaryFolder folder;
  std::unique_ptr<ros::NodeHandle> ros;

 private:
  Surroundings() {
    const std::string port = std::to_string(free_port());
    setenv("ROS_MASTER_URI", ("http://localhost:" + port).c_str(), 1);
    setenv("ROS_HOSTNAME", "localhost", 1);
    setenv("ROS_HOME", folder.path().c_str(), 1);
    setenv("ROS_LOG_DIR", folder.path().c_str(), 1);
    setenv("ROS_PACKAGE_PATH", ROS1_TREE "/share:/usr/share", 1);
    setenv("CMAKE_PREFIX_PATH", ROS1_TREE, 1);
    core_ =
        std::make_unique<Background>(folder / "core.err", std::vector<std::string>{"roscore", "-p", port});
    ros::init(ros::M_string(), "test", ros::init_options::NoSigintHandler);
    EXPECT_TRUE(wait_for([] { return ros::master::check(); })) << core_->errors();
    ros = std::make_unique<ros::NodeHandle>();
    spinner_ = std::make_unique<ros::AsyncSpinner>(1);
    spinner_->start();
  }
  ~Surroundings() {
    spinner_->stop();
    ros.reset();
    ros::shutdown();
    core_->end(SIGINT);
  }

  std::unique_ptr<Background> core_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

class Ros1Test : public testing::Test {
 protected:
  ~Ros1Test() override { ros().deleteParam("/cluster_volumes"); }

  static ros::NodeHandle& ros() { return *Surroundings::get().ros; }
  static std::string at(const std::string& name) { return (Surroundings::get().folder / name).string(); }

  /// The node with these parameters and remappings.
  static std::unique_ptr<Background> node(std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(), ROS1_TREE "/lib/pcl_bv/cluster_volumes");
    return std::make_unique<Background>(at("node.err"), std::move(arguments));
  }
  static std::unique_ptr<Background> command(const std::string& name, std::vector<std::string> words) {
    return std::make_unique<Background>(at(name + ".err"), std::move(words));
  }
};

/// All messages of a topic so far.
template <class Message>
class Heard {
 public:
  Heard(ros::NodeHandle& ros, const std::string& topic) {
    subscriber_ = ros.subscribe<Message>(topic, 100, [this](const typename Message::ConstPtr& message) {
      const std::lock_guard lock(mutex_);
      messages_.push_back(message);
    });
  }
  std::vector<typename Message::ConstPtr> all() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  std::size_t size() const { return all().size(); }
  bool connected() const { return subscriber_.getNumPublishers() > 0; }
  void stop() { subscriber_.shutdown(); }

 private:
  mutable std::mutex mutex_;
  std::vector<typename Message::ConstPtr> messages_;
  ros::Subscriber subscriber_;
};

/// Clouds to a node that listens.
class Lidar {
 public:
  explicit Lidar(ros::NodeHandle& ros, const std::string& topic = "points")
      : publisher_(ros.advertise<sensor_msgs::PointCloud2>(topic, 10)) {}
  bool heard() const {
    return wait_for([&] { return publisher_.getNumSubscribers() > 0; });
  }
  std::uint32_t listeners() const { return publisher_.getNumSubscribers(); }
  void send(const sensor_msgs::PointCloud2& cloud) const { publisher_.publish(cloud); }

 private:
  ros::Publisher publisher_;
};

}  // namespace pcl_bv::test
