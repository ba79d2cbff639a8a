// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The DDS domain and participant that all topics of the process share, and the mapping of ROS names to DDS
// names.
#pragma once

#include <dds/dds.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace pcl_bv::dds {

/// Owns a DDS entity. A reader or writer must be destroyed before its topic, and every entity before its
/// domain.
class Entity {
 public:
  Entity() = default;
  /// Takes ownership. If `entity` is an error code (negative), throws IoError with the message "`what`:
  /// reason".
  Entity(dds_entity_t entity, const std::string& what);
  Entity(Entity&& other) noexcept;
  Entity& operator=(Entity&& other) noexcept;
  ~Entity();

  dds_entity_t get() const { return entity_; }

 private:
  dds_entity_t entity_ = 0;
};

/// The DDS participant of the process and the log of Cyclone DDS.
class Participant {
 public:
  /// Returns the participant of the process. Creates it if there is none. The last owner deletes it. Throws
  /// IoError if DDS cannot start (no network), and std::invalid_argument for invalid environment variables.
  static std::shared_ptr<Participant> shared();

  dds_entity_t get() const { return participant_.get(); }

  /// Returns the lines that Cyclone DDS has logged since the last call of take_log(), at most the first 100.
  std::vector<std::string> take_log();

 private:
  class Log {
   public:
    Log();
    ~Log();
    std::vector<std::string> take();
    std::string last() const;

   private:
    static void note(void* log, const dds_log_data_t* data);
    mutable std::mutex mutex_;
    std::vector<std::string> lines_;
  };

  Participant();

  Log log_;
  Entity domain_, participant_;
};

/// Converts a ROS topic name to the DDS name: "/points" to "rt/points". Throws std::invalid_argument for an
/// invalid name.
std::string dds_topic(const std::string& topic);

/// Converts a ROS type name to the DDS name: "sensor_msgs/msg/PointCloud2" to
/// "sensor_msgs::msg::dds_::PointCloud2_".
std::string dds_type(const std::string& type);
/// Converts a DDS type name to the ROS name, for messages to the user. Inverse of dds_type().
std::string ros_type(std::string type);

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;
Qos make_qos();

}  // namespace pcl_bv::dds
