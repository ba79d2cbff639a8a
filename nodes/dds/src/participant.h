// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What all topics of the process share: the domain with its buffers, and one participant.
#pragma once

#include <dds/dds.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace pcl_bv::dds {

/// Deletes an entity of DDS, which must be the first thing to go of what it uses.
class Entity {
 public:
  Entity() = default;
  /// Throws IoError, "`what`: why", for an error instead of an entity.
  Entity(dds_entity_t entity, const std::string& what);
  Entity(Entity&& other) noexcept;
  Entity& operator=(Entity&& other) noexcept;
  ~Entity();

  dds_entity_t get() const { return entity_; }

 private:
  dds_entity_t entity_ = 0;
};

class Participant {
 public:
  /// That of the process, made for the first who asks and gone with the last. Throws IoError where there is
  /// no network, std::invalid_argument for bad values in the environment.
  static std::shared_ptr<Participant> shared();

  dds_entity_t get() const { return participant_.get(); }

  /// What Cyclone would have printed since the last call.
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

/// ROS's name of a topic as DDS's ("/points": "rt/points"). Throws std::invalid_argument for what is none.
std::string dds_topic(const std::string& topic);

/// ROS's name of a type as DDS's ("sensor_msgs/msg/PointCloud2": "sensor_msgs::msg::dds_::PointCloud2_").
std::string dds_type(const std::string& type);
/// The other way round, for people.
std::string ros_type(std::string type);

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;
Qos make_qos();

}  // namespace pcl_bv::dds
